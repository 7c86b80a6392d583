"""A collision mesh without vertex normals, which ends Gazebo Fortress.

Its physics ignores each part of a collision mesh that has not one normal for each corner, and then
ends with a segmentation fault. Visual meshes do not need normals, and STL files always have them.

Fix: export the mesh again with normals (in Blender, "Normals" of the OBJ export) and, for COLLADA,
without loose edges; or as STL; or use boxes, cylinders and spheres.
Source: tried with ign-physics 5.1 and ign-common 4.5 (see `docs/oracles.md`); gz-sim issue 3163.
Other releases were not tried.
"""

from checker.model.mesh import Mesh, picked_part
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_ENDING = ("fortress",)


@rule("MSH011", "collision-mesh-without-normals", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report collision meshes in COLLADA and OBJ files that have parts without normals."""
    if context.release not in _ENDING or not robot.is_for_gazebo:
        return
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        mesh = use.file
        whole = use.is_collision and picked_part(use.shape.geometry) is None
        if whole and isinstance(mesh, Mesh) and mesh.bare:
            yield finding(
                use.uri,
                f"Gazebo {context.release.capitalize()} ends with a segmentation fault: collision "
                f"mesh {use.uri.value} {mesh.bare}; export it with normals, or as STL",
                key=use.uri.value,
            )


def _collision(mesh: str, mark: str = "", release: str = "fortress") -> dict[str, str]:
    shape = f"""
<collision name="c"><geometry><mesh>
  <uri>meshes/part.obj</uri>{mark}
</mesh></geometry></collision>
"""
    return {"@profile": f"gazebo-{release}", "@fragment": shape, "meshes/part.obj": mesh}


_CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
_BARE = _CORNERS + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
_NORMALS = _CORNERS + "vn 0 0 1\nf 1//1 3//1 2//1\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"

GOOD = [
    _collision(_NORMALS),
    _collision(_BARE, release="harmonic"),
    {
        **_collision(_BARE),
        "@fragment": _collision(_BARE)["@fragment"].replace("collision", "visual"),
    },
]
BAD = [_collision(_BARE, "  <!-- ^ MSH011 -->")]
