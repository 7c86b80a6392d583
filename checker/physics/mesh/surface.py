"""Triangles of one colour or with coloured corners: as JSON, and made fewer."""

from __future__ import annotations

import base64
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from checker.base.record import Record

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


Colour = tuple[float, float, float, float]
"""Red, green, blue and alpha as sRGB has them, 0 to 1."""

GREY: Colour = (0.7, 0.7, 0.7, 1.0)


class Surface(Record, eq=False):
    """Triangles of one material.

    Attributes:
        vertices: Corners, metres (n × 3, float32).
        faces: Three numbers of corners a triangle, counter-clockwise from outside (m × 3, uint32).
        colour: The colour of all triangles; vertex colours are multiplied with it.
        vertex_colours: sRGB red, green, blue and alpha of each corner (n × 4, uint8), or None.
        normals: Unit vectors of smooth surfaces (n × 3, float32); None lets every triangle be flat.
    """

    vertices: Array
    faces: Array
    colour: Colour = GREY
    vertex_colours: Array | None = None
    normals: Array | None = None


Appearance = tuple[Surface, ...] | str
"""The surfaces of a file, or why there are none."""


def appearance_to_json(read: Appearance) -> dict[str, Any]:
    """Return what JSON can express; see `appearance_from_json`."""
    if isinstance(read, str):
        return {"reason": read}
    return {"surfaces": [surface_to_json(surface) for surface in read]}


def appearance_from_json(data: Any) -> Appearance:
    """Return what `appearance_to_json` was given.

    Raises:
        ValueError: It is something else.
    """
    try:
        if "reason" in data:
            return str(data["reason"])
        return tuple(surface_from_json(surface) for surface in data["surfaces"])
    except (TypeError, KeyError, AttributeError) as error:
        raise ValueError(f"no surfaces: {error}") from error


def surface_to_json(surface: Surface) -> dict[str, Any]:
    """Return what JSON can express; see `surface_from_json`. Normals are left out."""
    colours = surface.vertex_colours
    return {
        "vertices": _packed(surface.vertices, "<f4"),
        "faces": _packed(surface.faces, "<u4"),
        "colour": surface.colour,
        "vertex_colours": None if colours is None else _packed(colours, "u1"),
    }


def surface_from_json(data: Any) -> Surface:
    """Return a surface whose triangles name corners that it has.

    Raises:
        ValueError: They do not, or a number is none.
    """
    import numpy as np

    vertices = _unpacked(data["vertices"], "<f4", 3)
    faces = _unpacked(data["faces"], "<u4", 3)
    packed = data["vertex_colours"]
    colours = None if packed is None else _unpacked(packed, "u1", 4)
    if not np.isfinite(vertices).all() or faces.max(initial=0) >= max(len(vertices), 1):
        raise ValueError("a corner is nowhere")
    if colours is not None and len(colours) != len(vertices):
        raise ValueError("a corner has no colour")
    red, green, blue, alpha = (min(max(float(number), 0.0), 1.0) for number in data["colour"])
    return Surface(vertices, faces, (red, green, blue, alpha), colours)


def _packed(numbers: Array, kind: str) -> str:
    return base64.b64encode(numbers.astype(kind).tobytes()).decode()


def _unpacked(packed: str, kind: str, width: int) -> Array:
    import numpy as np

    # binascii.Error is a ValueError.
    return np.frombuffer(base64.b64decode(packed), kind).reshape(-1, width)


# Surfaces with few enough triangles: equal corners made one, then edges collapsed.


SMALL = 2000
"""Triangles; what has no more keeps all of them where there is room."""


def shares(counts: Sequence[int], budget: int, small: int = SMALL) -> list[int]:
    """Return how many triangles each of several parts may have, `budget` in all.

    Each keeps up to `small` of its own, and the same share of the others.

    Args:
        counts: The number of each of them.
        budget: The number for all of them.
        small: At most.
    """
    if sum(counts) <= budget:
        return list(counts)
    kept = [min(count, small, budget // len(counts)) for count in counts]
    left = sum(counts) - sum(kept)
    room = budget - sum(kept)
    return [low + room * (count - low) // left for count, low in zip(counts, kept, strict=True)]


def merge_corners(
    corners: Array, colour: Colour, colours: Array | None, places: Array | None
) -> Surface:
    """Return triangles that share their corners.

    Args:
        corners: Metres (n × 3 × 3).
        colour: The colour of all of them.
        colours: The colours of the corners (n × 3 × 4, uint8), averaged where corners become one.
        places: The places in a picture (n × 3 × 2); corners with different ones stay apart.
    """
    import numpy as np

    # Adding 0 makes -0 equal to it.
    points = np.ascontiguousarray(corners, np.float32).reshape(-1, 3) + np.float32(0.0)
    rows = points
    if colours is not None and places is not None:
        rows = np.hstack([points, places.reshape(-1, 2).astype(np.float32)])
    as_bytes = np.ascontiguousarray(rows).view(np.dtype((np.void, rows.shape[1] * 4))).ravel()
    _, first, number = np.unique(as_bytes, return_index=True, return_inverse=True)
    mixed = None if colours is None else _averaged(colours.reshape(-1, 4), number, len(first))
    faces = number.reshape(-1, 3).astype(np.uint32)
    three = (faces != np.roll(faces, 1, axis=1)).all(axis=1)
    return Surface(points[first], faces[three], colour, mixed)


def _averaged(colours: Array, number: Array, count: int) -> Array:
    import numpy as np

    uses = np.bincount(number, minlength=count)
    sums = [np.bincount(number, channel, count) / uses for channel in colours.T]
    return np.stack(sums, axis=1).round().astype(np.uint8)


def thinned(surface: Surface, most: int) -> Surface:
    """Return a surface with at most some number of triangles.

    Edges are collapsed where that changes the surface least (quadric error metrics, Garland and
    Heckbert 1997). Where nothing more can be collapsed, the smallest triangles are left out.
    """
    import numpy as np

    if len(surface.faces) <= most:
        return surface
    vertices, faces, colours = _collapsed(surface, most)
    if len(faces) > most:
        a, b, c = vertices[faces].transpose(1, 0, 2)
        area = (np.cross(b - a, c - a) ** 2).sum(axis=1)
        faces = faces[np.sort(np.argsort(-area, kind="stable")[:most])]
    used, number = np.unique(faces, return_inverse=True)
    return Surface(
        vertices[used],
        number.reshape(-1, 3).astype(np.uint32),
        surface.colour,
        None if colours is None else colours[used],
    )


def _collapsed(surface: Surface, most: int) -> tuple[Array, Array, Array | None]:
    """Return corners, triangles and the corners' colours once edges are collapsed."""
    import fast_simplification
    import numpy as np

    # Far from 1 the library's own limits of what is small do not hold.
    middle = surface.vertices.mean(axis=0, dtype=np.float64)
    size = float(np.abs(surface.vertices - middle).max()) or 1.0
    points, faces = (surface.vertices - middle) / size, surface.faces.astype(np.int32)
    least, corners, collapses = fast_simplification.simplify(
        points, faces, target_count=most, return_collapses=True
    )
    colours = surface.vertex_colours
    if colours is not None:
        least, corners, number = fast_simplification.replay_simplification(points, faces, collapses)
        mixed = np.zeros((len(least), 4), np.uint8)
        mixed[number] = colours
        colours = mixed
    sound = np.isfinite(least).all(axis=1)
    corners = corners[sound[corners].all(axis=1)]
    return (least * size + middle).astype(np.float32), corners, colours
