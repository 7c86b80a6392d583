"""Boxes around shapes, along the axes of one frame."""

from __future__ import annotations

import math
from collections.abc import Iterable

from checker.model.mesh import Meshes, NoMeshes
from checker.model.shapes import Geometry
from checker.model.support import own_extent
from checker.model.transform import Transform, Vector
from checker.record import record

_NO_MESHES = NoMeshes()


@record()
class Box:
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

    def gap(self, other: Box) -> float:
        """Return the distance to another box, metres; 0 where they touch."""
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
