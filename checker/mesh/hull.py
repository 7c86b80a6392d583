"""The convex hull of points, with a bound on its number of corners."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from checker.model.transform import Vector

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

MOST_CORNERS = 2_000
"""Of a hull; finer ones (spheres, organic shapes) lose corners, by less than 1 part in 1 000."""

_AT_ONCE = 100_000


def convex_hull(points: NDArray[float64]) -> tuple[tuple[Vector, ...], float]:
    """Return the corners of the convex hull, metres, and its volume, m³.

    No corners and no volume where all points lie in a plane. A hull of more than `MOST_CORNERS`
    is reduced to the corners that reach farthest in that many directions, spread evenly, and along
    the axes: its box stays exact. The volume is that of the whole hull.
    """
    from scipy.spatial import ConvexHull, QhullError

    if len(points) < 4:
        return (), 0.0
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return (), 0.0
    corners = points[hull.vertices]
    if len(corners) > MOST_CORNERS:
        corners = corners[_farthest(corners)]
    found = tuple((float(x), float(y), float(z)) for x, y, z in corners)
    return (found, float(hull.volume)) if math.isfinite(hull.volume) else ((), 0.0)


def _farthest(corners: NDArray[float64]) -> list[int]:
    """Return which corners reach farthest, each in one of many directions."""
    import numpy as np

    directions = np.concatenate([_spiral(MOST_CORNERS - 6), np.eye(3), -np.eye(3)])
    rows = max(1, _AT_ONCE * 100 // len(corners))
    chosen: set[int] = set()
    for start in range(0, len(directions), rows):
        reach = directions[start : start + rows] @ corners.T
        chosen.update(int(number) for number in reach.argmax(axis=1))
    return sorted(chosen)


def _spiral(number: int) -> NDArray[float64]:
    """Return unit vectors spread evenly: a spiral that turns by the golden angle."""
    import numpy as np

    steps = np.arange(number)
    height = 1.0 - (2.0 * steps + 1.0) / number
    angle = steps * math.pi * (3.0 - math.sqrt(5.0))
    side = np.sqrt(1.0 - height**2)
    return np.stack([side * np.cos(angle), side * np.sin(angle), height], axis=1)
