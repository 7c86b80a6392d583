"""PLY, GLB, OFF and 3MF files, which trimesh reads.

Places in GLB are those of the file, in which y points up: Gazebo does not turn them, nor does RViz
before 2025.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from io import BytesIO
from typing import Any

from checker.physics.mesh.content import Material, MeshContent, NoSurface, Piece, by_material

SUFFIXES = ("ply", "glb", "off", "3mf")


def read_with_trimesh(data: bytes, _materials: Iterable[bytes] = (), *, suffix: str) -> MeshContent:
    """Return the triangles of a file, with the colour of each part.

    Args:
        data: Its content; other files that it names are not looked for.
        suffix: One of `SUFFIXES`.

    Raises:
        NoSurface: There are none.
    """
    import trimesh

    scene = trimesh.load_scene(BytesIO(data), file_type=suffix)
    pieces = tuple(_pieces(scene.dump()))
    if not pieces:
        raise NoSurface("contains no triangles")
    return MeshContent(by_material(pieces), parts=tuple(scene.geometry))


def _pieces(parts: Iterable[Any]) -> Iterator[Piece]:
    import trimesh

    for part in parts:
        if isinstance(part, trimesh.Trimesh) and len(part.faces):
            yield Piece(part.triangles, _material(part.visual))


def _material(look: Any) -> Material:
    """Return the most frequent colour; of a material without a picture, its own."""
    main: Any = (look.to_color() if look.kind == "texture" else look).main_color
    channels = main if main.ndim else look.material.main_color
    red, green, blue, alpha = (float(value) / 255 for value in channels)
    return Material((red, green, blue, alpha))
