"""Intersections of rays with boxes, cylinders and other shapes, and with triangles."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from checker.physics.views.rays import Grid, Steps

if TYPE_CHECKING:
    from numpy import bool_, float64, int64
    from numpy.typing import NDArray

    Array = NDArray[float64]
    Whole = NDArray[int64]
    Range = tuple[Whole, Whole]
    Between = tuple[Array, Array]
    """Metres along each ray (shapes × rays) at which it enters and leaves; NaN if it misses."""


# Where rays meet the outer sides of triangles.
#
# Each triangle is in a ball, and so in a cone around the direction of its middle, and so within a
# range of azimuth and of elevation: only the rays of the grid within that range are tried. Small
# triangles have none or one, so the work grows with their number and not with that of the rays.


_AT_ONCE = 300_000
"""Pairs of triangle and ray that are tried in one go: 50 MB."""
_FARTHEST = 1e100
"""Metres."""
_SLACK = 1e-7
"""Radians that a cone is wider than it must be."""


def first_hits(corners: Array, grid: Grid) -> tuple[Array, NDArray[bool_]]:
    """Return for each ray of a grid where it first meets a triangle that the sensor sees.

    That is in metres along the ray, inf where it meets none; and whether it meets one that is
    nearer than the sensor sees.

    Args:
        corners: The corners of triangles (n × 3 × 3), metres, in the sensor's frame;
            counter-clockwise seen from outside.
        grid: The sensor's rays.
    """
    import numpy as np

    first = np.full(len(grid.directions), np.inf)
    cut = np.zeros(len(grid.directions), bool)
    with np.errstate(all="ignore"):
        a, b, c = corners.transpose(1, 0, 2)
        volume = np.einsum("ij,ij->i", a, np.cross(b - a, c - a))
        # The origin is outside of it, and its numbers are numbers.
        corners = corners[volume < 0.0]
        for triangles, rays in _candidates(corners, grid):
            reach = _reach(corners[triangles], grid.directions[rays])
            near = grid.near_along[rays]
            seen = (reach >= near) & (reach <= grid.far)
            np.minimum.at(first, rays[seen], reach[seen])
            cut[rays[(reach > 0.0) & (reach < near)]] = True
    return first, cut


def ball_around(corners: Array) -> tuple[Array, float]:
    """Return middle (3) and radius of the ball around the box around triangles (n × 3 × 3)."""
    points = corners.reshape(-1, 3)
    low, high = points.min(axis=0), points.max(axis=0)
    return (low + high) / 2.0, math.dist(low, high) / 2.0


def in_view(middle: Array, radius: float, grid: Grid) -> bool:
    """Return whether a ray of a grid may meet what is within a ball.

    Args:
        middle: The centre of the ball (3), metres, in the sensor's frame.
        radius: Metres.
        grid: The sensor's rays.
    """
    import numpy as np

    # Their squares overflow; and behind the poles a cone has no elevation.
    if not (np.abs([*middle, radius]) < _FARTHEST).all() or grid.up.reach > math.pi / 2.0:
        return True
    with np.errstate(all="ignore"):
        rows, columns = _rows_in_cones(*_cones(middle[None, :], np.array([radius])), grid)
    return bool(rows[1][0]) and any(column[1][0] for column in columns)


def _reach(corners: Array, rays: Array) -> Array:
    """Return the metres along each ray to its triangle, which faces the origin; NaN for a miss."""
    import numpy as np

    a, b, c = corners.transpose(1, 0, 2)
    shares = [
        np.einsum("ij,ij->i", rays, np.cross(one, other)) for one, other in ((b, c), (c, a), (a, b))
    ]
    inside = (shares[0] <= 0.0) & (shares[1] <= 0.0) & (shares[2] <= 0.0)
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    distance: Array = np.where(inside, volume / (shares[0] + shares[1] + shares[2]), np.nan)
    return distance


def _candidates(corners: Array, grid: Grid) -> Iterator[tuple[Whole, Whole]]:
    """Yield numbers of triangles and of rays that may meet, pair by pair."""
    import numpy as np

    middles = corners.mean(axis=1)
    radii = np.sqrt(((corners - middles[:, None, :]) ** 2).sum(axis=2).max(axis=1))
    rows, turns = _rows_in_cones(*_cones(middles, radii), grid)
    for columns in turns:
        yield from _pairs(rows, columns, grid.across.number)


def _rows_in_cones(
    azimuth: Array, elevation: Array, wide: Array, high: Array, grid: Grid
) -> tuple[Range, list[Range]]:
    """Return the rows of a grid that are within cones, and its columns: those of each turn."""
    import numpy as np

    rows = _range(grid.up, elevation - high, elevation + high)
    columns = []
    around = np.mod(azimuth - grid.across.middle + math.pi, 2 * math.pi) - math.pi
    around += grid.across.middle
    for turn in (-2 * math.pi, 0.0, 2 * math.pi):
        middle = around + turn
        start = np.where(wide < math.pi, middle - wide, -np.inf if turn == 0.0 else np.inf)
        end = np.where(wide < math.pi, middle + wide, np.inf)
        columns.append(_range(grid.across, start, end))
    return rows, columns


def _cones(middle: Array, radius: Array) -> tuple[Array, Array, Array, Array]:
    """Return azimuth and elevation of the middles of balls, and how far these reach from them."""
    import numpy as np

    distance = np.sqrt((middle**2).sum(axis=1))
    half = np.where(radius < distance, np.arcsin(np.minimum(radius / distance, 1.0)), math.pi)
    half = half + _SLACK
    azimuth = np.arctan2(middle[:, 1], middle[:, 0])
    sine = np.where(distance > 0.0, middle[:, 2] / distance, 0.0)
    elevation = np.arcsin(np.clip(sine, -1.0, 1.0))
    over_pole = half + np.abs(elevation) >= math.pi / 2
    wide = np.arcsin(np.minimum(np.sin(half) / np.cos(elevation), 1.0)) + _SLACK
    return azimuth, elevation, np.where(over_pole, math.pi, wide), half


def _range(steps: Steps, low: Array, high: Array) -> Range:
    """Return the first of the steps in each range, and how many there are."""
    import numpy as np

    first = np.ceil(np.clip((low - steps.first) / steps.step, 0, steps.number)).astype(int)
    last = np.floor(np.clip((high - steps.first) / steps.step, -1, steps.number - 1)).astype(int)
    return first, np.maximum(last - first + 1, 0)


def _pairs(rows: Range, columns: Range, across: int) -> Iterator[tuple[Whole, Whole]]:
    import numpy as np

    counts = rows[1] * columns[1]
    chosen = np.flatnonzero(counts)
    ends = counts[chosen].cumsum()
    start = 0
    while start < len(chosen):
        done = ends[start - 1] if start else 0
        stop = max(int(np.searchsorted(ends, done + _AT_ONCE, "right")), start + 1)
        part = chosen[start:stop]
        triangles = part.repeat(counts[part])
        number = np.arange(len(triangles)) - (ends[start:stop] - counts[part] - done).repeat(
            counts[part]
        )
        row = rows[0][triangles] + number // columns[1][triangles]
        column = columns[0][triangles] + number % columns[1][triangles]
        yield triangles, row * across + column
        start = stop


# Arguments: sizes (shapes × …), the rays' common origin (shapes × 3) and their directions
# (shapes × rays × 3), all in each shape's own frame.


def _box(sizes: Array, origin: Array, rays: Array) -> Between:
    import numpy as np

    half, start = sizes[:, None, :] / 2.0, origin[:, None, :]
    one, other = (-half - start) / rays, (half - start) / rays
    return np.minimum(one, other).max(axis=2), np.maximum(one, other).min(axis=2)


def _ellipsoid(radii: Array, origin: Array, rays: Array) -> Between:
    import numpy as np

    start, along = (origin / radii)[:, None, :], rays / radii[:, None, :]
    return _roots(
        (along**2).sum(axis=2), (start * along).sum(axis=2), (np.square(start)).sum(axis=2) - 1.0
    )


def _sphere(radius: Array, origin: Array, rays: Array) -> Between:
    return _ellipsoid(radius.repeat(3, axis=1), origin, rays)


def _cylinder(sizes: Array, origin: Array, rays: Array) -> Between:
    import numpy as np

    radius, length = sizes[:, :1], sizes[:, 1:]
    x, y = rays[:, :, 0], rays[:, :, 1]
    across = (origin[:, :2] ** 2).sum(axis=1, keepdims=True) - radius**2
    square = x**2 + y**2
    enters, leaves = _roots(square, x * origin[:, :1] + y * origin[:, 1:2], across)
    # Along the axis the wall is never met.
    straight = square == 0.0
    enters = np.where(straight, np.where(across <= 0.0, -np.inf, np.nan), enters)
    leaves = np.where(straight, np.where(across <= 0.0, np.inf, np.nan), leaves)
    one = (-length / 2.0 - origin[:, 2:]) / rays[:, :, 2]
    other = (length / 2.0 - origin[:, 2:]) / rays[:, :, 2]
    return np.maximum(enters, np.minimum(one, other)), np.minimum(leaves, np.maximum(one, other))


def _capsule(sizes: Array, origin: Array, rays: Array) -> Between:
    import numpy as np

    enters, leaves = _cylinder(sizes, origin, rays)
    whole = leaves >= enters
    enters, leaves = np.where(whole, enters, np.nan), np.where(whole, leaves, np.nan)
    for side in (-0.5, 0.5):
        offset = np.zeros_like(origin)
        offset[:, 2] = side * sizes[:, 1]
        first, last = _sphere(sizes[:, :1], origin - offset, rays)
        enters, leaves = np.fmin(enters, first), np.fmax(leaves, last)
    return enters, leaves


def _roots(square: Array, half_linear: Array, constant: Array) -> Between:
    import numpy as np

    root = np.sqrt(half_linear**2 - square * constant)
    return (-half_linear - root) / square, (-half_linear + root) / square


SOLIDS: dict[str, tuple[tuple[str, ...], Callable[[Array, Array, Array], Between]]] = {
    "box": (("size",), _box),
    "sphere": (("radius",), _sphere),
    "cylinder": (("radius", "length"), _cylinder),
    "capsule": (("radius", "length"), _capsule),
    "ellipsoid": (("radii",), _ellipsoid),
}
"""The names of the lengths of each shape, in order, and its function."""


def entry_distances(kind: str, sizes: Array, origin: Array, rays: Array) -> Array:
    """Return the metres along each ray at which it enters each shape from outside; else NaN.

    Args:
        kind: One of `SOLIDS`.
        sizes: Lengths, metres (shapes × as many as the kind has).
        origin: The start of the rays in each shape's frame (shapes × 3).
        rays: Unit vectors, in each shape's frame (shapes × rays × 3).
    """
    import numpy as np

    with np.errstate(all="ignore"):
        enters, leaves = SOLIDS[kind][1](sizes, origin, rays)
        distance: Array = np.where((enters > 0.0) & (enters <= leaves), enters, np.nan)
    return distance
