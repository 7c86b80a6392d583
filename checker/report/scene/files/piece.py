"""Triangles of a mesh file that look alike, before they are painted and thinned out."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.report.scene.surface import GREY, Colour

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

MOST = 32
"""Looks of one file; the triangles of all others get that of the most frequent of them."""


class Look(Record):
    """What a material does to its triangles.

    Attributes:
        colour: Of what has no picture.
        picture: File as named inside; empty without one.
    """

    colour: Colour = GREY
    picture: str = ""


class Piece(Record, eq=False):
    """Triangles of one look.

    Attributes:
        corners: n triangles × 3 corners × (x, y, z), metres.
        look: How.
        places: Where each corner lies in the picture (n × 3 × 2; u to the right, v upwards, 0 to 1
            once across); None where the file does not say.
    """

    corners: Array
    look: Look = Look()
    places: Array | None = None


def by_look(pieces: Iterable[Piece]) -> tuple[Piece, ...]:
    """Return one piece for each look, at most `MOST`, large ones first."""
    groups: dict[tuple[Look, bool], list[Piece]] = {}
    for piece in pieces:
        groups.setdefault((piece.look, piece.places is None), []).append(piece)
    merged = sorted(map(_merged, groups.values()), key=lambda piece: -len(piece.corners))
    few = merged if len(merged) <= MOST else [*merged[: MOST - 1], _merged(merged[MOST - 1 :])]
    return tuple(few)


def _merged(pieces: list[Piece]) -> Piece:
    """Join pieces; the first one's look holds for all."""
    import numpy as np

    if len(pieces) == 1:
        return pieces[0]
    corners = np.concatenate([piece.corners for piece in pieces])
    places = [piece.places for piece in pieces if piece.places is not None]
    whole = len(places) == len(pieces)
    return Piece(corners, pieces[0].look, np.concatenate(places) if whole else None)
