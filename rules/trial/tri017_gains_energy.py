"""A robot that gains energy while nothing drives it.

Energy comes from nowhere in the simulation only: a joint starts beyond its limits and is pushed
back, a part starts inside the ground, or a loop of stiff parts fights itself. The robot twitches,
jumps or creeps.

Fix: let every joint start within its limits, and look at what starts inside something else.
Source: kinetic and potential energy at rest, in shares of the energy that lifts the robot by 0.1 m.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI017", "gains-energy", Severity.WARNING)
def check(driven: RobotTrial, *, warning_above: float = 0.1) -> Findings:
    """Report a gain of energy while nothing drives the robot.

    Options:
        warning_above: Energy gained, as a share of what lifts the robot by 0.1 m; more is reported
            (0.1 stands for a lift of 10 mm).
    """
    gain = driven.trial.value("energy_gain")
    if gain is not None and gain > warning_above:
        yield finding(
            driven.robot,
            f"left alone, it gains as much energy as lifts it by {gain * 0.1:.2g} m, expected at "
            f"most {warning_above * 0.1:g} m",
            key="energy_gain",
        )


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


def _rover(lower: float, mark: str = "") -> str:
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
<link name="arm">
  <pose>0.3 0 0.4 0 0 0</pose>
  <inertial><mass>2</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="hinge" type="revolute">
  <pose>-0.3 0 0 0 0 0</pose>
  <parent>base_link</parent><child>arm</child>
  <axis><xyz>0 -1 0</xyz><limit><lower>{lower}</lower><upper>1.5</upper></limit></axis>
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


GOOD = [_rover(-0.5)]
BAD = [_rover(0.5, "  <!-- ^ TRI017 -->")]
