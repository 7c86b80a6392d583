"""Triangles of one colour or with coloured corners, and how JSON expresses them."""

from __future__ import annotations

import base64
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
        colour: Of all triangles; vertex colours are multiplied with it.
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
    return {"surfaces": [surface_to_json(each) for each in read]}


def appearance_from_json(data: Any) -> Appearance:
    """Return what `appearance_to_json` was given.

    Raises:
        ValueError: It is something else.
    """
    try:
        if "reason" in data:
            return str(data["reason"])
        return tuple(surface_from_json(each) for each in data["surfaces"])
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
    red, green, blue, alpha = (min(max(float(each), 0.0), 1.0) for each in data["colour"])
    return Surface(vertices, faces, (red, green, blue, alpha), colours)


def _packed(numbers: Array, kind: str) -> str:
    return base64.b64encode(numbers.astype(kind).tobytes()).decode()


def _unpacked(packed: str, kind: str, width: int) -> Array:
    import numpy as np

    # binascii.Error is a ValueError.
    return np.frombuffer(base64.b64decode(packed), kind).reshape(-1, width)
