"""Content of a mesh file: triangles by material, and the names in it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.model.mesh import MeshTrouble
from checker.physics.mesh.surface import GREY, Colour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

MOST = 32
"""Looks of one file; the triangles of all others get that of the most frequent of them."""


class Material(Record):
    """Appearance of the triangles of a material.

    Attributes:
        colour: The colour of triangles without a picture.
        picture: File as named inside; empty without one.
    """

    colour: Colour = GREY
    picture: str = ""


class Piece(Record, eq=False):
    """Triangles of one material.

    Attributes:
        corners: n triangles × 3 corners × (x, y, z), metres.
        material: What they look like.
        places: The place of each corner in the picture (n × 3 × 2; u to the right, v upwards, 0 to
            1 once across); None if the file does not state it.
        part: Name of the part of the file that they belong to; empty if that is not known.
    """

    corners: Array
    material: Material = Material()
    places: Array | None = None
    part: str = ""


class MeshContent(Record, eq=False):
    """Content of a mesh file, before it is measured.

    Attributes:
        pieces: Its triangles.
        metres_per_unit: The file's own unit, which is applied to the pieces.
        textures: Picture files as named inside.
        materials: Material files as named inside.
        defects: What is not valid for the format although programs read it, as clauses.
        bare: What has no vertex normals, as a clause; empty if all has.
        parts: Names of the parts inside.
    """

    pieces: tuple[Piece, ...]
    metres_per_unit: float = 1.0
    textures: tuple[str, ...] = ()
    materials: tuple[str, ...] = ()
    defects: tuple[str, ...] = ()
    bare: str = ""
    parts: tuple[str, ...] = ()

    def only(self, part: str) -> MeshContent:
        """Return one part of it."""
        pieces = tuple(piece for piece in self.pieces if piece.part == part)
        return MeshContent(pieces, self.metres_per_unit, parts=(part,))

    @property
    def corners(self) -> Array:
        """The corners of all triangles: n triangles × 3 corners × (x, y, z), metres."""
        import numpy as np

        if len(self.pieces) == 1:
            return self.pieces[0].corners
        return np.concatenate([np.empty((0, 3, 3)), *(piece.corners for piece in self.pieces)])


class NoSurface(Exception):
    """A file yields no triangles; it becomes a `MeshFault`.

    Attributes:
        reason: The end of a sentence whose subject is the file.
    """

    def __init__(self, reason: str, trouble: MeshTrouble = MeshTrouble.UNREADABLE) -> None:
        """Make it; by default the file is at fault."""
        super().__init__(reason)
        self.reason = reason
        self.trouble = trouble


def by_material(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """Return one piece for each material, at most `MOST`, large ones first."""
    groups: dict[tuple[Material, bool], list[Piece]] = {}
    for piece in pieces:
        groups.setdefault((piece.material, piece.places is None), []).append(piece)
    merged = sorted(map(_merged, groups.values()), key=lambda piece: -len(piece.corners))
    few = merged if len(merged) <= MOST else [*merged[: MOST - 1], _merged(merged[MOST - 1 :])]
    return tuple(few)


def _merged(pieces: list[Piece]) -> Piece:
    """Join pieces; the first one's material holds for all."""
    import numpy as np

    if len(pieces) == 1:
        return pieces[0]
    corners = np.concatenate([piece.corners for piece in pieces])
    places = [piece.places for piece in pieces if piece.places is not None]
    whole = len(places) == len(pieces)
    return Piece(corners, pieces[0].material, np.concatenate(places) if whole else None)
