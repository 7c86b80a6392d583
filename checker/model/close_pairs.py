"""Which of many boxes are near each other: a sweep along one axis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from checker.model.boxes import Box

COMPARISONS = 400_000
"""The most comparisons of a sweep; 1 000 boxes in one heap need this many, a robot a hundredth."""


class TooManyPairs(Exception):
    """More boxes lie side by side than are compared."""


def close_pairs(
    boxes: Sequence[Box], gap: float, *, most: int = COMPARISONS
) -> Iterator[tuple[int, int]]:
    """Yield the numbers of boxes at most `gap` metres from each other, in every axis.

    Raises:
        TooManyPairs: After `most` comparisons.
    """
    axis = _longest_axis(boxes)
    order = sorted(range(len(boxes)), key=lambda number: boxes[number].low[axis])
    compared = 0
    open_boxes: list[int] = []
    for number in order:
        box = boxes[number]
        compared += len(open_boxes)
        if compared > most:
            raise TooManyPairs
        start = box.low[axis] - gap
        open_boxes = [other for other in open_boxes if boxes[other].high[axis] >= start]
        for other in open_boxes:
            if _near(box, boxes[other], gap):
                yield other, number
        open_boxes.append(number)


def _longest_axis(boxes: Sequence[Box]) -> int:
    """Return the axis along which the middles of the boxes are spread most."""
    spreads = []
    for axis in range(3):
        middles = [box.centre[axis] for box in boxes]
        spreads.append(max(middles, default=0.0) - min(middles, default=0.0))
    return spreads.index(max(spreads))


def _near(box: Box, other: Box, gap: float) -> bool:
    return all(
        box.low[axis] - other.high[axis] <= gap and other.low[axis] - box.high[axis] <= gap
        for axis in range(3)
    )


def clusters(boxes: Sequence[Box], gap: float) -> list[list[int]]:
    """Return the numbers of boxes that hang together over gaps up to `gap` metres.

    Raises:
        TooManyPairs: More boxes lie side by side than are compared.
    """
    leader = list(range(len(boxes)))

    def lead(number: int) -> int:
        while leader[number] != number:
            leader[number] = number = leader[leader[number]]
        return number

    for one, other in close_pairs(boxes, gap):
        leader[lead(other)] = lead(one)
    found: dict[int, list[int]] = {}
    for number in range(len(boxes)):
        found.setdefault(lead(number), []).append(number)
    return list(found.values())
