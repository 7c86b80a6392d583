"""Between the web process and its clerk: what one says is what the other hears."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.service.jobs.port import JobsUnreachable
from checker.service.web.clerk.port import Slip
from checker.service.web.clerk.wire import (
    ClerkFailed,
    answer_from_line,
    answer_line,
    id_in,
    slip_from_line,
    slip_to_line,
)
from checker.service.web.refusal import Refused

WORDS = st.text(max_size=50)


@given(st.integers(0), st.builds(Slip, WORDS, WORDS, WORDS))
def test_a_slip_arrives_as_it_was_written(number: int, slip: Slip) -> None:
    line = slip_to_line(number, slip)
    assert line.count(b"\n") == 1
    assert slip_from_line(line) == (number, slip)


def answered(raised: Exception) -> None:
    """Raise what the web process raises when a clerk raises something."""

    def take() -> str:
        raise raised

    number, answer = answer_from_line(answer_line(7, take, lambda: None))
    assert number == 7
    id_in(answer)


def test_an_id_arrives() -> None:
    number, answer = answer_from_line(answer_line(3, lambda: "an id", lambda: None))
    assert (number, id_in(answer)) == (3, "an id")


@given(st.integers(400, 599), WORDS, WORDS, WORDS, st.dictionaries(WORDS, WORDS, max_size=3))
def test_a_refusal_arrives(
    status: int, error: str, advice: str, cause: str, headers: dict[str, str]
) -> None:
    with pytest.raises(Refused) as refused:
        answered(Refused(status, error, advice, cause, headers))
    said = refused.value
    assert (said.status, said.error, said.advice) == (status, error, advice)
    assert (said.cause, said.headers) == (cause, headers)


def test_a_database_that_is_away_and_a_full_disk_arrive() -> None:
    with pytest.raises(JobsUnreachable, match="does not answer"):
        answered(JobsUnreachable("the database does not answer"))
    with pytest.raises(OSError, match="No space left") as full:
        answered(OSError(28, "No space left on device"))
    assert full.value.strerror == "No space left on device"


def test_a_fault_of_ours_is_told_to_the_log_and_no_more_of_it_to_others() -> None:
    told = []

    def take() -> str:
        raise KeyError("/home/secret")

    line = answer_line(1, take, lambda: told.append("fault"))
    assert told == ["fault"]
    assert json.loads(line) == [1, {}]
    with pytest.raises(ClerkFailed):
        id_in(answer_from_line(line)[1])
