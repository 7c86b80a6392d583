"""The table of checks: whatever order things happen in, it tells one story."""

from __future__ import annotations

import secrets
import tempfile
from collections.abc import Sequence
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from checker.service.jobs.durable.checks import PAUSES, TRIES, Checks, forget
from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.steps import Held, Step, Taker
from checker.service.jobs.durable.tables import make_tables
from checker.service.jobs.port import Event, Order, Stage, State
from tests.effort import examples

ORDER = Order("0" * 64, "robot.zip", "subt")
SECRET = "1" * 64
QUEUED = Step("queued", Stage.QUEUED, "waits")
READ = Step("read", Stage.TRIAL, "has looked", "a" * 64)
DONE = Step("end", Stage.DONE, "ready", "b" * 64)


AT_ONCE = (0.0,) * (TRIES - 1)
"""Pauses before further tries."""


def checks_in(folder: Path, pauses: Sequence[float] = PAUSES) -> Checks:
    engine = open_database(f"sqlite:///{folder}/jobs.sqlite")
    with engine.begin() as connection:
        make_tables(connection)
    return Checks(engine, pauses)


def entered(checks: Checks, step: Step = QUEUED) -> str:
    id = secrets.token_urlsafe(16)
    assert checks.enter(id, SECRET, ORDER, 60.0, step, 1.0)
    return id


def taker(number: int) -> Taker:
    return Taker(f"w{number}", "here")


def take(checks: Checks, number: int = 0) -> Held | None:
    """Take what there is, from whichever queue."""
    stages = (Stage.STATIC, Stage.TRIAL)
    return next(filter(None, (checks.take(taker(number), stage) for stage in stages)), None)


def state(checks: Checks, id: str) -> State:
    found = checks.state(id)
    assert found is not None
    return found


def told(checks: Checks, id: str) -> list[Event]:
    return list(checks.events.after(id, 0))


@pytest.fixture
def checks(tmp_path: Path) -> Checks:
    return checks_in(tmp_path)


class AnyStory(RuleBasedStateMachine):
    """A check under workers that take it, finish, hand it back and die, and a user who cancels."""

    @initialize()
    def submit(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.checks = checks_in(Path(self.folder.name), AT_ONCE)
        self.id = entered(self.checks)
        self.held: list[Held] = []
        self.before = state(self.checks, self.id)

    @property
    def stage(self) -> Stage:
        return state(self.checks, self.id).stage

    @rule()
    def take(self) -> None:
        """A worker asks for what is next."""
        in_hand = any(map(self.checks.holds, self.held))
        held = take(self.checks, len(self.held))
        assert (held is None) is (in_hand or self.stage.is_final)
        if held is not None:
            self.held.append(held)

    @rule()
    def die(self) -> None:
        """Whoever has it in hand is dead, or only thought to be."""
        self.checks.recover(lambda _: True)
        assert not any(map(self.checks.holds, self.held))

    @precondition(lambda self: self.held)
    @rule()
    def put_off(self) -> None:
        """The disk is full."""
        self.checks.put_off(self.held[-1], "the disk is full")

    @precondition(lambda self: self.held)
    @rule()
    def settle(self) -> None:
        step = DONE if self.stage is Stage.TRIAL else READ
        self.checks.settle(self.held[-1], step)

    @precondition(lambda self: len(self.held) > 1)
    @rule()
    def settle_late(self) -> None:
        """A worker that was taken for dead comes back with a result."""
        assert not self.checks.settle(self.held[-2], DONE)
        assert not self.checks.release(self.held[-2])
        assert not self.checks.put_off(self.held[-2], "the disk is full")
        assert not self.checks.holds(self.held[-2])

    @precondition(lambda self: self.held)
    @rule()
    def release(self) -> None:
        self.checks.release(self.held[-1])

    @rule()
    def cancel(self) -> None:
        open_before = not self.stage.is_final
        assert self.checks.cancel(self.id) is open_before
        assert self.stage.is_final

    @invariant()
    def events_are_numbered_and_none_is_told_twice(self) -> None:
        events = told(self.checks, self.id)
        assert [event.number for event in events] == list(range(1, len(events) + 1))
        assert len({event.words for event in events}) == len(events)

    @invariant()
    def nothing_follows_the_end(self) -> None:
        events = told(self.checks, self.id)
        stages = [event.stage for event in events]
        assert not any(stage.is_final for stage in stages[:-1])
        assert stages[-1].is_final is self.stage.is_final
        order = list(Stage)
        assert stages == sorted(stages, key=order.index)

    @invariant()
    def only_one_holds_it(self) -> None:
        assert sum(self.checks.holds(held) for held in self.held) <= 1

    @invariant()
    def the_end_stays_as_it_is(self) -> None:
        now = state(self.checks, self.id)
        assert not self.before.stage.is_final or now == self.before
        self.before = now

    def teardown(self) -> None:
        self.checks.engine.dispose()
        self.folder.cleanup()


TestAnyStory = AnyStory.TestCase
TestAnyStory.settings = settings(max_examples=examples(25), stateful_step_count=15, deadline=None)


def test_a_check_is_given_up_after_its_last_try(tmp_path: Path) -> None:
    checks = checks_in(tmp_path, AT_ONCE)
    id = entered(checks)
    held = [take(checks, n) for n in range(TRIES) if n == 0 or checks.recover(lambda _: True)]
    assert [each and each.is_last for each in held] == [False] * (TRIES - 1) + [True]
    checks.recover(lambda _: True)
    assert take(checks) is None
    assert state(checks, id).stage is Stage.FAILED
    losses = told(checks, id)[-1].data["losses"]
    assert [loss["worker"] for loss in losses] == [f"w{n}" for n in range(TRIES)]
    assert {loss["reason"] for loss in losses} == {"its worker process ended"}


def test_what_is_put_off_waits_for_its_pause(checks: Checks) -> None:
    id = entered(checks)
    held = take(checks)
    assert held is not None
    assert checks.put_off(held, "the disk is full")
    assert take(checks) is None
    assert state(checks, id).words == "starts again in 1 s: the disk is full (try 2 of 5)"


def test_words_are_kept_as_every_database_takes_them(checks: Checks) -> None:
    id = entered(checks, Step("queued", Stage.QUEUED, "a\0b\udcff\N{RIGHT-TO-LEFT OVERRIDE}" * 999))
    words = state(checks, id).words
    assert words == told(checks, id)[0].words
    assert words.startswith("a\ufffdb\ufffd\ufffda")
    assert len(words) == 2000


def test_one_that_is_there_already_stays_as_it_is(checks: Checks) -> None:
    id = entered(checks)
    held = take(checks)
    before, events = state(checks, id), told(checks, id)
    assert checks.enter(id, "2" * 64, ORDER, 9.0, DONE, 1.0) is False
    assert (state(checks, id), told(checks, id)) == (before, events)
    assert held is not None
    assert checks.holds(held)
    assert checks.has_secret(id, SECRET)


def test_one_that_is_deleted_is_lost_to_who_has_it_in_hand(checks: Checks) -> None:
    id = entered(checks)
    held = take(checks)
    assert held is not None
    checks.delete(id)
    assert not checks.holds(held)
    assert checks.settle(held, READ) is checks.release(held) is False
    assert take(checks) is None
    assert (checks.state(id), told(checks, id)) == (None, [])


def test_what_is_forgotten_leaves_nothing(checks: Checks) -> None:
    gone, kept = entered(checks), entered(checks)
    with checks.engine.begin() as connection:
        forget(connection, [gone])
    assert checks.state(gone) is None
    assert told(checks, gone) == []
    assert told(checks, kept)
