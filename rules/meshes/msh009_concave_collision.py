"""A hollow or concave collision mesh.

Engines that use convex hulls (MuJoCo, Bullet's convex shapes) fill the hollow: wheels inside a
wheel arch touch the chassis, and a gripper cannot close around anything.

Fix: build the collision from several convex parts, preferably boxes and cylinders.
Source: geometry: the volume of the convex hull compared with that of the mesh.
"""

from checker.base.words import beyond
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH009", "concave-collision", Severity.INFO, Concern.ROBOT)
def check(robot: Robot, *, factor: float = 2.0) -> Findings:
    """Report closed collision meshes that fill little of their convex hull.

    Options:
        factor: Volume of the convex hull divided by that of the mesh, which is 1 for a convex one;
            more is reported.
    """
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        mesh = use.mesh
        if mesh is None or not use.is_collision or not mesh.volume:
            continue
        ratio = mesh.hull_volume / abs(mesh.volume)
        if ratio > factor:
            yield finding(
                use.uri,
                f"the convex hull of {use.uri.value} has {beyond(ratio, factor, digits=3)} times "
                f"the volume of the mesh, expected at most {factor:g} times",
            )


def _collision(mark: str = "") -> str:
    return f"""
<collision name="c"><geometry><mesh>
  <uri>meshes/part.obj</uri>{mark}
</mesh></geometry></collision>
"""


def _tent(height_inside: float) -> str:
    """Return a pyramid, 1 m high, with a hollow that reaches from its base up to a height."""
    corners = f"v 1 0 0\nv -1 1 0\nv -1 -1 0\nv 0 0 1\nv 0 0 {height_inside}\n"
    return corners + "f 1 2 4\nf 2 3 4\nf 3 1 4\nf 2 1 5\nf 3 2 5\nf 1 3 5\n"


GOOD = [
    {"@fragment": _collision(), "meshes/part.obj": _tent(0.1)},
    {"@fragment": _collision().replace("collision", "visual"), "meshes/part.obj": _tent(0.9)},
]
BAD = [
    {"@fragment": _collision("  <!-- ^ MSH009 -->"), "meshes/part.obj": _tent(0.9)},
]
