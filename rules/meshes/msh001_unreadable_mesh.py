"""A mesh file that cannot be read.

Gazebo reports an error and continues without the mesh: the part is invisible, or objects pass
through it. Usually the file was cut off while it was copied. A Git LFS pointer is not checked:
`git lfs pull` fetches the mesh.

Fix: export or copy the mesh again, and open it in a viewer.
Source: the formats' specifications; every mesh of the accepted packages that we checked can be
read.
"""

import struct

from checker.model.mesh import MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH001", "unreadable-mesh", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report empty and corrupt files."""
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        if isinstance(use.file, MeshFault) and use.file.trouble is MeshTrouble.UNREADABLE:
            yield finding(use.uri, f"{use.uri.value} {use.file.reason}")


def _visual(uri: str, mark: str = "") -> str:
    return f"""
<visual name="v"><geometry><mesh>
  <uri>meshes/{uri}</uri>{mark}
</mesh></geometry></visual>
"""


def _binary_stl(triangles: int, declared: int) -> bytes:
    """Return the bytes of an STL file with triangles between x = 0 and 1 m."""
    corners = (0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0)
    one = struct.pack("<12f2x", *map(float, corners))
    return bytes(80) + struct.pack("<I", declared) + one * triangles


_MARK = "  <!-- ^ MSH001 -->"
_OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

GOOD = [
    {"@fragment": _visual("part.stl"), "meshes/part.stl": _binary_stl(2, declared=2)},
    {"@fragment": _visual("part.obj"), "meshes/part.obj": _OBJ + "f 1 2 3\n"},
    _visual("nowhere.obj"),
]
BAD = [
    {"@fragment": _visual("part.stl", _MARK), "meshes/part.stl": ""},
    {"@fragment": _visual("part.stl", _MARK), "meshes/part.stl": _binary_stl(1, declared=1000)},
    {"@fragment": _visual("part.obj", _MARK), "meshes/part.obj": _OBJ + "f 1 2 9\n"},
    {"@fragment": _visual("part.dae", _MARK), "meshes/part.dae": "<COLLADA><library"},
]
