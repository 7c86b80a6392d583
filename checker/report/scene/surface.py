"""What is drawn: triangles of one material; and who gives those of mesh files."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Protocol

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.source.text import Located

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


# What is not shown, as sentences: each once, and not more than anybody reads.


SENTENCES = 20
_NAME = 80
"""Characters of a name in a sentence."""


@dataclass
class Notes:
    """Sentences in the order in which they were first said."""

    _said: dict[str, None] = field(default_factory=dict)

    def say(self, sentence: str) -> None:
        """Add a sentence, unless it was said."""
        self._said[sentence] = None

    @property
    def sentences(self) -> tuple[str, ...]:
        """The first ones, and how many more there are."""
        said = tuple(self._said)
        if len(said) <= SENTENCES:
            return said
        rest = len(said) - SENTENCES + 1
        return (*said[: SENTENCES - 1], f"{rest} more parts are not shown")


def short(name: str) -> str:
    """Return a name that a sentence can hold."""
    return plain(shortened(name, _NAME))


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


class Surfaces(Protocol):
    """Gives what the mesh files of a robot look like."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:
        """Return what the mesh file behind a URI looks like.

        Metres, its own unit honoured, the model's `<scale>` not applied. Asked again for the same
        file, it returns the same arrays, so that they are stored once. Else why the file cannot be
        shown: the end of a sentence whose subject is the file.
        """
        ...


class NoSurfaces(Record):
    """For a robot whose mesh files nobody reads."""

    def of(self, uri: Located[str]) -> tuple[Surface, ...] | str:  # noqa: ARG002 - as a `Surfaces`
        """Say that the file was not read."""
        return "was not read"
