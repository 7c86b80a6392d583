"""A wheel whose collision is a mesh.

A mesh rolls on its corners: the robot shakes and its odometry drifts. Contacts take long to
compute, and engines treat meshes that are not convex differently. A mesh within a larger cylinder
or sphere of the wheel never touches the ground. No accepted package that we checked has this fault.

Fix: use a cylinder or a sphere as the wheel's collision, and keep the mesh as its visual.
Source: a cylinder or sphere touches the ground in the same way at every angle.
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.formats.corrections import along_z, number_text, pose_edits
from checker.model.components import Collision, Link
from checker.model.geometry.boxes import Box, box_around
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Safety, Severity, finding, rule


@rule("GEO010", "mesh-wheel-collision", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report driven wheels with a mesh among their collisions."""
    for wheel in robot.locomotion.wheels:
        for link in wheel.body:
            for shape in _rolling_meshes(robot, link, wheel.axis):
                yield finding(
                    shape.geometry,
                    f"wheel {link.name.value!r} has a mesh as its collision, expected a "
                    "cylinder or sphere",
                    key="mesh",
                    fix=_as_cylinder(robot, link, shape, wheel.axis),
                )


def _rolling_meshes(robot: Robot, link: Link, axis: Vector | None) -> Iterator[Collision]:
    """Yield the meshes of a wheel that a cylinder or sphere of it does not keep off the ground."""
    kinds = {shape: shape.geometry.shape for shape in link.collisions}
    rounds = [shape for shape, kind in kinds.items() if kind in ("cylinder", "sphere")]
    reach = max((_radius(robot, link, shape, axis) for shape in rounds), default=0.0)
    for shape in (shape for shape, kind in kinds.items() if kind == "mesh"):
        if not 0.0 < _radius(robot, link, shape, axis) < reach:
            yield shape


def _as_cylinder(robot: Robot, link: Link, shape: Collision, axis: Vector | None) -> Fix | None:
    """Return the fix that makes a cylinder along the axle of a wheel's mesh."""
    turned = _turned(robot, link, shape, axis)
    if turned is None:
        return None
    turn, box = turned
    across, up, length = (high - low for low, high in zip(box.low, box.high, strict=True))
    radius, length_text = number_text(max(across, up) / 2), number_text(length)
    new = f"<cylinder><radius>{radius}</radius><length>{length_text}</length></cylinder>"
    if robot.conventions.is_urdf:
        new = f'<cylinder radius="{radius}" length="{length_text}"/>'
    posed = pose_edits(robot, shape, Transform(turn.rotation, turn.apply(box.centre)))
    written = shape.geometry.element.written.whole_span.replacement(new)
    return Fix(Safety.UNSAFE, (*posed, written)) if posed else None


def _turned(
    robot: Robot, link: Link, shape: Collision, axis: Vector | None
) -> tuple[Transform, Box] | None:
    """Return the turn of z to the axle of a wheel, and the box of a shape in that frame."""
    frame = robot.pose_of(link.scoped_name)
    if frame is None or axis is None or shape.pose.relative_to:
        return None
    turn = along_z(frame.inverse.rotate(axis))
    inside = turn.inverse @ shape.pose.transform
    box = box_around([(shape.geometry, inside)], robot.scaled_meshes)
    return None if box is None else (turn, box)


def _radius(robot: Robot, link: Link, shape: Collision, axis: Vector | None) -> float:
    """Return how far a shape reaches from its middle, across the axle, metres; 0 if unknown."""
    turned = _turned(robot, link, shape, axis)
    if turned is None:
        return 0.0
    low, high = turned[1].low, turned[1].high
    return max(high[0] - low[0], high[1] - low[1]) / 2


def _wheel(shape: str, more: str = "") -> str:
    return f"""
<link name="wheel">
  <collision name="c">
    <geometry>
      {shape}
    </geometry>
  </collision>
  {more}
  <visual name="v"><geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry></visual>
</link>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle</left_joint>
</plugin>
"""


_TYRE = """<collision name="tyre">
    <geometry><sphere><radius>0.2</radius></sphere></geometry></collision>"""
_HUB = "<mesh><uri>meshes/hub.obj</uri></mesh>"
_CUBE = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
GOOD = [
    _wheel("<sphere/>"),
    {"@fragment": _wheel(_HUB, _TYRE), "meshes/hub.obj": _CUBE, "meshes/wheel.dae": "<COLLADA/>"},
]
BAD = [_wheel("<mesh><uri>meshes/wheel.dae</uri></mesh>  <!-- ^ GEO010 -->")]
