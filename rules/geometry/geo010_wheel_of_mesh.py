"""A wheel collides as a mesh.

A mesh rolls on its corners: the robot shakes and its odometry drifts, contacts take long to find,
and engines differ in how they treat a mesh that is not convex.
No accepted package at hand shows it.

Fix: let the wheel collide as a cylinder or a sphere, and keep the mesh as its visual.
Source: a cylinder or sphere touches the ground in the same way however far it has turned.
"""

from checker.model.robot import Robot
from checker.rule import Findings, Severity, finding, rule


@rule("GEO010", "wheel-of-mesh", Severity.WARNING)
def check(robot: Robot) -> Findings:
    """Report driven wheels with a mesh among their collisions."""
    for wheel in robot.locomotion.wheels:
        for link in wheel.body:
            for shape in link.collisions:
                if shape.geometry.shape == "mesh":
                    yield finding(
                        shape.geometry,
                        f"wheel {link.name.value!r} collides as a mesh, expected a cylinder or "
                        f"sphere",
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
