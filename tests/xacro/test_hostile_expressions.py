"""Hostile expressions are refused or bounded, each within a second and in little memory."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

from tests.xacro.hostile_expressions import ERRORS, LIMITED, REFUSED

ROOT = Path(__file__).parent.parent.parent
GROUPS = (REFUSED, LIMITED, ERRORS)
SECONDS, MEMORY = 5.0, 200_000_000


@pytest.fixture(scope="module")
def said() -> Any:
    """What a process of little memory says of all expressions."""
    command = [sys.executable, "-m", "tests.xacro.evaluating"]
    done = subprocess.run(command, capture_output=True, check=True, cwd=ROOT, timeout=300)
    return json.loads(done.stdout)


def outcomes(said: Any, group: int) -> dict[str, str]:
    named = zip(GROUPS[group], said["done"][group], strict=True)
    return {expression: f"{kind}: {words}" for expression, (kind, words, _) in named}


@pytest.mark.slow
def test_what_is_outside_of_the_language_is_refused(said: Any) -> None:
    others = {
        expression: outcome
        for expression, outcome in outcomes(said, 0).items()
        if not outcome.startswith("RefusedExpression")
    }
    assert not others


def test_what_takes_too_much_is_ended_by_its_bound(said: Any) -> None:
    others = {
        expression: outcome
        for expression, outcome in outcomes(said, 1).items()
        if not outcome.startswith("ExpressionLimit")
    }
    assert not others


def test_what_python_calls_wrong_is_an_error(said: Any) -> None:
    ours = ("value", "RefusedExpression: the function", "MemoryError", "RecursionError")
    found = outcomes(said, 2)
    assert not {each: outcome for each, outcome in found.items() if outcome.startswith(ours)}


def test_each_ends_soon_and_needs_little_memory(said: Any) -> None:
    slowest = max(seconds for group in said["done"] for *_, seconds in group)
    assert slowest < SECONDS * said["slowness"]
    assert said["grown"] < MEMORY
    assert sum(map(len, GROUPS)) > 70
