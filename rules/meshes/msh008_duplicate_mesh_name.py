"""Two different meshes have the same file name in different folders.

MuJoCo, and other tools that collect all meshes in one place, treat them as one: a part gets the
shape of another. Gazebo handles them correctly.

Fix: give each mesh its own name, such as `wheel_collision.stl`.
Source: MuJoCo, XML reference: a mesh is named for its file without the folder unless it has a name.
"""

import posixpath

from msgspec.structs import replace

from checker.model.mesh import Mesh, MeshUse
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH008", "duplicate-mesh-name", Severity.INFO, Concern.PORTABILITY)
def check(robot: Robot) -> Findings:
    """Report meshes whose name another mesh already has."""
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    first: dict[str, tuple[MeshUse, Mesh]] = {}
    for use in robot.mesh_uses:
        if not isinstance(use.file, Mesh):
            continue
        name = posixpath.basename(use.file.path)
        other, mesh = first.setdefault(name, (use, use.file))
        if use.file.path != mesh.path and replace(use.file, path=mesh.path) != mesh:
            yield finding(
                use.uri,
                f"{use.uri.value} and {other.uri.value} are different meshes with the same file "
                "name",
                related=[(other.uri, "the first mesh of this name")],
            )


def _shapes(mark: str = "") -> str:
    return f"""
<visual name="v"><geometry><mesh>
  <uri>meshes/wheel.obj</uri>
</mesh></geometry></visual>
<visual name="w"><geometry><mesh>
  <uri>meshes/other/wheel.obj</uri>{mark}
</mesh></geometry></visual>
"""


_SMALL = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
_LARGE = "v 0 0 0\nv 3 0 0\nv 0 1 0\nf 1 2 3\n"


GOOD = [
    {
        "@fragment": f"<link name='wheel'>{_shapes()}</link>",
        "meshes/wheel.obj": _SMALL,
        "meshes/other/wheel.obj": _SMALL,
    },
]
BAD = [
    {
        "@fragment": f"<link name='wheel'>{_shapes('  <!-- ^ MSH008 -->')}</link>",
        "meshes/wheel.obj": _SMALL,
        "meshes/other/wheel.obj": _LARGE,
    },
]
