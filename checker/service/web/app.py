"""The web application: routes, and the middleware around them."""

from __future__ import annotations

import logging
from contextlib import suppress
from time import perf_counter
from typing import TYPE_CHECKING, Any

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record
from checker.base.resources import version_of
from checker.engine.report_cache import program_parts
from checker.service.jobs.durable.client import durable_jobs
from checker.service.jobs.durable.database import database_url
from checker.service.jobs.durable.receipts import SHOWN_DIGITS, key_of_check
from checker.service.jobs.port import Jobs
from checker.service.logs import FIELDS, LOGGER, log_to_stderr
from checker.service.store.store import Store, open_store
from checker.service.web import health
from checker.service.web.answers.bodies import Compression, Heads
from checker.service.web.answers.headers import SecurityHeaders
from checker.service.web.answers.problems import CAUSE, Problem, install_error_handlers
from checker.service.web.api import routes as api
from checker.service.web.api.watchers import Watchers
from checker.service.web.config import Config, config_from
from checker.service.web.limits.admission import Admission
from checker.service.web.limits.middleware import OwnOrigin, UnreadBodies
from checker.service.web.limits.space import space_of
from checker.service.web.metrics import Metrics
from checker.service.web.pages import routes as pages
from checker.service.web.services import Services
from checker.service.web.uploads.archive_indexes import ArchiveIndexes
from checker.service.web.uploads.leftovers import sweep_while_serving

if TYPE_CHECKING:
    from fastapi import FastAPI
    from fastapi.telemetry import TelemetryConfig


# Every request is counted and logged, and a fault of ours becomes an answer.


_METHODS = ("GET", "HEAD", "POST", "DELETE", "OPTIONS", "PUT", "PATCH")
_FAULT = JSONResponse(
    Problem(
        error="The service has an internal error.",
        advice="Try again later; if it happens again, tell the operator of this service.",
    ).model_dump(),
    500,
)
"""Made of what can hardly fail: the page of errors itself may have been at fault."""
_LOG = logging.getLogger(LOGGER)


class AccessLog(Record):
    """Counts and logs each request by the template of its route: addresses hold ids."""

    app: ASGIApp
    metrics: Metrics

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request."""
        if scope["type"] != "http":
            await self.app(scope, receive, send)
            return
        scope.setdefault("state", {})
        started, status = perf_counter(), 0

        async def noting(message: Message) -> None:
            nonlocal status
            if message["type"] == "http.response.start":
                status = message["status"]
            await send(message)

        try:
            await self.app(scope, receive, noting)
        except Exception:  # noqa: BLE001 - whatever it is, the client gets our message
            _LOG.exception("a request fails", extra={FIELDS: _about(scope)})
            if not status:
                await _FAULT(scope, receive, noting)
        finally:
            self._note(scope, status, perf_counter() - started)

    def _note(self, scope: Scope, status: int, seconds: float) -> None:
        about = _about(scope)
        self.metrics.count(about["method"], about["route"], status, seconds)
        if cause := scope["state"].get(CAUSE):
            self.metrics.refused.labels(cause).inc()
        fields = {**about, "status": status, "ms": round(seconds * 1e3, 1)}
        _LOG.info("request", extra={FIELDS: fields})


def _about(scope: Scope) -> dict[str, Any]:
    """Return the logged description of a request; nothing that a client may choose at will."""
    method = scope["method"] if scope["method"] in _METHODS else "other"
    about = {"method": method, "route": _route(scope)}
    if id := scope.get("path_params", {}).get("id"):
        about["check"] = key_of_check(str(id))[:SHOWN_DIGITS]
    if cause := scope["state"].get(CAUSE):
        about["refused"] = cause
    return about


def _route(scope: Scope) -> str:
    """Return the template of the route that answers, such as `/checks/{id}`."""
    if "endpoint" not in scope:
        return "none"
    names = {value: f"{{{name}}}" for name, value in scope.get("path_params", {}).items()}
    return "/".join(names.get(part, part) for part in scope["path"].split("/"))


_NO_TELEMETRY: TelemetryConfig = {
    "tracing": False,
    "metrics": False,
    "logs": False,
    "operation_spans": False,
    "auto_configure": False,
}
"""The framework's own would send addresses, which contain ids, to a host in the environment."""


def app_from_environment() -> FastAPI:
    """Return the application that the environment configures, with all loaded that an upload needs.

    Raises:
        CheckerError: A variable has a value that makes no sense, or there is no place for data.
    """
    config = config_from()
    log_to_stderr()
    store = open_store()
    store.folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    store.sweep()
    indexes = ArchiveIndexes()
    with suppress(OSError):  # the sender gets a message
        indexes.start()
    # Each result is that of a program; to look through all of this one takes as long as 20 uploads.
    program_parts()
    jobs = durable_jobs(database_url(), store, config.retention_days)
    app = create_app(jobs, store, config, indexes)
    # The framework works its routes out when they are first needed, which takes as long as several
    # uploads: now no request waits for it.
    app.openapi()
    return app


def create_app(
    jobs: Jobs, store: Store, config: Config, indexes: ArchiveIndexes | None = None
) -> FastAPI:
    """Return the application.

    Args:
        jobs: The engine that checks.
        store: Uploads and results.
        config: What is allowed.
        indexes: Reads those of archives; None for its own.
    """
    from fastapi import FastAPI

    metrics = Metrics()
    services = Services(
        jobs,
        store,
        config,
        Admission(config),
        metrics,
        indexes or ArchiveIndexes(),
        Watchers(jobs),
        space_of(store.folder, config),
    )
    app = FastAPI(
        title="subt-check",
        version=version_of("subt-check"),
        description="Checks robot model packages: upload one, follow the check, fetch the report.",
        openapi_url="/api/openapi.json",
        docs_url=None,  # its page would load scripts from elsewhere
        redoc_url=None,
        redirect_slashes=False,
        telemetry=_NO_TELEMETRY,
        lifespan=sweep_while_serving(store),
    )
    install_error_handlers(app)
    app.include_router(api.router(services))
    app.include_router(health.router(services))
    app.include_router(pages.router(services))
    # The last added stands outermost.
    app.add_middleware(Compression)
    app.add_middleware(Heads)
    app.add_middleware(OwnOrigin, config=config)
    app.add_middleware(UnreadBodies)
    app.add_middleware(AccessLog, metrics=metrics)
    app.add_middleware(SecurityHeaders)
    return app
