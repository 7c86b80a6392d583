"""What is drawn: triangles of one material; and who gives those of mesh files."""

from __future__ import annotations

from dataclasses import field
from typing import TYPE_CHECKING, Any, Protocol

from checker.record import record
from checker.source.text import Located

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

Colour = tuple[float, float, float, float]
"""Red, green, blue and alpha as sRGB has them, 0 to 1."""

GREY: Colour = (0.7, 0.7, 0.7, 1.0)


@record(eq=False)
class Surface:
    """Triangles of one material.

    Attributes:
        vertices: Corners, metres (n × 3, float32).
        faces: Three numbers of corners a triangle, counter-clockwise from outside (m × 3, uint32).
        colour: Of all triangles; vertex colours are multiplied with it.
        vertex_colours: sRGB red, green, blue and alpha of each corner (n × 4, uint8), or None.
        normals: Unit vectors of smooth surfaces (n × 3, float32); None lets every triangle be flat.
    """

    vertices: Array = field(repr=False)
    faces: Array = field(repr=False)
    colour: Colour = GREY
    vertex_colours: Array | None = field(default=None, repr=False)
    normals: Array | None = field(default=None, repr=False)


class Surfaces(Protocol):
    """Gives what the mesh files of a robot look like."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:
        """Return what the mesh file behind a URI looks like.

        Metres, its own unit honoured, the model's `<scale>` not applied. Asked again for the same
        file, it returns the same arrays, so that they are stored once. Else why the file cannot be
        shown: the end of a sentence whose subject is the file.
        """
        ...


@record()
class NoSurfaces:
    """For a robot whose mesh files nobody reads."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:  # noqa: ARG002 - as a `Surfaces`
        """Say that the file was not read."""
        return "was not read"
