"""Faults planted in real robots are found, and few other rules speak of them."""

from __future__ import annotations

import pytest

from bench.faults import ROBOTS, Result, results
from support.real_packages import CORPUS, MODERN, needs

pytestmark = [*needs(CORPUS), *needs(MODERN)]


@pytest.fixture(scope="module")
def planted() -> list[Result]:
    """Each kind of fault in one of the robots."""
    return results(seed=1, once=True)


def test_there_are_many_kinds_for_submissions_and_urdf(planted: list[Result]) -> None:
    assert len({result.kind for result in planted}) >= 150
    assert {result.robot for result in planted} == {robot.name for robot in ROBOTS}


def test_they_are_found(planted: list[Result]) -> None:
    missed = [(result.kind, result.robot) for result in planted if not result.found]
    assert len(missed) <= 0.02 * len(planted), missed


def test_few_others_are_reported(planted: list[Result]) -> None:
    others = [(result.kind, result.cascades) for result in planted if result.cascades]
    cascades = sum(len(found) for _, found in others)
    assert cascades <= 0.2 * len(planted), others
