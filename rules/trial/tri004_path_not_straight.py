"""A robot that does not drive straight when it is told to.

It steers off by itself: a wheel's collision is turned, is smaller than the others, carries no
load or is missing, or the centre of mass lies far to one side.

Fix: compare the wheels of both sides: radius, pose and friction of their collisions, their axes.
Source: a prototype trial of 60 accepted ground robots: all are straight to three decimals.
"""

import math

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI004", "path-not-straight", Severity.ERROR)
def check(
    driven: RobotTrial,
    *,
    path_sideways_warning: float = 0.02,
    path_sideways_error: float = 0.1,
    path_heading_warning: float = 0.035,
    path_heading_error: float = 0.175,
    moved: float = 0.2,
) -> Findings:
    """Report a robot that leaves the straight line, or turns on it.

    Options:
        path_sideways_warning: Metres sideways for each metre forward; more is a warning.
        path_sideways_error: Metres sideways for each metre forward beyond which it is an error
            instead of a warning.
        path_heading_warning: Radians by which the heading may change on the whole straight drive;
            more is a warning.
        path_heading_error: Radians of change in heading beyond which it is an error instead of a
            warning.
        moved: Share of the commanded speed that must be reached for the way sideways to be judged;
            the heading always is.
    """
    speed = driven.trial.value("speed_ratio")
    heading = abs(driven.trial.value("path_heading") or 0.0)
    sideways = abs(driven.trial.value("path_sideways") or 0.0)
    if speed is None or abs(speed) < moved:
        sideways = 0.0
    said = {}
    if sideways > path_sideways_warning:
        said["path_sideways"] = (
            f"moves {sideways:.2g} m sideways for each metre forward, "
            f"expected at most {path_sideways_warning:g} m"
        )
    if heading > path_heading_warning:
        said["path_heading"] = (
            f"turns by {math.degrees(heading):.1f}° on the straight, "
            f"expected at most {math.degrees(path_heading_warning):.0f}°"
        )
    if said:
        grave = sideways > path_sideways_error or heading > path_heading_error
        yield finding(
            driven.drive,
            f"told to drive straight, it {'; it '.join(said.values())}",
            severity=Severity.ERROR if grave else Severity.WARNING,
            key=" ".join(said),
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


def _rover(left: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
    wheels = wheels.replace("<radius>0.1<", f"<radius>{left}<", 2)
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial><mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">{mark}
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


GOOD = [_rover(0.1)]
BAD = [_rover(0.095, "  <!-- ^ TRI004 -->")]
