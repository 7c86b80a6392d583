"""A mesh with too many triangles for simulation.

The simulator tests collision meshes against each other at every step, and draws visual meshes again
for each camera and each lidar of the robot. A URDF without sensors is only drawn on the screen:
there, many triangles of visuals are infos. So are those of collisions where no launch file gives
the robot to a simulator, and all of a static model: it is scenery, and nothing moves it.

Fix: reduce the mesh (Blender: Decimate); use boxes, cylinders and spheres as collisions.
Source: Model Migration Guide and review findings; the figures are ten times what the accepted
packages that we checked need.
"""

from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH004", "too-many-triangles", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot, *, collision: int = 20_000, visual: int = 200_000, together: int = 1_000_000
) -> Findings:
    """Report meshes above the number for their use, and robots whose meshes exceed the total.

    Options:
        collision: Triangles that the mesh of a collision may have; more are reported.
        visual: Triangles that the mesh of a visual may have; more are reported.
        together: Triangles that all meshes of the robot may have together; a mesh counts once for
            each use; more are reported.
    """
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    scenery = robot.is_static
    once = scenery or not (robot.conventions.states_devices or robot.sensors)
    drawn = Severity.INFO if once else Severity.WARNING
    tested = Severity.INFO if robot.shown_only or scenery else Severity.WARNING
    total = 0
    for use in robot.mesh_uses:
        triangles = use.file.triangles if isinstance(use.file, Mesh) else 0
        total += triangles
        most = collision if use.is_collision else visual
        if triangles > most:
            kind = "collision" if use.is_collision else "visual"
            yield finding(
                use.uri,
                f"{kind} mesh {use.uri.value} has {triangles:,} triangles, "
                f"expected at most {most:,}",
                severity=tested if use.is_collision else drawn,
                key=kind,
            )
    if total > together:
        yield finding(
            robot,
            f"the meshes of the robot have {total:,} triangles together, "
            f"expected at most {together:,}",
            severity=drawn,
        )


def _link(parts: str, mark: str = "") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">{mark}
<link name="base_link">{parts}</link>
</model>
</sdf>
"""


def _mesh(kind: str, mark: str = "", name: str = "a") -> str:
    return f"""
<{kind} name="{name}"><geometry><mesh>
  <uri>meshes/part.obj</uri>{mark}
</mesh></geometry></{kind}>
"""


def _strip(triangles: int) -> str:
    """Return an OBJ file of one triangle, many times."""
    return "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * triangles


_MARK = "  <!-- ^ MSH004 -->"
_MANY = "".join(_mesh("visual", name=str(number)) for number in range(6))

GOOD = [
    {"@fragment": _link(_mesh("collision")), "meshes/part.obj": _strip(19_000)},
    {"@fragment": _link(_mesh("visual")), "meshes/part.obj": _strip(190_000)},
]
BAD = [
    {"@fragment": _link(_mesh("collision", _MARK)), "meshes/part.obj": _strip(21_000)},
    {"@fragment": _link(_mesh("visual", _MARK)), "meshes/part.obj": _strip(201_000)},
    {"@fragment": _link(_MANY, _MARK), "meshes/part.obj": _strip(190_000)},
]
