"""Boxes around shapes, along the axes of one frame."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record
from checker.model.geometry.convex import own_extent
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector
from checker.model.mesh import Meshes, NoMeshes

_NO_MESHES = NoMeshes()


class Box(Record):
    """A box along the axes of a frame.

    Attributes:
        low: The corner of the least x, y, z, metres.
        high: The corner of the greatest.
    """

    low: Vector
    high: Vector

    @property
    def centre(self) -> Vector:
        """The middle, metres."""
        x, y, z = ((a + b) / 2 for a, b in zip(self.low, self.high, strict=True))
        return (x, y, z)

    @property
    def diagonal(self) -> float:
        """Length from corner to corner, metres."""
        return math.dist(self.low, self.high)

    def grown(self, length: float) -> Box:
        """Return the box that reaches so many metres farther in each direction."""
        (a, b, c), (x, y, z) = self.low, self.high
        return Box((a - length, b - length, c - length), (x + length, y + length, z + length))

    def gap(self, other: Box) -> float:
        """Return the distance to another box, metres; 0 if they touch."""
        along_x, along_y, along_z = (
            max(self.low[i] - other.high[i], other.low[i] - self.high[i], 0.0) for i in range(3)
        )
        return math.hypot(along_x, along_y, along_z)


def box_around(
    shapes: Iterable[tuple[Geometry, Transform]], meshes: Meshes = _NO_MESHES
) -> Box | None:
    """Return the box around shapes, each with its pose in the frame of the box.

    None without shapes, and where one has no known extent (a mesh that is not known).
    """
    low, high = [math.inf] * 3, [-math.inf] * 3
    for geometry, pose in shapes:
        # A row of the rotation is an axis of the box as the shape sees it.
        for i, (axis, middle) in enumerate(zip(pose.rotation, pose.translation, strict=True)):
            reach = own_extent(geometry, axis, meshes)
            if reach is None:
                return None
            low[i], high[i] = min(low[i], middle + reach[0]), max(high[i], middle + reach[1])
    if not all(math.isfinite(corner) for corner in (*low, *high)):
        return None
    return Box((low[0], low[1], low[2]), (high[0], high[1], high[2]))


# Which of many boxes are near each other: a sweep along one axis.


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
            if _is_near(box, boxes[other], gap):
                yield other, number
        open_boxes.append(number)


def _longest_axis(boxes: Sequence[Box]) -> int:
    """Return the axis along which the middles of the boxes are spread most."""
    spreads = []
    for axis in range(3):
        middles = [box.centre[axis] for box in boxes]
        spreads.append(max(middles, default=0.0) - min(middles, default=0.0))
    return spreads.index(max(spreads))


def _is_near(box: Box, other: Box, gap: float) -> bool:
    return all(
        box.low[axis] - other.high[axis] <= gap and other.low[axis] - box.high[axis] <= gap
        for axis in range(3)
    )


def clusters(boxes: Sequence[Box], gap: float) -> list[list[int]]:
    """Return the numbers of boxes that are connected over gaps up to `gap` metres.

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
    groups: dict[int, list[int]] = {}
    for number in range(len(boxes)):
        groups.setdefault(lead(number), []).append(number)
    return list(groups.values())
