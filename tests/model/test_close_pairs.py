"""Which boxes are near each other, and which hang together."""

from __future__ import annotations

from itertools import combinations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.model.geometry.boxes import Box, TooManyPairs, close_pairs, clusters

CORNER = st.tuples(*[st.floats(-3, 3)] * 3)
SIZE = st.tuples(*[st.floats(0, 2)] * 3)


def box(corner: tuple[float, ...], size: tuple[float, ...]) -> Box:
    (x, y, z), (a, b, c) = corner, size
    return Box((x, y, z), (x + a, y + b, z + c))


@given(st.lists(st.builds(box, CORNER, SIZE), max_size=12), st.floats(-0.5, 0.5))
def test_the_sweep_finds_what_comparing_all_finds(boxes: list[Box], gap: float) -> None:
    near = {
        (i, j)
        for i, j in combinations(range(len(boxes)), 2)
        if all(
            boxes[i].low[axis] - boxes[j].high[axis] <= gap
            and boxes[j].low[axis] - boxes[i].high[axis] <= gap
            for axis in range(3)
        )
    }
    found = [(min(pair), max(pair)) for pair in close_pairs(boxes, gap)]
    # A box thinner than a negative gap is not even near itself, and leaves the sweep early.
    assert set(found) == near if gap >= 0 else set(found) <= near
    assert len(found) == len(set(found))


def test_what_hangs_together_over_others_is_one_cluster() -> None:
    row = [box((x, 0, 0), (1, 1, 1)) for x in (0.0, 2.02, 1.01, 9.0)]
    assert sorted(map(sorted, clusters(row, 0.02))) == [[0, 1, 2], [3]]
    assert len(clusters(row, 0.0)) == 4
    assert clusters([], 0.1) == []


def test_a_row_of_many_takes_few_comparisons() -> None:
    row = [box((0, float(i), 0), (1, 0.5, 1)) for i in range(5000)]
    assert len(clusters(row, 0.1)) == 5000


def test_a_heap_of_many_is_not_compared_to_the_end() -> None:
    heap = [box((0, 0, 0), (1, 1, 1))] * 5000
    with pytest.raises(TooManyPairs):
        clusters(heap, 0.1)
