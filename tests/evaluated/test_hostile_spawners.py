"""No spawner takes a second, or runs away with the memory; none makes the reader raise."""

from __future__ import annotations

import pytest

from tests.evaluated.conftest import Measure
from tests.evaluated.spawners import SPAWNERS

REFUSED = (
    *(
        "calls ",
        "compares ",
        "defines no",
        "holds ",
        "contains ",
        "is longer",
        "makes a",
        "raises ",
        "reads ",
    ),
    *("returns ", "runs ", "takes more than", "takes too long", "uses "),
)


@pytest.mark.slow
@pytest.mark.parametrize("name", SPAWNERS)
def test_it_ends_soon_and_with_a_reason(bounded: Measure, name: str) -> None:
    assert bounded("reading_spawners", name).startswith(REFUSED)
