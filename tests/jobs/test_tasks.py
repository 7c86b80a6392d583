"""Where a check stands follows from the rows of its tries, whatever these are."""

from __future__ import annotations

from collections.abc import Sequence

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.service.jobs.durable.tasks import (
    TRIES,
    End,
    Row,
    Task,
    events_of,
    ids_of,
    in_order,
    state_of,
)
from checker.service.jobs.port import Order, Stage

FIRST = Task("k" * 64, Order("u" * 64, "robot.zip"), 1e9, 2e9)
READ = replace(FIRST, stage=Stage.TRIAL, result="r" * 64, packages=({"name": "robot"},))
DONE = End(Stage.DONE, "Ready", "d" * 64, ({"name": "robot"},))


def row(
    task: Task, status: str = "ENQUEUED", end: End | None = None, cancelled: float = 0.0
) -> Row:
    """A row as the database has it after so many tenths of seconds as it has had states."""
    begun = 1e9 + 0.1 if status in ("PENDING", "SUCCESS", "ERROR") else 0.0
    ended = 1e9 + 0.2 if status in ("SUCCESS", "ERROR", "CANCELLED") else 0.0
    end = end or task.given_up or task.end
    return Row(task, status, 1e9, begun, ended, "worker", end, cancelled)


def again(task: Task, number: int) -> Task:
    return replace(task, number=number, reason="its worker process ended")


STORIES = {
    "waits": ([row(FIRST)], Stage.QUEUED, "waiting in the queue"),
    "is read": ([row(FIRST, "PENDING")], Stage.STATIC, "the static rules are running"),
    "is refused": (
        [row(FIRST, "SUCCESS", End(Stage.REFUSED, "no archive"))],
        Stage.REFUSED,
        "no archive",
    ),
    "waits for its trial": (
        [row(FIRST, "SUCCESS"), row(READ)],
        Stage.TRIAL,
        "the static rules are finished; the trial is waiting in the queue",
    ),
    "has its trial entered before the static rules are over": (
        [row(FIRST, "PENDING"), row(READ, "PENDING")],
        Stage.TRIAL,
        "the trial is running",
    ),
    "is done": ([row(FIRST, "SUCCESS"), row(READ, "SUCCESS", DONE)], Stage.DONE, "Ready"),
    "is tried again": (
        [row(FIRST, "CANCELLED"), row(again(FIRST, 2))],
        Stage.STATIC,
        f"starts again: its worker process ended (try 2 of {TRIES})",
    ),
    "is given up": (
        [row(FIRST, "SUCCESS"), row(READ, "CANCELLED"), row(again(READ, TRIES + 1))],
        Stage.FAILED,
        f"the checker could not finish: its worker process ended; it was tried {TRIES} times",
    ),
    "is cancelled": ([row(FIRST, "CANCELLED", cancelled=1e9)], Stage.CANCELLED, "cancelled"),
    "is cancelled while its worker goes on": (
        [row(FIRST, "SUCCESS", cancelled=1e9), row(READ, "PENDING")],
        Stage.CANCELLED,
        "cancelled",
    ),
    "is cancelled by the operator": ([row(FIRST, "CANCELLED")], Stage.CANCELLED, "cancelled"),
    "meets a fault of ours": (
        [row(FIRST, "ERROR")],
        Stage.FAILED,
        "the checker could not finish: it failed with an internal error; the operator finds the "
        "cause in the log",
    ),
    "was known": ([row(replace(FIRST, end=DONE))], Stage.DONE, "Ready"),
}


@pytest.mark.parametrize("story", STORIES)
def test_a_check(story: str) -> None:
    rows, stage, words = STORIES[story]
    state = state_of("id", rows)
    assert state is not None
    assert (state.stage, state.words) == (stage, words)
    assert (state.id, state.order) == ("id", FIRST.order)
    assert (state.created, state.expires) == (1e9, 2e9)
    numbers = [event.number for event in events_of(rows)]
    assert numbers == sorted(set(numbers))
    assert min(numbers) >= 1


def test_static_findings_stay_whatever_becomes_of_the_trial() -> None:
    for rows in ([row(READ)], [row(READ, "CANCELLED")], [row(again(READ, TRIES + 1))]):
        state = state_of("id", [row(FIRST, "SUCCESS"), *rows])
        assert state is not None
        assert (state.result, state.packages) == (READ.result, READ.packages)


def test_without_its_first_row_a_check_is_not_known() -> None:
    """As when a worker writes once more of one that is deleted."""
    assert state_of("id", []) is None
    assert state_of("id", [row(again(FIRST, 2))]) is None
    assert events_of([row(READ)]) == ()


def test_all_ids_of_a_check_are_known() -> None:
    tasks = [again(task, number) for task in (FIRST, READ) for number in range(1, TRIES + 2)]
    assert [task.id for task in tasks] == ids_of(FIRST.key)
    assert len(set(ids_of(FIRST.key))) == len(tasks)


ROWS = st.permutations(
    [row(again(task, number)) for task in (FIRST, READ) for number in range(1, TRIES + 1)]
)


@given(ROWS, st.integers(1, 10))
def test_rows_come_in_any_order(rows: Sequence[Row], number: int) -> None:
    [found] = in_order(rows[:number]).values()
    places = [(each.task.stage is Stage.TRIAL, each.task.number) for each in found]
    assert places == sorted(places)
    assert len(found) == number
