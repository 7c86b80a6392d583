"""Refusals of the service: in JSON for programs, as a page for people."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from http import HTTPStatus
from typing import TYPE_CHECKING, Any

from pydantic import BaseModel
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import JSONResponse, Response

from checker.service.jobs.port import JobsUnreachable
from checker.service.logs import LOGGER
from checker.service.store.objects import StoreUnreachable
from checker.service.web.answers.refusal import Refused, not_found
from checker.service.web.pages.site import html

if TYPE_CHECKING:
    from fastapi import FastAPI

_FOR_PROGRAMS = ("/api/", "/healthz", "/readyz", "/metrics")
CAUSE = "refused"
"""Key in the state of a request with the reason of a refusal, for logs and metrics."""
_LOG = logging.getLogger(LOGGER)


class Problem(BaseModel):
    """Reason why a request is refused.

    Attributes:
        error: The fault.
        advice: What to do about it.
    """

    error: str
    advice: str


def refusal_answer(request: Request, refused: Refused) -> Response:
    """Return the answer that says no."""
    request.scope.setdefault("state", {})[CAUSE] = refused.cause
    answer: Response
    if request.scope["path"].startswith(_FOR_PROGRAMS) and not _is_read_by_people(request):
        problem = Problem(error=refused.error, advice=refused.advice)
        answer = JSONResponse(problem.model_dump(), refused.status)
    else:
        status, error, advice = refused.status, refused.error, refused.advice
        answer = html("error.html.j2", status=status, sentence=error, advice=advice)
    answer.headers.update(refused.headers)
    answer.headers.setdefault("vary", "Accept")
    return answer


def _is_read_by_people(request: Request) -> bool:
    """Return whether a browser opens an address of the API, such as that of a report."""
    opens = request.scope["method"] in ("GET", "HEAD")
    return opens and "text/html" in request.headers.get("accept", "")


def install_error_handlers(app: FastAPI) -> None:
    """Make an application answer all errors by this module."""
    from fastapi.exceptions import RequestValidationError

    async def say_no(request: Request, error: Exception) -> Response:
        return refusal_answer(request, _refusal_of(error))

    for kind in (Refused, JobsUnreachable, StoreUnreachable, HTTPException, RequestValidationError):
        app.add_exception_handler(kind, say_no)


def _refusal_of(error: Exception) -> Refused:
    from fastapi.exceptions import RequestValidationError

    match error:
        case Refused():
            return error
        case JobsUnreachable():
            _LOG.warning("the job engine does not answer (%s)", error, exc_info=error)
            return _away("database", "engine")
        case StoreUnreachable():
            return _away("object store", "store")
        case HTTPException():
            return _of_framework(error)
        case RequestValidationError():
            return _invalid(error.errors())
        case _:
            raise error


def _away(what: str, cause: str) -> Refused:
    error, advice = f"The service cannot reach its {what}.", "Try again in a few seconds."
    return Refused(503, error, advice, cause, {"Retry-After": "5"})


def _of_framework(error: HTTPException) -> Refused:
    if error.status_code == HTTPStatus.NOT_FOUND:
        return not_found()
    if error.status_code == HTTPStatus.METHOD_NOT_ALLOWED:
        message = (
            "This address does not support this method.",
            "See /api/openapi.json for the supported methods.",
        )
    else:
        message = (
            "The request cannot be understood.",
            "See /api/openapi.json for the expected form.",
        )
    return Refused(error.status_code, *message, headers=_with_head(dict(error.headers or {})))


def _with_head(headers: dict[str, str]) -> dict[str, str]:
    """Name HEAD wherever GET is allowed: no route has it (`answers.bodies`)."""
    allowed = headers.get("Allow", "").split(", ")
    if "GET" in allowed:
        headers["Allow"] = ", ".join(sorted({*allowed, "HEAD"}))
    return headers


def _invalid(errors: Sequence[Any]) -> Refused:
    """Name the first parameter at fault; its value is the client's own and not repeated."""
    first = errors[0] if errors else {}
    where = first.get("loc", ("request",))[-1]
    what = first.get("msg", "not valid")
    return Refused(422, f"The parameter {where!r} is wrong: {what}.", "Correct it.", "parameter")
