"""Which check is next: whoever sends them, none waits for more than its share."""

from __future__ import annotations

import secrets
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.service.jobs.durable.checks import Checks
from checker.service.jobs.durable.steps import Step, Taker
from checker.service.jobs.port import Stage
from tests.effort import examples
from tests.jobs.test_checks import DONE, ORDER, QUEUED, READ, SECRET, checks_in

HERE = Taker("w", "here")


@pytest.fixture
def checks(tmp_path: Path) -> Checks:
    return checks_in(tmp_path)


def enter(checks: Checks, sender: str, cost: float = 1.0, name: str = "") -> str:
    """Enter a check whose name tells the sender and the cost."""
    name = name or f"{sender} {cost:g}"
    order = replace(ORDER, sender=sender, name=name)
    assert checks.enter(secrets.token_hex(32), SECRET, order, 60.0, QUEUED, cost)
    return name


def served(checks: Checks, stage: Stage = Stage.STATIC, step: Step = DONE) -> list[str]:
    """Do all checks one after the other, and return their names."""
    names = []
    while held := checks.take(HERE, stage):
        names.append(held.order.name)
        assert checks.settle(held, step, cost=1.0)
    return names


def test_senders_have_their_turn_one_after_the_other(checks: Checks) -> None:
    for _ in range(4):
        enter(checks, "a")
    enter(checks, "b")
    enter(checks, "b")
    assert served(checks) == ["a 1", "b 1", "a 1", "b 1", "a 1", "a 1"]


def test_who_comes_late_owes_nothing_and_is_owed_nothing(checks: Checks) -> None:
    for _ in range(6):
        enter(checks, "a")
    for _ in range(3):
        held = checks.take(HERE, Stage.STATIC)
        assert held is not None
        checks.settle(held, DONE)
    for _ in range(3):
        enter(checks, "b")
    assert served(checks) == ["a 1", "b 1", "a 1", "b 1", "a 1", "b 1"]


def test_short_ones_overtake_long_ones(checks: Checks) -> None:
    enter(checks, "a", 60.0)
    enter(checks, "b", 2.0)
    enter(checks, "a", 1.0)
    assert served(checks) == ["a 1", "b 2", "a 60"]


def test_a_long_one_is_not_overtaken_for_ever(checks: Checks) -> None:
    enter(checks, "a", 10.0)
    order: list[str] = []
    while "a 10" not in order:
        enter(checks, "b")
        enter(checks, "a")
        held = checks.take(HERE, Stage.STATIC)
        assert held is not None
        order.append(held.order.name)
        checks.settle(held, DONE)
    assert len(order) <= 25


def test_trials_wait_in_a_queue_of_their_own(checks: Checks) -> None:
    for _ in range(3):
        enter(checks, "a")
    enter(checks, "b")
    assert len(served(checks, step=READ)) == 4
    assert served(checks, Stage.TRIAL) == ["a 1", "b 1", "a 1", "a 1"]


def test_one_place_is_for_those_of_whom_nothing_is_in_hand(checks: Checks) -> None:
    for sender in "aab":
        enter(checks, sender)
    first = checks.take(HERE, Stage.STATIC)
    other = checks.take(HERE, Stage.STATIC, others=True)
    assert first is not None
    assert other is not None
    assert (first.order.sender, other.order.sender) == ("a", "b")
    assert checks.take(HERE, Stage.STATIC, others=True) is None
    checks.settle(first, DONE)
    assert checks.take(HERE, Stage.STATIC, others=True) is not None


SENT = st.lists(st.tuples(st.sampled_from("abcd"), st.sampled_from([1.0, 3.0, 20.0])), max_size=25)


@given(SENT)
@settings(max_examples=examples(40), deadline=None)
def test_no_sender_is_more_than_one_check_ahead_of_its_share(
    sent: list[tuple[str, float]],
) -> None:
    with TemporaryDirectory() as folder:
        checks = checks_in(Path(folder))
        costs = {enter(checks, a, cost, f"{a} {n}"): cost for n, (a, cost) in enumerate(sent)}
        left, done = Counter(sender for sender, _ in sent), Counter[str]()
        for name in served(checks):
            sender = name[0]
            done[sender] += costs[name]  # type: ignore[assignment]
            left[sender] -= 1
            for other in left:
                longest = max(cost for who, cost in sent if who == other)
                if left[other]:
                    assert done[sender] <= done[other] + longest + costs[name]
        assert not left.total()
        checks.engine.dispose()
