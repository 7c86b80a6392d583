"""Triangles of a Wavefront OBJ file; its numbers are taken as metres, as Gazebo does."""

from __future__ import annotations

import io
import re

from checker.physics.mesh.surface import NoSurface, Surface

# Pictures that a material file (`.mtl`) of OBJ names.


_NUMBER = r"[-+]?[\d.]+(?:[eE][-+]?\d+)?"
_OPTION = rf"-(?:[ost](?:\s+{_NUMBER}){{1,3}}|mm\s+{_NUMBER}\s+{_NUMBER}|[A-Za-z]+\s+\S+)\s+"
_MAP = re.compile(
    rf"^[ \t]*(?:map_\w+|norm|bump|disp|decal)[ \t]+(?:{_OPTION}){{0,8}}(\S[^\r\n]*)",
    re.IGNORECASE | re.MULTILINE,
)

SIZE_LIMIT = 1_000_000
"""Bytes of a material file."""


def textures_in(material_file: bytes) -> tuple[str, ...]:
    """Return the pictures of a material file as named there, each once."""
    text = material_file.decode("utf-8", "replace")
    return tuple(dict.fromkeys(found[1].strip() for found in _MAP.finditer(text)))


_PART = re.compile(rb"^[ \t]*[og][ \t]+(\S[^\r\n]{0,200})", re.M)
_MATERIALS = re.compile(rb"^[ \t]*mtllib[ \t]+(\S[^\r\n]{0,200})", re.M)
_CORNER = re.compile(rb"^[ \t]*v[ \t]", re.M)


def read_obj(data: bytes) -> Surface:
    """Return the triangles; polygons are cut into fans.

    Raises:
        NoSurface: The file holds no faces, or they name corners that it has not.
    """
    import trimesh

    if not _CORNER.search(data):
        raise NoSurface("is no OBJ file: it holds no corners (lines `v x y z`)")
    # Without materials nothing but the file itself is looked at.
    loaded = trimesh.load(
        io.BytesIO(data), file_type="obj", process=False, skip_materials=True, group_material=False
    )
    if isinstance(loaded, trimesh.Scene):
        loaded = loaded.to_mesh()
    if not isinstance(loaded, trimesh.Trimesh):
        raise NoSurface("holds no triangles")
    return Surface(
        loaded.vertices[loaded.faces],
        materials=_names(_MATERIALS, data),
        parts=_names(_PART, data),
    )


def _names(line: re.Pattern[bytes], data: bytes) -> tuple[str, ...]:
    names = (name.decode("utf-8", "replace").strip() for name in line.findall(data))
    return tuple(dict.fromkeys(names))
