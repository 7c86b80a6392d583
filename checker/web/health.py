"""Whether the service lives, whether it is ready for work, and what it has counted."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response

from checker.jobs.port import SILENCE_SECONDS, Alive, JobsUnreachable
from checker.loopback import is_loopback
from checker.record import record
from checker.web.answers import Problem
from checker.web.gate import bearer
from checker.web.refusal import Refused, not_found
from checker.web.services import Services

if TYPE_CHECKING:
    from fastapi import APIRouter

_TEXT_FORMAT = "text/plain; version=0.0.4"


class Well(BaseModel):
    """Nothing is wrong."""

    status: str = "ok"


def router(services: Services) -> APIRouter:
    """Return the routes for those who look after the service."""
    from fastapi import APIRouter

    health = Health(services)
    made = APIRouter(tags=["health"])
    no: dict[int | str, dict[str, Any]] = {
        503: {"model": Problem, "description": "Not ready, and why."}
    }
    made.add_api_route("/healthz", health.lives, response_model=Well)
    made.add_api_route("/readyz", health.ready, response_model=Well, responses=no)
    made.add_api_route("/metrics", health.figures, include_in_schema=False)
    return made


@record()
class Health:
    """The routes."""

    services: Services

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
        if not self._may_see(request):
            raise not_found()
        try:
            alive: Alive | None = await run_in_threadpool(self.services.jobs.alive)
        except JobsUnreachable:
            alive = None
        return PlainTextResponse(self.services.metrics.text(alive), media_type=_TEXT_FORMAT)

    def _may_see(self, request: Request) -> bool:
        """Whether it comes from this machine itself, by no proxy, or brings a token."""
        host = request.client.host if request.client else ""
        is_forwarded = "x-forwarded-for" in request.headers or "forwarded" in request.headers
        if is_loopback(host) and not is_forwarded:
            return True
        return self.services.gate.knows(bearer(request))

    def _reasons(self) -> Iterator[str]:
        """Yield sentences about what is amiss."""
        try:
            workers = self.services.jobs.alive().workers
        except JobsUnreachable:
            yield "The database does not answer."
        else:
            if not any(seconds <= SILENCE_SECONDS for seconds in workers.values()):
                yield f"No worker has given a sign of life for {SILENCE_SECONDS:g} s."
        least = self.services.config.room
        try:
            free = shutil.disk_usage(self.services.store.folder).free
        except OSError:
            yield "The data folder cannot be read."
        else:
            if free < least:
                yield f"The disk has {free / 1e6:.0f} MB free, expected {least / 1e6:.0f} MB."
