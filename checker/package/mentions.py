"""File names that the files of a package mention, of any format.

The search is by text alone, so a name in a comment counts: a file that is not among the names is
certainly not named anywhere.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from typing import TYPE_CHECKING
from urllib.parse import unquote

from checker.base.files import NotReadable

if TYPE_CHECKING:
    from checker.package.package import Package

FILE_LIMIT = 50_000_000
"""Bytes; a larger file is not searched."""

MENTIONS_LIMIT = 100_000
"""Greatest number in one file; the rest is ignored."""

_NAME_LIMIT = 255
_NAMING_NOTHING = (".png", ".jpg", ".jpeg", ".tga", ".tif", ".tiff", ".bmp", ".gif", ".stl", ".so")
_ENDING = re.compile(
    # Mesh files are full of points with a digit behind: those are ignored at once.
    rb"\.(?=[A-Za-z])(?:dae|stl|obj|mtl|glb|gltf|bin|fbx|sdf|material"
    rb"|png|jpe?g|tga|tiff?|bmp|gif|dds|hdr)(?![\w.-])",
    re.IGNORECASE,
)
_WORD = re.compile(r"[\w-]+")
_FILE_NAME = re.compile(r"[\w.-]+")
_DELIMITER = re.compile(rb"[\x00-\x1f/\\\"'<>=()\[\]{},;:|&?#*]")


def has_word(text: str, name: str) -> bool:
    """Return whether a name, as that of a package, is a whole word of a text."""
    return name in text and name in _WORD.findall(text)


def has_file(text: str, name: str) -> bool:
    """Return whether a text contains the whole name of a file: `arm.urdf`, not `my_arm.urdf`."""
    return name in text and name in _FILE_NAME.findall(text)


def mentioned_names(package: Package) -> frozenset[str]:
    """Return the names of meshes, pictures and models that are in any file, in lower case.

    A name with spaces is among them both as a whole and as its last word. Files larger than
    `FILE_LIMIT` are left out; see `unsearched`.
    """
    names: set[str] = set()
    for file in package.index.files:
        if not file.path.lower().endswith(_NAMING_NOTHING):
            data = package.read_bytes(file.path, FILE_LIMIT)
            if not isinstance(data, NotReadable):
                names.update(_names(data))
    return frozenset(names)


def unsearched(package: Package) -> tuple[str, ...]:
    """Return the files that are too large to be searched."""
    return tuple(
        file.path
        for file in package.index.files
        if file.size > FILE_LIMIT and not file.path.lower().endswith(_NAMING_NOTHING)
    )


def _names(data: bytes) -> Iterator[str]:
    for ending in islice(_ENDING.finditer(data), MENTIONS_LIMIT):
        before = data[max(0, ending.start() - _NAME_LIMIT) : ending.start()]
        written = _DELIMITER.split(before)[-1] + ending.group()
        name = unquote(written.decode("utf-8", "replace")).strip().casefold()
        yield name
        yield name.rpartition(" ")[2]
