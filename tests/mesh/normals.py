"""Mesh files with and without vertex normals, by their names."""

from __future__ import annotations

from tests.mesh.files import binary_stl, box, dae, obj

_BOX = box(0.1, 0.1, 0.1)
_DAE = dae(_BOX)
_POINTS = b'<input semantic="POSITION" source="#part-points"/>'
_LIT_DAE = _DAE.replace(_POINTS, _POINTS + _POINTS.replace(b"POSITION", b"NORMAL"))
_LINES = (
    b'<lines count="1"><input semantic="VERTEX" source="#part-corners" offset="0"/><p>0 1</p>'
    b"</lines>"
)
_LIT_OBJ = b"vn 0 0 1\n" + obj(_BOX)

LIT = {
    "box.stl": binary_stl(_BOX),
    "box.dae": _LIT_DAE,
    "unused.obj": _LIT_OBJ,
    "partly.obj": _LIT_OBJ.replace(b"f 1 2 3", b"f 1//1 2//1 3//1"),
}
"""Files that Gazebo Fortress takes as collisions."""

BARE = {
    "bare.obj": obj(_BOX),
    "bare.dae": _DAE,
    "half.dae": _LIT_DAE.replace(b"</triangles>", b"</triangles>" + _LINES),
}
"""Files with parts without normals: Gazebo Fortress ends with them."""
