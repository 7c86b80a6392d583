"""Figures of a surface: box, volume, convex hull, and whether it is closed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from checker.mesh.hull import convex_hull
from checker.mesh.joined import Joined
from checker.mesh.surface import NoSurface, Surface
from checker.model.mesh import Mesh
from checker.model.transform import Vector

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

FARTHEST = 1e30
"""Metres; beyond, engines that count in single precision overflow when they square it."""

THINNEST = 1e-8
"""Metres: nearer corners are one (trimesh's own tolerance), a lower triangle has no area."""


def measure(surface: Surface, path: str, format: str) -> Mesh:
    """Return a surface's figures.

    Raises:
        NoSurface: It has no triangles, or a corner that is nowhere.
    """
    if not len(surface.corners):
        raise NoSurface("contains no triangles")
    _refuse_lost_corners(surface.corners)
    joined = Joined.of(surface.corners)
    flat = _without_area(joined)
    points = joined.vertices
    hull, hull_volume = convex_hull(points)
    # A triangle whose corners are one leaves no hole where it is left out.
    joined = joined.only(_with_three_corners(joined))
    watertight, wound_alike = joined.is_closed()
    return Mesh(
        path=path,
        format=format,
        triangles=len(surface.corners),
        low=_vector(points.min(axis=0)),
        high=_vector(points.max(axis=0)),
        metres_per_unit=surface.metres_per_unit,
        hull=hull,
        volume=_volume(joined) if wound_alike else None,
        hull_volume=hull_volume,
        watertight=watertight,
        degenerate=int(flat.sum()),
        textures=surface.textures,
        materials=surface.materials,
        defects=surface.defects,
        parts=surface.parts,
    )


def _refuse_lost_corners(corners: NDArray[float64]) -> None:
    import numpy as np

    lost = ~(np.abs(corners) <= FARTHEST).all(axis=(1, 2))
    if lost.any():
        number = int(lost.argmax())
        written = ", ".join(f"{value:g}" for value in corners[number].flatten())
        raise NoSurface(
            f"has a corner without a finite position: triangle {number + 1:,} is {written}"
        )


def _with_three_corners(mesh: Joined) -> NDArray[bool_]:
    a, b, c = mesh.faces.T
    three: NDArray[bool_] = (a != b) & (b != c) & (c != a)
    return three


def _without_area(mesh: Joined) -> NDArray[bool_]:
    """Say of each triangle whether it is lower than `THINNEST`."""
    import numpy as np

    a, b, c = mesh.vertices[mesh.faces].transpose(1, 0, 2)
    longest = np.sqrt(np.max([((p - q) ** 2).sum(axis=1) for p, q in ((a, b), (b, c), (c, a))], 0))
    twice_area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    flat: NDArray[bool_] = twice_area <= THINNEST * longest
    return flat


def _volume(mesh: Joined) -> float | None:
    """Return the enclosed volume, m³, positive where the triangles face outwards."""
    import numpy as np

    # About its own middle, so that a far origin costs no digits.
    corners = mesh.vertices[mesh.faces] - mesh.vertices.mean(axis=0)
    a, b, c = corners.transpose(1, 0, 2)
    volume = float((a * np.cross(b, c)).sum() / 6.0)
    return volume if math.isfinite(volume) else None


def _vector(point: NDArray[float64]) -> Vector:
    return (float(point[0]), float(point[1]), float(point[2]))
