"""Those who follow checks: all are told everything, and one look serves them all."""

from __future__ import annotations

import asyncio
import logging
from collections.abc import AsyncIterator, Callable, Coroutine, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass, field

import pytest

from checker.service.jobs.port import Event, JobsUnreachable, Stage
from checker.service.web.api import watchers as module
from checker.service.web.api.watchers import Watchers
from tests.web.board import ID, QUEUED, BoardJobs

PATIENCE = 30.0
OTHER = "another-check-22-chars"


@dataclass
class Told(BoardJobs):
    """Checks of which the test tells, and which count how often they are asked for."""

    told: dict[str, list[Event]] = field(default_factory=dict)
    asked: int = 0
    fault: Exception | None = None

    def tell(self, id: str, stage: Stage = Stage.STATIC) -> None:
        events = self.told.setdefault(id, [])
        events.append(Event(len(events) + 1, stage, "", 0.0))

    def events(self, after: Mapping[str, int]) -> Mapping[str, Sequence[Event]]:
        self.asked += 1
        if self.fault is not None:
            raise self.fault
        return {
            id: [event for event in self.told[id] if event.number > number]
            for id, number in after.items()
            if id in self.told
        }


@pytest.fixture
def jobs() -> Told:
    jobs = Told({ID: QUEUED})
    jobs.tell(ID, Stage.QUEUED)
    return jobs


@pytest.fixture(autouse=True)
def _hasty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "PAUSE_SECONDS", 0.05)


class Reader:
    """Reads a stream to its end."""

    def __init__(self, watchers: Watchers, id: str = ID, after: int = 0) -> None:
        self.lines: list[str] = []
        self.task = asyncio.create_task(self._read(watchers, id, after))

    async def _read(self, watchers: Watchers, id: str, after: int) -> None:
        with ExitStack() as place:
            check = place.enter_context(watchers.follow(id))
            await watchers.look([check])
            lines: AsyncIterator[str] = check.lines(after)
            async for line in lines:
                self.lines.append(line)

    @property
    def numbers(self) -> list[int]:
        return [int(line.split()[1]) for line in self.lines if line.startswith("id: ")]

    async def end(self) -> list[int]:
        async with asyncio.timeout(PATIENCE):
            await self.task
        return self.numbers


def run(story: Callable[[], Coroutine[None, None, None]]) -> None:
    # In a thread of its own: a browser that runs has this one's event loop.
    with ThreadPoolExecutor(1) as thread:
        thread.submit(asyncio.run, story()).result()


async def until(holds: Callable[[], bool]) -> None:
    async with asyncio.timeout(PATIENCE):
        while not holds():
            await asyncio.sleep(0.01)


def test_one_look_serves_all_who_follow(jobs: Told) -> None:
    async def story() -> None:
        watchers = Watchers(jobs)
        jobs.tell(OTHER)
        readers = [Reader(watchers, id) for id in (ID, OTHER) * 25]
        await until(lambda: all(reader.numbers == [1] for reader in readers))
        before = jobs.asked
        jobs.tell(ID, Stage.DONE)
        assert [await reader.end() for reader in readers[::2]] == [[1, 2]] * 25
        assert jobs.asked - before < 25
        for reader in readers[1::2]:
            reader.task.cancel()

    run(story)


@pytest.mark.parametrize(("after", "numbers"), [(0, [1, 2, 3]), (2, [3]), (3, []), (9, [])])
def test_who_comes_late_gets_what_was_missed(
    jobs: Told, after: int, numbers: Sequence[int]
) -> None:
    async def story() -> None:
        watchers = Watchers(jobs)
        first = Reader(watchers)
        jobs.tell(ID)
        await until(lambda: first.numbers == [1, 2])
        late = Reader(watchers, after=after)
        jobs.tell(ID, Stage.DONE)
        assert await late.end() == numbers
        assert await first.end() == [1, 2, 3]

    run(story)


def test_of_a_check_that_is_deleted_nothing_more_comes(jobs: Told) -> None:
    async def story() -> None:
        reader = Reader(Watchers(jobs))
        await until(lambda: reader.numbers == [1])
        del jobs.told[ID]  # nothing tells of it
        assert await reader.end() == [1]

    run(story)


def test_a_database_that_is_away_is_waited_for(jobs: Told) -> None:
    async def story() -> None:
        reader = Reader(Watchers(jobs))
        await until(lambda: reader.numbers == [1])
        jobs.fault = JobsUnreachable()
        jobs.tell(ID, Stage.DONE)
        asked = jobs.asked
        await until(lambda: jobs.asked > asked + 2)
        assert reader.numbers == [1]
        jobs.fault = None
        assert await reader.end() == [1, 2]

    run(story)


def test_after_a_fault_of_ours_who_follows_comes_back(
    jobs: Told, caplog: pytest.LogCaptureFixture
) -> None:
    async def story() -> None:
        watchers = Watchers(jobs)
        reader = Reader(watchers)
        await until(lambda: reader.numbers == [1])
        jobs.fault = ZeroDivisionError()
        with caplog.at_level(logging.ERROR):
            assert await reader.end() == [1]
        assert "ZeroDivisionError" in caplog.text
        jobs.fault = None
        again = Reader(watchers, after=1)
        jobs.tell(ID, Stage.DONE)
        assert await again.end() == [2]

    run(story)


def test_a_stream_that_is_silent_says_that_it_lives(
    jobs: Told, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "QUIET_SECONDS", 0.05)

    async def story() -> None:
        reader = Reader(Watchers(jobs))
        await until(lambda: len(reader.lines) > 2)
        assert reader.lines[1] == ": still there\n\n"
        reader.task.cancel()

    run(story)


def test_nobody_looks_when_nobody_follows(jobs: Told) -> None:
    async def story() -> None:
        watchers = Watchers(jobs)
        reader = Reader(watchers)
        await until(lambda: reader.numbers == [1])
        reader.task.cancel()
        await until(lambda: watchers.idle)
        again = Reader(watchers)
        jobs.tell(ID, Stage.DONE)
        assert await again.end() == [1, 2]

    run(story)
