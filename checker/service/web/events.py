"""The events of a check as they happen (server-sent events of the HTML standard)."""

from __future__ import annotations

import json
from collections.abc import AsyncIterator
from contextlib import ExitStack
from time import monotonic

import anyio
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request
from starlette.responses import Response, StreamingResponse
from starlette.types import Receive, Scope, Send

from checker.base.words import plain
from checker.service.jobs.port import Event, Jobs, JobsUnreachable
from checker.service.web.services import Services

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
    place.enter_context(services.gate.stream(request))
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
    told = {
        "number": event.number,
        "stage": str(event.stage),
        "words": plain(event.words),
        "time": event.time,
        "data": dict(event.data),
    }
    return f"id: {event.number}\ndata: {json.dumps(told, default=str)}\n\n"


def _last_seen(request: Request) -> int:
    """Return the number that a browser that comes back has seen last."""
    given = request.headers.get("last-event-id", "")
    number = int(given) if given.isascii() and given.isdecimal() and len(given) < 11 else 0
    return min(number, HIGHEST)
