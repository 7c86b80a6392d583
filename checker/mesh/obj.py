"""Triangles of a Wavefront OBJ file; its numbers are taken as metres, as Gazebo does."""

from __future__ import annotations

import io
import re

from checker.mesh.surface import NoSurface, Surface

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
        raise NoSurface("is not an OBJ file: it contains no corners (lines `v x y z`)")
    # Without materials nothing but the file itself is looked at.
    loaded = trimesh.load(
        io.BytesIO(data), file_type="obj", process=False, skip_materials=True, group_material=False
    )
    if isinstance(loaded, trimesh.Scene):
        loaded = loaded.to_mesh()
    if not isinstance(loaded, trimesh.Trimesh):
        raise NoSurface("contains no triangles")
    return Surface(
        loaded.vertices[loaded.faces],
        materials=_names(_MATERIALS, data),
        parts=_names(_PART, data),
    )


def _names(line: re.Pattern[bytes], data: bytes) -> tuple[str, ...]:
    names = (name.decode("utf-8", "replace").strip() for name in line.findall(data))
    return tuple(dict.fromkeys(names))
