"""Health of the service: it is alive, it is ready for work, and its counters."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from prometheus_client import CONTENT_TYPE_PLAIN_0_0_4
from pydantic import BaseModel
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response

from checker.base.record import Record
from checker.base.sandbox.layers import hides_files
from checker.service.exposure import is_loopback
from checker.service.jobs.port import SILENCE_SECONDS, Alive, JobsUnreachable
from checker.service.store.objects import StoreUnreachable
from checker.service.web.answers.problems import Problem
from checker.service.web.answers.refusal import Refused, not_found
from checker.service.web.services import Services

if TYPE_CHECKING:
    from fastapi import APIRouter


_NO_KEY = "0" * 64
"""Key of no result; requested to see whether there is an answer."""


class Well(BaseModel):
    """Nothing is wrong."""

    status: str = "ok"


class Ready(Well):
    """A check that is ordered now would be done.

    Attributes:
        sandbox: Names of the layers that hold where each living worker checks; stated only to this
            machine and to those with a token.
    """

    sandbox: Mapping[str, Sequence[str]] | None = None


def router(services: Services) -> APIRouter:
    """Return the routes for operators."""
    from fastapi import APIRouter

    health = Health(services)
    api = APIRouter(tags=["health"])
    no: dict[int | str, dict[str, Any]] = {
        429: {"model": Problem, "description": "Too many wrong tokens; see Retry-After."},
        503: {"model": Problem, "description": "Not ready, and why."},
    }
    api.add_api_route("/healthz", health.lives, response_model=Well)
    api.add_api_route(
        "/readyz",
        health.ready,
        response_model=Ready,
        response_model_exclude_none=True,
        responses=no,
    )
    api.add_api_route("/metrics", health.figures, include_in_schema=False)
    return api


class Health(Record):
    """The routes."""

    services: Services

    async def lives(self) -> Well:
        """Tell that the web process answers."""
        return Well()

    async def ready(self, request: Request) -> Ready:
        """Tell whether a check that is ordered now would be done, in the sandbox."""
        may_see = self._may_see(request)
        alive = await run_in_threadpool(self._ready)
        return Ready(sandbox=_sandbox(alive) if may_see else None)

    async def figures(self, request: Request) -> Response:
        """Return the metrics, to this machine and to those with a token."""
        if not self._may_see(request):
            raise not_found()
        text = await run_in_threadpool(self._figures)
        return Response(text, headers={"Content-Type": CONTENT_TYPE_PLAIN_0_0_4})

    def _figures(self) -> bytes:
        """Return the metrics; a database that is away is queried once."""
        alive = self._alive()
        taken: Mapping[str, float] = {}
        if alive is not None:
            with suppress(JobsUnreachable):
                taken = self.services.jobs.stage_seconds()
        return self.services.metrics.text(alive, taken)

    def _ready(self) -> Alive | None:
        """Return what is known of the engine.

        Raises:
            Refused: A check that is ordered now would not be done.
        """
        alive = self._alive()
        reasons = " ".join((*self._of_workers(alive), *self._of_disk()))
        if reasons:
            advice = "See the logs of the service and its workers."
            raise Refused(503, reasons, advice, "not ready", {"Retry-After": "10"})
        return alive

    def _may_see(self, request: Request) -> bool:
        """Return whether a request comes from this machine without a proxy, or has a token."""
        host = request.client.host if request.client else ""
        is_forwarded = "x-forwarded-for" in request.headers or "forwarded" in request.headers
        if is_loopback(host) and not is_forwarded:
            return True
        return self.services.admission.recognizes(request)

    def _alive(self) -> Alive | None:
        try:
            return self.services.jobs.alive()
        except JobsUnreachable:
            return None

    def _of_workers(self, alive: Alive | None) -> Iterator[str]:
        """Yield sentences about faults of the workers."""
        config = self.services.config
        takes_risk = config.only_here or config.without_sandbox
        if alive is None:
            yield "The database does not answer."
        elif not alive.live_workers:
            yield f"No worker process has reported for {SILENCE_SECONDS:g} s."
        elif not (takes_risk or all(map(hides_files, alive.live_workers.values()))):
            yield "A worker process has no sandbox layer that hides files from uploads."

    def _of_disk(self) -> Iterator[str]:
        """Yield sentences about what is amiss with the data folder."""
        least, store = self.services.config.room, self.services.store
        try:
            free = shutil.disk_usage(store.folder).free
        except OSError:
            yield "The data folder cannot be read."
            return
        if free < least:
            yield f"The disk has {free / 1e6:.0f} MB free, expected {least / 1e6:.0f} MB."
        try:
            with store.incoming() as incoming:  # what is not finished is not kept
                incoming.write(b"written to see whether it can be")
            store.has(_NO_KEY)
        except StoreUnreachable:
            yield "The object store does not answer."
        except OSError as error:
            yield f"The data folder cannot be written: {error.strerror or 'it fails'}."


def _sandbox(alive: Alive | None) -> Mapping[str, Sequence[str]]:
    living = alive.live_workers if alive else {}
    return {
        worker: [layer.name for layer in layers if layer.held] for worker, layers in living.items()
    }
