"""A wheel whose collision is a mesh.

A mesh rolls on its corners: the robot shakes and its odometry drifts. Contacts take long to
compute, and engines treat meshes that are not convex differently. No accepted package that we
checked has this fault.

Fix: use a cylinder or a sphere as the wheel's collision, and keep the mesh as its visual.
Source: a cylinder or sphere touches the ground in the same way at every angle.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


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
                    )


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
