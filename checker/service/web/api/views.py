"""What the API tells of a check, at once and as events."""

from __future__ import annotations

import json
from collections.abc import AsyncIterator, Iterable
from contextlib import ExitStack
from time import monotonic
from urllib.parse import quote

import anyio
from pydantic import BaseModel, Field
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send

from checker.base.words import plain
from checker.service.jobs.port import Event, Jobs, JobsUnreachable, Stage, State
from checker.service.web.services import Services

# The events of a check as they happen (server-sent events of the HTML standard).


POLL_SECONDS, EAGER_POLL_SECONDS = 0.3, 0.1
EAGER_SECONDS = 10.0
"""After the start of a stream, in which first findings are waited for and polled for eagerly."""
QUIET_SECONDS = 15.0
"""After which a comment shows that the stream lives; proxies close what is silent."""
STREAM_SECONDS = 600.0
"""After which a stream ends; browsers come back by themselves and say where they were."""
HIGHEST = 2**31 - 1
"""Number of an event."""


class EventStream(StreamingResponse):
    """A stream that holds its place as long as somebody reads it."""

    def __init__(self, jobs: Jobs, id: str, after: int, place: ExitStack) -> None:
        headers = {"X-Accel-Buffering": "no"}
        super().__init__(_lines(jobs, id, after), media_type="text/event-stream", headers=headers)
        self._place = place

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer the request."""
        with self._place:
            await super().__call__(scope, receive, send)


async def event_stream(request: Request, services: Services, id: str, after: int) -> Response:
    """Return the events of a check behind event number `after`, until the check ends.

    When nothing will come any more, the answer is 204: browsers stop to ask.

    Raises:
        Refused: Too many watch.
    """
    after = max(after, _last_seen(request))
    if await _is_over(services.jobs, id, after):
        return Response(status_code=204)
    place = ExitStack()
    place.enter_context(services.admission.stream(request))
    return EventStream(services.jobs, id, after, place)


async def _is_over(jobs: Jobs, id: str, after: int) -> bool:
    state = await run_in_threadpool(jobs.status, id)
    if state is None or state.stage.is_final:
        return not await run_in_threadpool(jobs.events, id, after)
    return False


async def _lines(jobs: Jobs, id: str, after: int) -> AsyncIterator[str]:
    started = spoken = monotonic()
    while monotonic() - started < STREAM_SECONDS:
        try:
            events = await run_in_threadpool(jobs.events, id, after)
            silent = monotonic() - spoken >= QUIET_SECONDS
            if silent and not events and await _is_over(jobs, id, after):
                return
        except JobsUnreachable:
            return
        for event in events:
            yield _message(event)
        if events and events[-1].stage.is_final:
            return
        if silent and not events:
            yield ": still there\n\n"
        if events or silent:
            after, spoken = events[-1].number if events else after, monotonic()
        eager = monotonic() - started < EAGER_SECONDS
        await anyio.sleep(EAGER_POLL_SECONDS if eager else POLL_SECONDS)


def _message(event: Event) -> str:
    data = {
        "number": event.number,
        "stage": str(event.stage),
        "words": plain(event.words),
        "time": event.time,
        "data": dict(event.data),
    }
    return f"id: {event.number}\ndata: {json.dumps(data, default=str)}\n\n"


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
    """Return what the API tells.

    Args:
        state: Of the check.
        url: Of its page.
        names: Of the files of its result.
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
