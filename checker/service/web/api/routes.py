"""The API for programs, described by `/api/openapi.json`."""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

from starlette.concurrency import run_in_threadpool
from starlette.exceptions import HTTPException
from starlette.requests import Request
from starlette.responses import RedirectResponse, Response

from checker.base.record import Record
from checker.service.jobs.port import State
from checker.service.web import receipts
from checker.service.web.answers.headers import KINDS, file_response
from checker.service.web.answers.problems import Problem
from checker.service.web.answers.refusal import Refused
from checker.service.web.api.views import (
    HIGHEST,
    CheckView,
    Created,
    address_of,
    check_view,
    event_stream,
)
from checker.service.web.services import Services
from checker.service.web.uploads.transfer import new_check

if TYPE_CHECKING:
    from fastapi import APIRouter

_FORM = {
    "type": "object",
    "required": ["file"],
    "properties": {
        "token": {
            "type": "string",
            "description": "Access token, if one is needed and no header contains it.",
        },
        "profile": {
            "type": "string",
            "description": "Profile of the check; empty: chosen for the package.",
        },
        "file": {"type": "string", "format": "binary", "description": "The file; the last field."},
    },
}
_UPLOAD = {
    "requestBody": {"required": True, "content": {"multipart/form-data": {"schema": _FORM}}},
    "parameters": [
        {
            "name": receipts.KEY,
            "in": "header",
            "required": False,
            "description": "A random text of the client's own. The same upload with the same one "
            "is the same check: send it again where the answer got lost.",
            "schema": {"type": "string", "pattern": f"^{receipts.KEY_PATTERN.pattern}$"},
        }
    ],
}
_OTHERS = ("OPTIONS", "PATCH", "POST", "PUT", "TRACE")
_DESCRIPTIONS = {
    400: "The form cannot be read, or was cut off.",
    401: "A token is needed.",
    403: "The secret is not the one of this check, or the request comes from another site.",
    404: "Nothing is at this address, or not yet.",
    405: "Another method is expected.",
    408: "The upload is too slow.",
    413: "The file is too large.",
    415: "The file is of a kind that cannot be checked.",
    421: "The service does not answer under this name.",
    422: "The archive, the profile, a parameter or a header is refused, and why.",
    429: "Too many uploads; see Retry-After.",
    503: "Too busy, or the database does not answer; see Retry-After.",
}


def router(services: Services) -> APIRouter:
    """Return the routes of the API."""
    from fastapi import APIRouter

    api = Api(services)
    routes = APIRouter(prefix="/api/checks", tags=["checks"])
    add = partial(routes.add_api_route, responses=_refusals(404, 421, 422, 503))
    routes.add_api_route(
        "",
        api.create,
        methods=["POST"],
        status_code=201,
        response_model=Created,
        openapi_extra=_UPLOAD,
        responses=_refusals(400, 401, 403, 408, 413, 415, 421, 422, 429, 503),
    )
    add("/{id}", api.show, methods=["GET"], response_model=CheckView)
    _add_ends(routes, api)
    routes.add_route("/api/checks/{id}", _other_method, methods=_OTHERS, include_in_schema=False)
    _add_events(routes, api)
    _add_files(routes, api)
    return routes


def _add_ends(router: APIRouter, api: Api) -> None:
    from fastapi import Header

    help_text = "The secret that the answer to the upload had."

    def cancel(
        request: Request,
        id: str,
        secret: str = Header("", alias=receipts.SECRET, description=help_text),
    ) -> CheckView:
        """End a check, and return its state; one that has ended stays as it is."""
        return api.cancel(request, id, secret)

    def delete(
        id: str, secret: str = Header("", alias=receipts.SECRET, description=help_text)
    ) -> Response:
        """End a check and delete it: its link leads nowhere at once, its files go later."""
        return api.delete(id, secret)

    refusals = _refusals(403, 404, 421, 422, 503)
    router.add_api_route(
        "/{id}/cancel", cancel, methods=["POST"], response_model=CheckView, responses=refusals
    )
    router.add_api_route("/{id}", delete, methods=["DELETE"], status_code=204, responses=refusals)


def _add_events(router: APIRouter, api: Api) -> None:
    from fastapi import Query

    async def events(
        request: Request,
        id: str,
        after: int = Query(
            default=0, ge=0, le=HIGHEST, description="Number of the last event that is known."
        ),
    ) -> Response:
        """Send the events behind number `after` as they happen, until the check ends."""
        return await api.events(request, id, after)

    stream: dict[int | str, dict[str, Any]] = {
        200: {"content": {"text/event-stream": {}}},
        204: {"description": "The check has ended."},
    }
    router.add_api_route(
        "/{id}/events",
        events,
        response_class=Response,
        responses={**_refusals(404, 421, 422, 503), **stream},
    )


