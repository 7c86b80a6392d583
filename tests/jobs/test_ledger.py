"""The book of checks: whatever order things happen in, it tells one story."""

from __future__ import annotations

import secrets
import tempfile
from pathlib import Path

import pytest
import sqlalchemy as sa
from hypothesis import settings
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, precondition, rule

from checker.service.jobs.durable.database import open_database
from checker.service.jobs.durable.ledger import GIVEN_UP, Ledger, Step, Turn, forget
from checker.service.jobs.durable.readings import events_of, state_of
from checker.service.jobs.durable.tables import METADATA
from checker.service.jobs.port import Event, Order, Stage, State
from tests.effort import examples

ORDER = Order("0" * 64, "robot.zip", "subt")
QUEUED = Step("queued", Stage.QUEUED, "waits")
STATIC = Step("static", Stage.STATIC, "looks")
READ = Step("read", Stage.TRIAL, "has looked", "a" * 64)
TRIAL = Step("trial", Stage.TRIAL, "drives")
DONE = Step("end", Stage.DONE, "ready", "b" * 64)


def ledger_in(folder: Path) -> Ledger:
    engine = open_database(f"sqlite:///{folder}/jobs.sqlite")
    METADATA.create_all(engine)
    return Ledger(engine)


def entered(ledger: Ledger, step: Step = QUEUED) -> str:
    id = secrets.token_urlsafe(16)
    ledger.enter(id, ORDER, 60.0, step, lambda _: None)
    return id


def state(ledger: Ledger, id: str) -> State:
    with ledger.engine.connect() as connection:
        found = state_of(connection, id)
    assert found is not None
    return found


def told(ledger: Ledger, id: str) -> list[Event]:
    with ledger.engine.connect() as connection:
        return list(events_of(connection, id, 0))


@pytest.fixture
def ledger(tmp_path: Path) -> Ledger:
    return ledger_in(tmp_path)


class AnyStory(RuleBasedStateMachine):
    """A check under workers that take it, finish, hand it back and die, and a user who cancels."""

    @initialize()
    def submit(self) -> None:
        self.folder = tempfile.TemporaryDirectory()
        self.ledger = ledger_in(Path(self.folder.name))
        self.id = entered(self.ledger)
        self.turns: list[Turn] = []
        self.before = state(self.ledger, self.id)

    @property
    def stage(self) -> Stage:
        return state(self.ledger, self.id).stage

    @rule()
    def take(self) -> None:
        """A queue gives it out: what had it in hand before is dead, or only thought to be."""
        step = TRIAL if self.stage is Stage.TRIAL else STATIC
        turn = self.ledger.take(self.id, f"w{len(self.turns)}", step)
        if turn is not None:
            self.turns.append(turn)

    @rule()
    def take_again_what_is_through(self) -> None:
        if self.stage not in (Stage.QUEUED, Stage.STATIC):
            assert self.ledger.take(self.id, "late", STATIC) is None

    @precondition(lambda self: self.turns)
    @rule()
    def settle(self) -> None:
        step = DONE if self.stage is Stage.TRIAL else READ
        self.ledger.settle(self.turns[-1], step)

    @precondition(lambda self: len(self.turns) > 1)
    @rule()
    def settle_late(self) -> None:
        """A worker that was taken for dead comes back with a result."""
        assert not self.ledger.settle(self.turns[-2], DONE)
        assert not self.ledger.release(self.turns[-2])
        assert not self.ledger.wanted(self.turns[-2])

    @precondition(lambda self: self.turns)
    @rule()
    def release(self) -> None:
        self.ledger.release(self.turns[-1])

    @rule()
    def cancel(self) -> None:
        open_before = not self.stage.is_final
        assert self.ledger.cancel(self.id) is open_before
        assert self.stage.is_final

    @invariant()
    def events_are_numbered_and_none_is_told_twice(self) -> None:
        events = told(self.ledger, self.id)
        assert [event.number for event in events] == list(range(1, len(events) + 1))
        assert len({event.words for event in events}) == len(events)

    @invariant()
    def nothing_follows_the_end(self) -> None:
        events = told(self.ledger, self.id)
        stages = [event.stage for event in events]
        assert not any(stage.is_final for stage in stages[:-1])
        assert stages[-1].is_final is self.stage.is_final
        order = list(Stage)
        assert stages == sorted(stages, key=order.index)

    @invariant()
    def only_the_last_turn_is_wanted(self) -> None:
        assert sum(self.ledger.wanted(turn) for turn in self.turns) <= 1

    @invariant()
    def the_end_stays_as_it_is(self) -> None:
        now = state(self.ledger, self.id)
        assert not self.before.stage.is_final or now == self.before
        self.before = now

    def teardown(self) -> None:
        self.ledger.engine.dispose()
        self.folder.cleanup()


TestAnyStory = AnyStory.TestCase
TestAnyStory.settings = settings(max_examples=examples(25), stateful_step_count=15, deadline=None)


def test_a_check_is_given_up_after_its_third_worker(ledger: Ledger) -> None:
    id = entered(ledger)
    assert all(ledger.take(id, f"w{n}", STATIC) for n in range(3))
    assert ledger.take(id, "w3", STATIC) is None
    assert (state(ledger, id).stage, state(ledger, id).words) == (Stage.FAILED, GIVEN_UP)
    losses = told(ledger, id)[-1].data["losses"]
    assert [loss["worker"] for loss in losses] == ["w0", "w1", "w2"]


def test_what_belongs_together_holds_together_or_not_at_all(ledger: Ledger) -> None:
    def fail(_connection: sa.Connection) -> None:
        raise RuntimeError("no queue")

    with pytest.raises(RuntimeError):
        ledger.enter("one", ORDER, 60.0, QUEUED, fail)
    with ledger.engine.connect() as connection:
        assert state_of(connection, "one") is None
        assert list(events_of(connection, "one", 0)) == []
    id = entered(ledger)
    turn = ledger.take(id, "w", STATIC)
    assert turn is not None
    with pytest.raises(RuntimeError):
        ledger.settle(turn, READ, fail)
    assert (state(ledger, id).stage, state(ledger, id).result) == (Stage.STATIC, "")
    assert ledger.wanted(turn)


def test_words_are_kept_as_every_database_takes_them(ledger: Ledger) -> None:
    id = entered(ledger, Step("queued", Stage.QUEUED, "a\0b\udcff\N{RIGHT-TO-LEFT OVERRIDE}" * 999))
    words = state(ledger, id).words
    assert words == told(ledger, id)[0].words
    assert words.startswith("a\ufffdb\ufffd\ufffda")
    assert len(words) == 2000


def test_what_is_forgotten_leaves_nothing(ledger: Ledger) -> None:
    gone, kept = entered(ledger), entered(ledger)
    with ledger.engine.begin() as connection:
        forget(connection, [gone])
        assert state_of(connection, gone) is None
        assert list(events_of(connection, gone, 0)) == []
    assert told(ledger, kept)
