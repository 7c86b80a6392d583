"""A Wavefront OBJ file, and its material files; its numbers are metres, as for Gazebo."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import pairwise
from typing import TYPE_CHECKING, Any

from checker.physics.mesh.content import Material, MeshContent, NoSurface, Piece
from checker.physics.mesh.surface import GREY

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

_NUMBER = r"[-+]?[\d.]+(?:[eE][-+]?\d+)?"
_OPTION = rf"-(?:[ost](?:\s+{_NUMBER}){{1,3}}|mm\s+{_NUMBER}\s+{_NUMBER}|[A-Za-z]+\s+\S+)\s+"
_MAP = re.compile(
    rf"^[ \t]*(?:map_\w+|norm|bump|disp|decal)[ \t]+(?:{_OPTION}){{0,8}}(\S[^\r\n]*)",
    re.IGNORECASE | re.MULTILINE,
)

MATERIAL_LIMIT = 1_000_000
"""Bytes of a material file."""


def textures_in(material_file: bytes) -> tuple[str, ...]:
    """Return the pictures of a material file as named there, each once."""
    text = material_file.decode("utf-8", "replace")
    return tuple(dict.fromkeys(match[1].strip() for match in _MAP.finditer(text)))


_PART = re.compile(rb"^[ \t]*[og][ \t]+(\S[^\r\n]{0,200})", re.M)
_MATERIALS = re.compile(rb"^[ \t]*mtllib[ \t]+(\S[^\r\n]{0,200})", re.M)
_CORNER = re.compile(rb"^[ \t]*v[ \t]", re.M)
_NORMAL = re.compile(rb"^[ \t]*vn[ \t]", re.M)


_CONTINUED = re.compile(rb"\\\r?\n")
_FAINTEST = 0.02
"""Alpha below which a material counts as opaque: writers that mix up 0 and 1 are common."""


@dataclass(eq=False)
class _Faces:
    """Triangles of one material: numbers of corners, and of places in its picture (-1: none)."""

    corners: list[int] = field(default_factory=list)
    places: list[int] = field(default_factory=list)


@dataclass(eq=False)
class _Reading:
    """State after the lines read so far."""

    corners: list[list[bytes]] = field(default_factory=list)
    places: list[list[bytes]] = field(default_factory=list)
    faces: dict[str, _Faces] = field(default_factory=dict)
    material: str = ""

    def line(self, words: list[bytes]) -> None:
        """Take over one line."""
        match words[0]:
            case b"v":
                self.corners.append(words[1:4])
            case b"vt":
                self.places.append([*words[1:3], b"0"][:2])
            case b"usemtl":
                self.material = _name(words)
            case b"f":
                self._face([self._corner(word) for word in words[1:]])

    def _face(self, corners: list[tuple[int, int]]) -> None:
        """Cut a polygon into a fan, as loaders do."""
        faces = self.faces.setdefault(self.material, _Faces())
        for second, third in pairwise(corners[1:]):
            for corner, place in (corners[0], second, third):
                faces.corners.append(corner)
                faces.places.append(place)

    def _corner(self, word: bytes) -> tuple[int, int]:
        corner, place = [*word.split(b"/"), b""][:2]
        return _counted(corner, self.corners), _counted(place or b"0", self.places)


def read_obj(data: bytes, material_files: Iterable[bytes] = ()) -> MeshContent:
    """Return the triangles; polygons are cut into fans.

    Args:
        data: The content of the file.
        material_files: What is in those that it names, as far as they are available.

    Raises:
        NoSurface: The file has no corners, or its faces name some that it has not.
        ValueError: A number is none.
    """
    if not _CORNER.search(data):
        raise NoSurface("is not an OBJ file: it contains no corners (lines `v x y z`)")
    reading = _Reading()
    for line in _CONTINUED.sub(b" ", data).splitlines():
        if words := line.split():
            reading.line(words)
    materials = dict(material for content in material_files for material in _materials_in(content))
    pieces = tuple(_pieces(reading, materials))
    return MeshContent(
        pieces,
        materials=_names(_MATERIALS, data),
        # Gazebo's reader fills in what single faces lack.
        bare="" if _NORMAL.search(data) else "has no vertex normals (lines `vn x y z`)",
        parts=_names(_PART, data),
    )


def _pieces(reading: _Reading, materials: Mapping[str, Material]) -> Iterator[Piece]:
    import numpy as np

    if any(len(corner) < 3 for corner in reading.corners):
        raise NoSurface("contains a corner with fewer than three numbers")
    corners = np.array(reading.corners, np.float64).reshape(-1, 3)
    places = np.array(reading.places, np.float64).reshape(-1, 2)
    for name, faces in reading.faces.items():
        triangles = _picked(corners, faces.corners)
        if triangles is None:
            raise NoSurface("names corners that do not exist")
        yield Piece(triangles, materials.get(name, Material()), _picked(places, faces.places))


def _names(line: re.Pattern[bytes], data: bytes) -> tuple[str, ...]:
    names = (name.decode("utf-8", "replace").strip() for name in line.findall(data))
    return tuple(dict.fromkeys(names))


def _picked(rows: Array, numbers: list[int]) -> Array | None:
    """Return the rows that triangles name (n × 3 × …); None if one of them does not exist."""
    import numpy as np

    chosen = np.array(numbers, np.int64).reshape(-1, 3)
    if chosen.min(initial=0) < 0 or chosen.max(initial=-1) >= len(rows):
        return None
    picked: Array = rows[chosen]
    return picked


def _counted(word: bytes, known: list[Any]) -> int:
    """Return a number that counts from 1, or backwards from the last one, as one from 0."""
    number = int(word)
    return number - 1 if number >= 0 else len(known) + number


def _materials_in(content: bytes) -> Iterator[tuple[str, Material]]:
    """Yield the materials of a material file: Kd, d or Tr, map_Kd."""
    name, colour, alpha, picture = "", GREY[:3], 1.0, ""
    for line in [*content.splitlines(), b"newmtl"]:
        words = line.split() or [b""]
        match words[0]:
            case b"newmtl":
                yield name, Material((*colour, alpha if alpha > _FAINTEST else 1.0), picture)
                name, colour, alpha, picture = _name(words), GREY[:3], 1.0, ""
            case b"Kd" if len(numbers := _numbers(words[1:4])) == 3:
                colour = (numbers[0], numbers[1], numbers[2])
            case b"d" if numbers := _numbers(words[-1:]):
                alpha = numbers[0]
            case b"Tr" if numbers := _numbers(words[-1:]):
                alpha = 1.0 - numbers[0]
            case b"map_Kd":
                picture = next(iter(textures_in(line)), "")


def _numbers(words: list[bytes]) -> list[float]:
    """Return numbers between 0 and 1; nothing if a word is none."""
    try:
        numbers = [float(word) for word in words]
    except ValueError:
        return []
    return [min(max(number, 0.0), 1.0) for number in numbers if math.isfinite(number)]


def _name(words: list[bytes]) -> str:
    return b" ".join(words[1:]).decode("utf-8", "replace")
