"""How long a check that waits will still take, and the words for it."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from msgspec.structs import replace

from checker.service.jobs.port import Alive, Pace, Stage, State
from checker.service.web.pages.remaining import in_words, remaining
from tests.web.board import QUEUED

PACE = Pace(static=2.0, trial=30.0)
TRIAL = replace(QUEUED, stage=Stage.TRIAL)


def alive(workers: int = 1, trials: int = 0) -> Alive:
    return Alive({f"w{n}": 0.0 for n in range(workers)}, {"static": 9, "trial": trials}, 0)


@pytest.mark.parametrize(
    ("state", "pace", "engine", "expected"),
    [
        (QUEUED, PACE, alive(), 32.0),
        (replace(QUEUED, ahead=3), PACE, alive(), 122.0),
        (replace(QUEUED, ahead=3), PACE, alive(trials=2), 182.0),
        (replace(QUEUED, ahead=3), PACE, alive(workers=2), 62.0),
        (replace(QUEUED, ahead=3), Pace(40.0, 30.0), alive(), 190.0),
        (replace(TRIAL, ahead=3), PACE, alive(), 120.0),
        (replace(TRIAL, ahead=3), PACE, alive(workers=4), 30.0),
    ],
)
def test_it_grows_with_the_checks_before_it(
    state: State, pace: Pace, engine: Alive, expected: float
) -> None:
    assert remaining(state, pace, engine) == expected


UNKNOWN = (
    (QUEUED, Pace(), alive()),
    (QUEUED, PACE, alive(workers=0)),
    (QUEUED, PACE, Alive({"silent": 999.0}, {}, 0)),
    (TRIAL, PACE, alive()),
    (replace(QUEUED, stage=Stage.STATIC), PACE, alive()),
    (replace(QUEUED, stage=Stage.CANCELLED, ahead=3), PACE, alive()),
)


def test_what_nobody_knows_is_not_said() -> None:
    for state, pace, engine in UNKNOWN:
        assert remaining(state, pace, engine) is None, (state, pace, engine)


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0.0, "less than a minute"),
        (60.0, "less than a minute"),
        (61.0, "about 1 minute"),
        (122.0, "about 2 minutes"),
        (3599.0, "about 60 minutes"),
        (3600.0, "about 1 hour"),
        (9000.0, "about 2 hours"),
    ],
)
def test_it_is_said_as_people_say_it(seconds: float, words: str) -> None:
    assert in_words(seconds) == words


@given(st.floats(0.0, 1e9))
def test_words_are_never_more_exact_than_a_minute(seconds: float) -> None:
    assert in_words(seconds).startswith(("less than", "about"))
