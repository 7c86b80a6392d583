"""A surface whose equal corners are one: which triangles meet, and how.

As trimesh finds it, down to the order of the corners, but without a third of a second to load it.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from checker.record import record

if TYPE_CHECKING:
    from numpy import bool_, float64, int64
    from numpy.typing import NDArray

_PER_METRE = 1e8
"""Corners that are one when rounded to 10 nm, as in trimesh, are the same."""


@record(eq=False)
class Joined:
    """Corners, and triangles that name them.

    Attributes:
        vertices: Metres (n × 3), in the order of their first triangles.
        faces: Numbers of corners (m × 3).
    """

    vertices: NDArray[float64]
    faces: NDArray[int64]

    @classmethod
    def of(cls, corners: NDArray[float64]) -> Joined:
        """Join the corners of triangles (m × 3 × 3)."""
        import numpy as np

        points = corners.reshape(-1, 3)
        rounded = np.ascontiguousarray((points * _PER_METRE).round().astype(np.int64))
        # Whole rows as bytes are sorted far quicker than three columns.
        rows = rounded.view(np.dtype((np.void, rounded.itemsize * 3))).ravel()
        _, first, row = np.unique(rows, return_index=True, return_inverse=True)
        order = first.argsort()
        number = np.empty_like(order)
        number[order] = np.arange(len(order))
        return cls(points[first[order]], number[row].reshape(-1, 3))

    def only(self, chosen: NDArray[bool_]) -> Joined:
        """Return the surface with some of its triangles."""
        return replace(self, faces=self.faces[chosen])

    def is_closed(self) -> tuple[bool, bool]:
        """Say whether two triangles meet at each edge; and if so, all with the same side out."""
        import numpy as np

        start, end = self.faces.ravel(), self.faces[:, (1, 2, 0)].ravel()
        edges = np.minimum(start, end) * len(self.vertices) + np.maximum(start, end)
        _, edge, counts = np.unique(edges, return_inverse=True, return_counts=True)
        watertight = bool(len(counts)) and bool((counts == 2).all())
        # Neighbours with the same side out go along their edge in opposite directions.
        turned = np.bincount(edge, np.sign(end - start))
        return watertight, watertight and not turned.any()
