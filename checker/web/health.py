"""Whether the service lives, whether it is ready for work, and what it has counted."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from checker.jobs.port import Alive, JobsUnreachable
from checker.web.answers import Problem
from checker.web.gate import Gate, bearer
from checker.web.metrics import Metrics
from checker.web.origin import is_loopback
from checker.web.refusal import Refused, not_found
from checker.web.services import Services

if TYPE_CHECKING:
    from fastapi import APIRouter

SILENT_SECONDS = 60.0
"""After which a worker counts as gone."""
_ROOM = 2
"""Uploads of the largest size that the disk must have room for."""
_TEXT_FORMAT = "text/plain; version=0.0.4"


class Well(BaseModel):
    """Nothing is wrong."""

    status: str = "ok"


def router(services: Services, metrics: Metrics) -> APIRouter:
    """Return the routes for those who look after the service."""
    from fastapi import APIRouter

    health = Health(services, metrics)
    made = APIRouter(tags=["health"])
    no: dict[int | str, dict[str, Any]] = {
        503: {"model": Problem, "description": "Not ready, and why."}
    }
    made.add_api_route("/healthz", health.lives, response_model=Well)
    made.add_api_route("/readyz", health.ready, response_model=Well, responses=no)
    made.add_api_route("/metrics", health.figures, include_in_schema=False)
    return made


@dataclass(frozen=True)
class Health:
    """The routes."""

    services: Services
    metrics: Metrics

    async def lives(self) -> Well:
        """Tell that the web process answers."""
        return Well()

    def ready(self) -> Well:
        """Tell whether a check that is ordered now would be done."""
        reasons = " ".join(self._reasons())
        if reasons:
            advice = "See the logs of the service and its workers."
            raise Refused(503, reasons, advice, "not ready", {"Retry-After": "10"})
        return Well()

    async def figures(self, request: Request) -> Response:
        """Return the metrics, to this machine and to those with a token."""
        if not _may_see(request):
            raise not_found()
        try:
            alive: Alive | None = await run_in_threadpool(self.services.jobs.alive)
        except JobsUnreachable:
            alive = None
        return PlainTextResponse(self.metrics.text(alive), media_type=_TEXT_FORMAT)

    def _reasons(self) -> Iterator[str]:
        """Yield sentences about what is amiss."""
        try:
            workers = self.services.jobs.alive().workers
        except JobsUnreachable:
            yield "The database does not answer."
        else:
            if not any(seconds <= SILENT_SECONDS for seconds in workers.values()):
                yield f"No worker has given a sign of life for {SILENT_SECONDS:g} s."
        least = _ROOM * self.services.config.upload_limit
        try:
            free = shutil.disk_usage(self.services.store.folder).free
        except OSError:
            yield "The data folder cannot be read."
        else:
            if free < least:
                yield f"The disk has {free / 1e6:.0f} MB free, expected {least / 1e6:.0f} MB."


def _may_see(request: Request) -> bool:
    """Whether it comes from this machine itself, by no proxy, or brings a token."""
    gate: Gate = request.app.state.gate
    host = request.client.host if request.client else ""
    is_forwarded = "x-forwarded-for" in request.headers or "forwarded" in request.headers
    return (is_loopback(host) and not is_forwarded) or gate.knows(bearer(request))
