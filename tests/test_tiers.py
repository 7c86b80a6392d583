"""Tests that reach further than their tier fail, and cases in a loop are named."""

from __future__ import annotations

import socket
import subprocess
from collections.abc import Callable

import pytest

from tests.each import of_each
from tests.effort import grows_linearly, limited
from tests.tiers import BY_PLACE, SMOKE, TESTS


def test_places_of_tiers_exist() -> None:
    assert not [place for place in BY_PLACE if not (TESTS / place).exists()]


def test_tests_that_the_gate_runs_exist() -> None:
    for place, test in (each.split("::") for each in SMOKE):
        assert f"\ndef {test}(" in (TESTS / place).read_text("utf-8")


def test_the_first_tier_opens_no_port() -> None:
    with pytest.raises(pytest.fail.Exception, match="needs the mark `service`"):
        socket.create_server(("127.0.0.1", 0))


def test_the_first_tier_starts_no_foreign_program() -> None:
    with pytest.raises(pytest.fail.Exception, match="needs the mark `programs`"):
        subprocess.run(["git", "version"], check=False)


@pytest.mark.service
def test_other_tiers_may() -> None:
    socket.create_server(("127.0.0.1", 0)).close()


def test_each_value_that_fails_is_named() -> None:
    @of_each("number", range(5))
    def is_small(number: int, most: int) -> None:
        assert number < most

    is_small(most=5)
    with pytest.raises(AssertionError, match=r"\A3: .*\n4: "):
        is_small(most=3)


@pytest.fixture
def work(monkeypatch: pytest.MonkeyPatch) -> Callable[[float], None]:
    """Return work that takes so many seconds by a clock that nothing else moves."""
    taken = 0.0

    def add(seconds: float) -> None:
        nonlocal taken
        taken += seconds

    monkeypatch.setattr("time.process_time", lambda: taken)
    return add


def test_work_is_limited(work: Callable[[float], None]) -> None:
    with limited(2.0):
        work(2.0)
    with pytest.raises(AssertionError, match=r"3\.00 s of work, 2\.00 allowed"), limited(2.0):
        work(3.0)


def test_a_square_is_told_from_linear_growth(work: Callable[[float], None]) -> None:
    assert grows_linearly(lambda: work(1.0), lambda: work(4.0))
    assert not grows_linearly(lambda: work(1.0), lambda: work(16.0))
