"""Where rays enter and leave boxes, cylinders and the like, many shapes of one kind at once."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    Array = NDArray[float64]
    Between = tuple[Array, Array]
    """Metres along each ray (shapes × rays) at which it enters and leaves; NaN where it misses."""

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
"""By shape: the names of its lengths, in the order in which they are given, and its function."""


def entered(kind: str, sizes: Array, origin: Array, rays: Array) -> Array:
    """Return the metres along each ray at which it enters each shape from outside; else NaN.

    Args:
        kind: One of `SOLIDS`.
        sizes: Lengths, metres (shapes × as many as the kind has).
        origin: Where the rays start, in each shape's frame (shapes × 3).
        rays: Unit vectors, in each shape's frame (shapes × rays × 3).
    """
    import numpy as np

    with np.errstate(all="ignore"):
        enters, leaves = SOLIDS[kind][1](sizes, origin, rays)
        found: Array = np.where((enters > 0.0) & (enters <= leaves), enters, np.nan)
    return found
