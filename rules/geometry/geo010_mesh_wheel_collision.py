"""A wheel whose collision is a mesh.

A mesh rolls on its corners: the robot shakes and its odometry drifts. Contacts take long to
compute, and engines treat meshes that are not convex differently. No accepted package that we
checked has this fault.

Fix: use a cylinder or a sphere as the wheel's collision, and keep the mesh as its visual.
Source: a cylinder or sphere touches the ground in the same way at every angle.
"""

from checker.finding import Fix
from checker.formats.corrections import along_z, number_text, pose_edits
from checker.formats.xacro.expanded import written_element
from checker.model.components import Collision, Link
from checker.model.geometry.boxes import box_around
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Safety, Severity, finding, rule


@rule("GEO010", "mesh-wheel-collision", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report driven wheels with a mesh among their collisions."""
    for wheel in robot.locomotion.wheels:
        for link in wheel.body:
            for shape in link.collisions:
                if shape.geometry.shape == "mesh":
                    yield finding(
                        shape.geometry,
                        f"wheel {link.name.value!r} has a mesh as its collision, expected a "
                        "cylinder or sphere",
                        key="mesh",
                        fix=_as_cylinder(robot, link, shape, wheel.axis),
                    )


def _as_cylinder(robot: Robot, link: Link, shape: Collision, axis: Vector | None) -> Fix | None:
    """Return the fix that makes a cylinder along the axle of a wheel's mesh."""
    frame = robot.pose_of(link.scoped_name)
    if frame is None or axis is None or shape.pose.relative_to:
        return None
    turn = along_z(frame.inverse.rotate(axis))
    inside = turn.inverse @ shape.pose.transform
    box = box_around([(shape.geometry, inside)], robot.scaled_meshes)
    if box is None:
        return None
    across, up, length = (high - low for low, high in zip(box.low, box.high, strict=True))
    radius, length_text = number_text(max(across, up) / 2), number_text(length)
    new = f"<cylinder><radius>{radius}</radius><length>{length_text}</length></cylinder>"
    if robot.conventions.is_urdf:
        new = f'<cylinder radius="{radius}" length="{length_text}"/>'
    posed = pose_edits(robot, shape, Transform(turn.rotation, turn.apply(box.centre)))
    written = written_element(shape.geometry.element).whole_span.replacement(new)
    return Fix(Safety.UNSAFE, (*posed, written)) if posed else None


def _wheel(shape: str) -> str:
    return f"""
<link name="wheel">
  <collision name="c">
    <geometry>
      {shape}
    </geometry>
  </collision>
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


GOOD = [_wheel("<sphere/>")]
BAD = [_wheel("<mesh><uri>meshes/wheel.dae</uri></mesh>  <!-- ^ GEO010 -->")]
