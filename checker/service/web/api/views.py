"""The API's view of a check, at once and as events."""

from __future__ import annotations

from collections.abc import AsyncIterator, Iterable
from contextlib import ExitStack
from urllib.parse import quote

from pydantic import BaseModel, Field
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send

from checker.base.words import plain
from checker.service.jobs.port import Stage, State
from checker.service.web.services import Services

HIGHEST = 2**31 - 1
"""Number of an event."""


class EventStream(StreamingResponse):
    """The events of a check as they happen (server-sent events of the HTML standard).

    It holds its place as long as a client reads it.
    """

    def __init__(self, lines: AsyncIterator[str], place: ExitStack) -> None:
        headers = {"X-Accel-Buffering": "no"}
        super().__init__(lines, media_type="text/event-stream", headers=headers)
        self._place = place

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer the request."""
        with self._place:
            await super().__call__(scope, receive, send)


async def event_stream(request: Request, services: Services, state: State, after: int) -> Response:
    """Return the events of a check behind event number `after`, until the check ends.

    When nothing will come any more, the answer is 204: browsers stop asking.

    Raises:
        Refused: Too many watch.
    """
    after = max(after, _last_seen(request))
    if state.stage.is_final:
        events = await run_in_threadpool(services.jobs.events, {state.id: after})
        if not events.get(state.id):
            return Response(status_code=204)
    with ExitStack() as place:
        place.enter_context(services.admission.stream(request))
        check = place.enter_context(services.watchers.follow(state.id))
        if not check.last:
            await services.watchers.look([check])
        return EventStream(check.lines(after), place.pop_all())


def _last_seen(request: Request) -> int:
    """Return the number that a browser that comes back has seen last."""
    header = request.headers.get("last-event-id", "")
    number = int(header) if header.isascii() and header.isdecimal() and len(header) < 11 else 0
    return min(number, HIGHEST)


class Created(BaseModel):
    """A check that was created."""

    id: str = Field(description="Id of the check; everybody who knows it can see the report.")
    secret: str = Field(description="Cancels and deletes the check; for its sender alone.")
    url: str = Field(description="Page for people.")


class PackageView(BaseModel):
    """The current result of a package."""

    name: str
    verdict: str = Field(description="ready, paperwork, not_ready or incomplete.")
    errors: int
    warnings: int
    infos: int
    folder: str = Field(description="Folder of its files; empty if there is only one package.")


class CheckView(BaseModel):
    """The current state of a check."""

    id: str
    url: str = Field(description="Page for people.")
    name: str = Field(description="Name of the uploaded file, made safe.")
    profile: str = Field(description="Empty: chosen for the package.")
    stage: Stage
    final: bool = Field(description="Whether the check has ended.")
    words: str = Field(description="Current step, or the error.")
    ahead: int = Field(description="Number of checks before it in the queue.")
    created: float = Field(description="Seconds since the epoch.")
    expires: float = Field(description="When all its data is deleted; seconds since the epoch.")
    packages: list[PackageView]
    files: list[str] = Field(description="Addresses of the files that are ready.")


def check_view(state: State, url: str, names: Iterable[str]) -> CheckView:
    """Return the API's view of a check.

    Args:
        state: The state of the check.
        url: The URL of its page.
        names: The names of the files of its result.
    """
    return CheckView(
        id=state.id,
        url=url,
        name=plain(state.order.name),
        profile=state.order.profile,
        stage=state.stage,
        final=state.stage.is_final,
        words=plain(state.words),
        ahead=state.ahead,
        created=state.created,
        expires=state.expires,
        packages=[
            PackageView(
                name=plain(str(package["name"])),
                verdict=str(package["verdict"]),
                errors=int(package["errors"]),
                warnings=int(package["warnings"]),
                infos=int(package["infos"]),
                folder=str(package["folder"]),
            )
            for package in state.packages
        ],
        files=[address_of(state.id, name) for name in names],
    )


def address_of(id: str, name: str) -> str:
    """Return the path under which a file of a result is fetched."""
    folder, slash, file = name.rpartition("/")
    inner = "packages/" if folder or file == "index.html" else ""
    return f"/api/checks/{id}/{inner}{quote(folder, safe='')}{slash}{quote(file)}"
