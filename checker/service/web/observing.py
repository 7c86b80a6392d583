"""Every request is counted and logged, and a fault of ours becomes an answer."""

from __future__ import annotations

import logging
from time import perf_counter
from typing import Any

from starlette.responses import JSONResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

from checker.base.record import Record
from checker.service.web.answers import CAUSE, Problem
from checker.service.web.logs import FIELDS, LOGGER, short
from checker.service.web.metrics import Metrics

_METHODS = ("GET", "HEAD", "POST", "DELETE", "OPTIONS", "PUT", "PATCH")
_FAULT = JSONResponse(
    Problem(
        error="The service has a fault.",
        advice="Try again later; if it stays, tell whoever runs this service.",
    ).model_dump(),
    500,
)
"""Made of what can hardly fail: the page of errors itself may have been at fault."""
_LOG = logging.getLogger(LOGGER)


class Observing(Record):
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
        except Exception:  # noqa: BLE001 - whatever it is, the client is told in our words
            _LOG.exception("a request fails", extra={FIELDS: _about(scope)})
            if not status:
                await _FAULT(scope, receive, noting)
        finally:
            self._note(scope, status, perf_counter() - started)

    def _note(self, scope: Scope, status: int, seconds: float) -> None:
        about = _about(scope)
        self.metrics.count(about["method"], about["route"], status, seconds)
        if cause := scope["state"].get(CAUSE):
            self.metrics.refused[cause] += 1
        fields = {**about, "status": status, "ms": round(seconds * 1e3, 1)}
        _LOG.info("request", extra={FIELDS: fields})


def _about(scope: Scope) -> dict[str, Any]:
    """Return what is told of a request; nothing that a client may choose at will."""
    method = scope["method"] if scope["method"] in _METHODS else "other"
    about = {"method": method, "route": _route(scope)}
    if id := scope.get("path_params", {}).get("id"):
        about["check"] = short(str(id))
    if cause := scope["state"].get(CAUSE):
        about["refused"] = cause
    return about


def _route(scope: Scope) -> str:
    """Return the template of the route that answers, such as `/checks/{id}`."""
    if "endpoint" not in scope:
        return "none"
    names = {value: f"{{{name}}}" for name, value in scope.get("path_params", {}).items()}
    return "/".join(names.get(part, part) for part in scope["path"].split("/"))
