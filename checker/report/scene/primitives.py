"""Simple shapes as triangles, centred at the origin; of size 1, so that all of a kind share one."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from itertools import pairwise, product
from typing import TYPE_CHECKING, Any

from checker.physics.mesh.surface import Surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

AROUND = 32
"""Corners of a circle; a multiple of 4, so that its box is exact along x and y."""
_ARCS = 8
"""Steps of a quarter circle."""

Point = tuple[float, float, float, float]
"""A point of a profile: distance from the z axis, z, and the normal's parts outward and along z."""


@cache
def box() -> Surface:
    """Return a cube with edges of length 1."""
    import numpy as np

    corners = np.array(list(product((-0.5, 0.5), repeat=3)), dtype=np.float32)
    sides = ((0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3))
    return Surface(corners, quads(sides))


@cache
def rectangle() -> Surface:
    """Return a square with edges of length 1 that faces z."""
    import numpy as np

    corners = np.array(
        [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)], dtype=np.float32
    )
    return Surface(corners, quads(((0, 1, 2, 3),)))


@cache
def cylinder() -> Surface:
    """Return a cylinder of radius 1 and length 1 along z."""
    return revolve(tube(1.0, -0.5, 0.5))


@cache
def cone() -> Surface:
    """Return a cone of radius 1 and length 1, its tip up."""
    return revolve(cone_profile(1.0, -0.5, 0.5))


@cache
def sphere() -> Surface:
    """Return a sphere of radius 1."""
    return capsule(1.0, 0.0)


@cache
def capsule(radius: float, length: float) -> Surface:
    """Return a capsule along z.

    Args:
        radius: Metres.
        length: Without its round ends, metres.
    """
    half = length / 2
    angles = [math.pi / 2 * step / _ARCS for step in range(_ARCS + 1)]
    # Rounded sines would leave a pin hole at the poles.
    arc = [(math.cos(a) if a < math.pi / 2 else 0.0, math.sin(a)) for a in angles]
    lower = [(radius * c, -half - radius * s, c, -s) for c, s in reversed(arc)]
    upper = [(radius * c, half + radius * s, c, s) for c, s in arc]
    return revolve([*lower, *upper] if length else [*lower, *upper[1:]])


def tube(radius: float, low: float, high: float) -> list[Point]:
    """Return the profile of a closed cylinder."""
    return [
        (0.0, low, 0.0, -1.0),
        (radius, low, 0.0, -1.0),
        (radius, low, 1.0, 0.0),
        (radius, high, 1.0, 0.0),
        (radius, high, 0.0, 1.0),
        (0.0, high, 0.0, 1.0),
    ]


def cone_profile(radius: float, low: float, high: float) -> list[Point]:
    """Return the profile of a cone whose tip is up."""
    slant = math.hypot(radius, high - low)
    out, up = (high - low) / slant, radius / slant
    return [
        (0.0, low, 0.0, -1.0),
        (radius, low, 0.0, -1.0),
        (radius, low, out, up),
        (0.0, high, out, up),
    ]


def revolve(profile: Sequence[Point]) -> Surface:
    """Return what a profile leaves when it turns about z.

    Args:
        profile: The profile from below upwards along the outside; corners are there twice, once for
            each normal.
    """
    import numpy as np

    angles = 2 * np.pi * np.arange(AROUND) / AROUND
    turned = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    turned[np.abs(turned) < 1e-15] = 0.0
    radius, height, out, up = (np.array(column)[:, None] for column in zip(*profile, strict=True))

    def around(across: Array, along: Array) -> Array:
        flat = across[:, :, None] * turned
        z = np.broadcast_to(along[:, :, None], (len(profile), AROUND, 1))
        joined: Array = np.concatenate([flat, z], axis=2).reshape(-1, 3).astype(np.float32)
        return joined

    return Surface(around(radius, height), _rings(profile), normals=around(out, up))


def _rings(profile: Sequence[Point]) -> Array:
    """Return the triangles between neighbouring rings, without those that have no area."""
    import numpy as np

    here = np.arange(AROUND)
    there = np.roll(here, -1)
    faces = []
    for number, (low, high) in enumerate(pairwise(profile)):
        below, above = number * AROUND, (number + 1) * AROUND
        if low[:2] == high[:2]:
            continue
        if low[0] > 0.0:
            faces.append(np.stack([below + here, below + there, above + there], axis=1))
        if high[0] > 0.0:
            faces.append(np.stack([below + here, above + there, above + here], axis=1))
    return np.concatenate(faces).astype(np.uint32)


def quads(corners: Sequence[Sequence[int]]) -> Array:
    """Return two triangles for each four corners."""
    import numpy as np

    four = np.array(corners, dtype=np.uint32)
    return np.concatenate([four[:, [0, 1, 2]], four[:, [0, 2, 3]]])


def bar(start: Sequence[float], end: Sequence[float], width: float) -> Surface:
    """Return a thin square bar between two points.

    Args:
        start: x, y, z in metres.
        end: Another point.
        width: Metres.
    """
    import numpy as np

    first, last = np.array(start, dtype=float), np.array(end, dtype=float)
    along = (last - first) / max(float(np.linalg.norm(last - first)), 1e-12)
    aside = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    aside /= max(float(np.linalg.norm(aside)), 1e-12)
    axes = np.stack([last - first, width * aside, width * np.cross(along, aside)])
    return Surface((box().vertices @ axes + (first + last) / 2).astype(np.float32), box().faces)


def merge_surfaces(parts: Sequence[Surface]) -> Surface:
    """Return surfaces without normals as one, with the colour of the first."""
    import numpy as np

    starts = np.cumsum([0, *(len(part.vertices) for part in parts[:-1])])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=True)]
    return Surface(
        np.concatenate([part.vertices for part in parts]),
        np.concatenate(faces).astype(np.uint32),
        parts[0].colour,
    )
