"""Followers of checks: the state of a check is looked up once for all its followers."""

from __future__ import annotations

import asyncio
import json
import logging
from collections.abc import AsyncIterator, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic

from starlette.concurrency import run_in_threadpool

from checker.base.words import plain
from checker.service.jobs.port import Event, Jobs, JobsUnreachable
from checker.service.logs import LOGGER

QUIET_SECONDS = 15.0
"""Time after which a comment keeps the stream alive; proxies close idle ones."""
STREAM_SECONDS = 600.0
"""Time after which a stream ends; browsers reconnect and state where they were."""
PAUSE_SECONDS, LONGEST_SECONDS, PAUSE_SHARE = 0.3, 1.0, 9.0
"""Pause between two queries, at least and at most; in between, so many times as long as the last
one took, that many watchers do not use a processor up."""
_LOG = logging.getLogger(LOGGER)


@dataclass(eq=False)
class Followed:
    """A check with followers.

    Attributes:
        id: The id of the check.
        followers: The number of followers.
        last: Number of its last event that is known.
        over: Whether nothing will come any more.
    """

    id: str
    followers: int = 0
    last: int = 0
    over: bool = False
    _messages: list[tuple[int, str]] = field(default_factory=list)
    _news: asyncio.Event = field(default_factory=asyncio.Event)

    async def lines(self, after: int) -> AsyncIterator[str]:
        """Yield the events behind number `after` as they happen, until the check ends."""
        ends = monotonic() + STREAM_SECONDS
        while monotonic() < ends:
            news = self._news
            for number, message in tuple(self._messages):
                if number > after:
                    yield message
                    after = number
            if self.over:
                return
            try:
                async with asyncio.timeout(QUIET_SECONDS):
                    await news.wait()
            except TimeoutError:
                yield ": still there\n\n"

    def add(self, events: Sequence[Event]) -> None:
        """Pass on events; some of them may be known."""
        for event in events:
            if event.number > self.last:
                self._messages.append((event.number, _message(event)))
                self.last, self.over = event.number, event.stage.is_final
        if events:
            self._wake()

    def end(self) -> None:
        """Disconnect all followers."""
        self.over = True
        self._wake()

    def _wake(self) -> None:
        self._news.set()
        self._news = asyncio.Event()


class Watchers:
    """All followers of checks; used by the event loop alone.

    As long as there are followers, one task looks up the changes of all their checks.
    """

    def __init__(self, jobs: Jobs) -> None:
        self._jobs = jobs
        self._checks: dict[str, Followed] = {}
        self._task: asyncio.Task[None] | None = None

    @property
    def idle(self) -> bool:
        """True if no check is watched."""
        return self._task is None

    @contextmanager
    def follow(self, id: str) -> Iterator[Followed]:
        """Follow a check."""
        check = self._checks.setdefault(id, Followed(id))
        check.followers += 1
        if self.idle:
            self._task = asyncio.create_task(self._look_on())
        try:
            yield check
        finally:
            check.followers -= 1
            if not check.followers and self._checks.get(id) is check:
                del self._checks[id]

    async def look(self, checks: Sequence[Followed]) -> None:
        """Look what is new of checks; a database that is away states it later."""
        try:
            events = await run_in_threadpool(
                self._jobs.events, {check.id: check.last for check in checks}
            )
        except JobsUnreachable:
            return
        for check in checks:
            if check.id in events:
                check.add(events[check.id])
            else:  # it is deleted
                check.end()

    async def _look_on(self) -> None:
        try:
            while self._checks:
                began = monotonic()
                await self.look(tuple(self._checks.values()))
                pause = min(PAUSE_SHARE * (monotonic() - began), LONGEST_SECONDS)
                await asyncio.sleep(max(PAUSE_SECONDS, pause))
        except Exception:  # noqa: BLE001 - no caller waits for what raises here
            _LOG.exception("a look at checks that are followed fails")
        finally:
            self._task = None
            for check in self._checks.values():  # followers reconnect
                check.end()
            self._checks.clear()


def _message(event: Event) -> str:
    data = {
        "number": event.number,
        "stage": str(event.stage),
        "words": plain(event.words),
        "time": event.time,
        "data": dict(event.data),
    }
    return f"id: {event.number}\ndata: {json.dumps(data, default=str)}\n\n"
