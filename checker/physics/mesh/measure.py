"""Figures of a surface: box, volume, convex hull, and whether it is closed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.record import Record
from checker.model.geometry.bodies import POINT, Matrix
from checker.model.geometry.transform import Vector
from checker.model.mesh import Mesh
from checker.physics.mesh.content import MeshContent, NoSurface

if TYPE_CHECKING:
    from numpy import bool_, float64, int64
    from numpy.typing import NDArray


# A surface whose equal corners are one: which triangles meet, and how.
#
# As trimesh finds it, down to the order of the corners, but without a third of a second to load it.


_PER_METRE = 1e8
"""Corners that are one when rounded to 10 nm, as in trimesh, are the same."""


class Joined(Record, eq=False):
    """Corners, and triangles that name them.

    Attributes:
        vertices: Metres (n × 3), in the order of their first triangles.
        faces: Numbers of corners (m × 3).
    """

    vertices: NDArray[float64]
    faces: NDArray[int64]

    @classmethod
    def from_corners(cls, corners: NDArray[float64]) -> Joined:
        """Join the corners of triangles (m × 3 × 3)."""
        import numpy as np

        points = corners.reshape(-1, 3)
        rounded = np.ascontiguousarray((points * _PER_METRE).round().astype(np.int64))
        first, row = _alike(rounded)
        order = first.argsort()
        number = np.empty_like(order)
        number[order] = np.arange(len(order))
        return cls(points[first[order]], number[row].reshape(-1, 3))

    def only(self, chosen: NDArray[bool_]) -> Joined:
        """Return the surface with some of its triangles."""
        return replace(self, faces=self.faces[chosen])

    def is_closed(self) -> tuple[bool, bool]:
        """Return whether two triangles meet at each edge; and if so, all with the same side out."""
        import numpy as np

        start, end = self.faces.ravel(), self.faces[:, (1, 2, 0)].ravel()
        edges = np.minimum(start, end) * len(self.vertices) + np.maximum(start, end)
        _, edge, counts = np.unique(edges, return_inverse=True, return_counts=True)
        watertight = bool(len(counts)) and bool((counts == 2).all())
        # Neighbours with the same side out go along their edge in opposite directions.
        turned = np.bincount(edge, np.sign(end - start))
        return watertight, watertight and not turned.any()


def _alike(rows: NDArray[int64]) -> tuple[NDArray[int64], NDArray[int64]]:
    """Return the first row of each kind (k), and of each row the number of its kind (n)."""
    import numpy as np

    # One number a row is sorted far quicker than the row, if no two kinds have the same one.
    mixed = (rows.astype(np.uint64) * np.array(_MIX, np.uint64)).sum(axis=1, dtype=np.uint64)
    _, first, kind = np.unique(mixed, return_index=True, return_inverse=True)
    if not (rows[first][kind] == rows).all():
        as_bytes = rows.view(np.dtype((np.void, rows.itemsize * 3))).ravel()
        _, first, kind = np.unique(as_bytes, return_index=True, return_inverse=True)
    return first, kind


_MIX = (0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9)
"""Odd, and without a pattern in their bits."""


# The convex hull of points, with a bound on its number of corners.


MOST_CORNERS = 2_000
"""Corners of a hull; finer ones (such as spheres) lose corners, by less than 1 part in 1 000."""

_AT_ONCE = 100_000


def convex_hull(
    points: NDArray[float64],
) -> tuple[tuple[Vector, ...], float, NDArray[float64]]:
    """Return the corners of the convex hull, metres, its volume, m³, and its facets (m × 3 × 3).

    Nothing of these where all points are in a plane. A hull of more than `MOST_CORNERS` is reduced
    to the corners that reach farthest in that many directions, spread evenly, and along the axes:
    its box stays exact. Volume and facets are those of the whole hull; which side of a facet is
    outside is left open.
    """
    import numpy as np
    from scipy.spatial import ConvexHull, QhullError

    nothing = (), 0.0, np.empty((0, 3, 3))
    if len(points) < 4:
        return nothing
    try:
        hull = ConvexHull(points)
    except (QhullError, ValueError):
        return nothing
    corners = points[hull.vertices]
    if len(corners) > MOST_CORNERS:
        corners = corners[_farthest(corners)]
    vertices = tuple((float(x), float(y), float(z)) for x, y, z in corners)
    if not math.isfinite(hull.volume):
        return nothing
    return vertices, float(hull.volume), points[hull.simplices]


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


FARTHEST = 1e30
"""Metres; beyond, engines that count in single precision overflow when they square it."""

THINNEST = 1e-8
"""Metres: nearer corners are one (trimesh's own tolerance), a lower triangle has no area."""


def measure(content: MeshContent, path: str, format: str) -> Mesh:
    """Return the figures of a file.

    Raises:
        NoSurface: It has no triangles, or a corner that is nowhere.
    """
    corners = content.corners
    if not len(corners):
        raise NoSurface("contains no triangles")
    _refuse_lost_corners(corners)
    joined = Joined.from_corners(corners)
    flat = _without_area(joined)
    points = joined.vertices
    hull, hull_volume, facets = convex_hull(points)
    # A triangle whose corners are one leaves no hole where it is left out.
    joined = joined.only(_with_three_corners(joined))
    watertight, wound_alike = joined.is_closed()
    volume = _volume(joined) if wound_alike else None
    surface = joined.vertices[joined.faces] if volume else facets
    centre, spread = even_spread(surface, convex=not volume)
    return Mesh(
        path=path,
        format=format,
        triangles=len(corners),
        low=_vector(points.min(axis=0)),
        high=_vector(points.max(axis=0)),
        metres_per_unit=content.metres_per_unit,
        hull=hull,
        volume=volume,
        hull_volume=hull_volume,
        centre=centre,
        spread=spread,
        watertight=watertight,
        degenerate=int(flat.sum()),
        textures=content.textures,
        materials=content.materials,
        defects=content.defects,
        bare=content.bare,
        parts=content.parts,
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
    """State of each triangle whether it is lower than `THINNEST`."""
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


def even_spread(triangles: NDArray[float64], *, convex: bool = False) -> tuple[Vector, Matrix]:
    """Return the centre and the spread of what triangles enclose (see `Body`).

    Args:
        triangles: Corners (n × 3 × 3), metres.
        convex: Whether the surface is convex and which sides are outside is not known.
    """
    import numpy as np

    if not len(triangles):
        return (0.0, 0.0, 0.0), POINT
    middle = triangles.reshape(-1, 3).mean(axis=0)
    a, b, c = (triangles - middle).transpose(1, 0, 2)
    sixfold = (a * np.cross(b, c)).sum(axis=1)
    sixfold = np.abs(sixfold) if convex else sixfold
    total = float(sixfold.sum())
    if not total or not math.isfinite(total):
        return _vector(middle), POINT
    # The mean over a tetrahedron with a corner in the middle.
    shares, ends = sixfold / total, a + b + c
    centre = shares @ ends / 4
    products = sum(np.einsum("n,ni,nj->ij", shares, each, each) for each in (a, b, c, ends)) / 20
    x, y, z = products - np.outer(centre, centre)
    return _vector(middle + centre), (_vector(x), _vector(y), _vector(z))


def _vector(point: NDArray[float64]) -> Vector:
    return (float(point[0]), float(point[1]), float(point[2]))