def _add_files(router: APIRouter, api: Api) -> None:
    for name, kind in KINDS.items():
        here = "/{id}/packages/" if name == "index.html" else "/{id}/"
        _add_file(router, here + name, api.file_named(name), kind)
    for name in ("report.html", "robot.glb"):
        inner = api.file_of_package(name)
        _add_file(router, f"/{{id}}/packages/{{folder}}/{name}", inner, KINDS[name])
    router.add_api_route("/{id}/index.html", api.index, include_in_schema=False)
    router.add_api_route("/{id}/", api.page, include_in_schema=False)


def _add_file(router: APIRouter, path: str, endpoint: Any, kind: str) -> None:
    success: dict[int | str, dict[str, Any]] = {200: {"content": {kind.partition(";")[0]: {}}}}
    name = path.rpartition("/")[2]
    router.add_api_route(
        path,
        endpoint,
        name=f"{name} of a package" if "{folder}" in path else name,
        response_class=Response,
        responses={**_refusals(404, 421, 422, 503), **success},
    )


class Api(Record):
    """The routes. Functions that wait for the engine or the disk run in a thread."""

    services: Services

    async def create(self, request: Request, response: Response) -> Created:
        """Take a package, an archive or a model file, and order its check."""
        receipt = await new_check(request, self.services)
        response.headers["Location"] = f"/api/checks/{receipt.id}"
        receipts.give(response, receipt, request, self.services)
        url = self._page(request, receipt.id)
        return Created(id=receipt.id, secret=receipt.secret, url=url)

    def show(self, request: Request, id: str) -> CheckView:
        """Tell where a check stands."""
        return self._view(request, self.services.check(id))

    def cancel(self, request: Request, id: str, secret: str) -> CheckView:
        """End a check, and return its state."""
        receipts.cancel(self.services, id, secret)
        return self._view(request, self.services.check(id))

    def delete(self, id: str, secret: str) -> Response:
        """End a check and delete it."""
        receipts.delete(self.services, id, secret)
        return Response(status_code=204)

    async def events(self, request: Request, id: str, after: int) -> Response:
        """Send the events of a check."""
        state = await run_in_threadpool(self.services.check, id)
        return await event_stream(request, self.services, state, after)

    def index(self, request: Request, id: str) -> Response:
        """Lead to the list of packages, next to their folders: its links are relative."""
        self._file(request, id, "index.html")
        return RedirectResponse(address_of(id, "index.html"), 307)

    def page(self, id: str) -> Response:
        """Lead from a report to the page of its check."""
        self.services.check(id)
        return RedirectResponse(f"/checks/{id}", 307)

    def file_named(self, name: str) -> Any:
        """Return the route of a file that a result has once."""

        def send(request: Request, id: str) -> Response:
            return self._file(request, id, name)

        send.__doc__ = f"Send {name}; findings of the static rules come before the trial's."
        return send

    def file_of_package(self, name: str) -> Any:
        """Return the route of a file that each of several packages has."""

        def send(request: Request, id: str, folder: str) -> Response:
            return self._file(request, id, f"{folder}/{name}")

        send.__doc__ = f"Send {name} of one of several packages, by its folder."
        return send

    def _file(self, request: Request, id: str, name: str) -> Response:
        """Return a file of a result; to browsers, a page leads back to the check."""
        state = self.services.check(id)
        path = self.services.store.file(state.result, name) if state.result else None
        if path is not None:
            with suppress(FileNotFoundError):  # it is deleted just now
                return file_response(path, request.headers)
        error = "The check has no such file, or not yet."
        advice = f"Wait until /api/checks/{id} says that it is final, and see its files."
        raise Refused(404, error, advice, "not found")

    def _view(self, request: Request, state: State) -> CheckView:
        names = self.services.store.names(state.result) if state.result else ()
        return check_view(state, self._page(request, state.id), names)

    def _page(self, request: Request, id: str) -> str:
        return f"{self.services.address(request)}/checks/{id}"


def _other_method(_: Request) -> Response:
    """Name both methods of a check; the framework names those of one route."""
    raise HTTPException(405, headers={"Allow": "DELETE, GET, HEAD"})


def _refusals(*statuses: int) -> dict[int | str, dict[str, Any]]:
    return {
        statuse: {"model": Problem, "description": _DESCRIPTIONS[statuse]} for statuse in statuses
    }
