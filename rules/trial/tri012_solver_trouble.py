"""A model that the solver cannot simulate.

Positions or speeds grow without bound within moments. In Gazebo the robot flies off, vanishes or
takes the whole world with it.

Fix: look for inertias that are far too small for the part, joints with extreme stiffness or
damping, and masses that differ by many orders of magnitude across a joint.
Source: warnings BADQPOS, BADQVEL and BADQACC of MuJoCo, which remain at half the time step.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI012", "solver-trouble", Severity.ERROR)
def check(driven: RobotTrial) -> Findings:
    """Report warnings of the solver, and figures that are none."""
    for trouble in driven.trial.trouble:
        yield finding(driven.robot, f"the simulation {trouble}", key="trouble")


_WHEEL = """
<link name="{name}">
  <pose>{x} {y} 0.1 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>4e-3</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_joint" type="revolute">
  <parent>base_link</parent><child>{name}</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""
_PLACES = {"fl": (0.2, 0.2), "rl": (-0.2, 0.2), "fr": (0.2, -0.2), "rr": (-0.2, -0.2)}


def _rover(stiffness: float, reference: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">{mark}
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial><mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<link name="mast">
  <pose>0 0 0.4 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="spring" type="prismatic">
  <parent>base_link</parent><child>mast</child>
  <axis>
    <xyz>0 0 1</xyz>
    <dynamics>
      <spring_stiffness>{stiffness}</spring_stiffness>
      <spring_reference>{reference}</spring_reference>
    </dynamics>
  </axis>
</joint>
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>
  <right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>
  <wheel_separation>0.4</wheel_separation>
  <wheel_radius>0.1</wheel_radius>
  <max_velocity>1</max_velocity><min_velocity>-1</min_velocity>
  <max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>
</plugin>
</model>
</sdf>
"""


GOOD = [_rover(1e3, 0.0)]
BAD = [_rover(1e15, 1e3, "  <!-- ^ TRI012 -->")]
