"""A robot that drives faster than its velocity limit, or speeds up faster than it may.

The limits in the drive plugin are those of the real robot. One that exceeds them does what its
twin cannot; mostly the wheels are larger than `wheel_radius`, or the limit counts for each of
several plugins.

Fix: set `wheel_radius` to the radius of the wheels' collisions, and state the limits in all drive
plugins.
Source: the plugin's `max_velocity` and `max_acceleration`, against 2 s at full command.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI014", "limits-not-kept", Severity.WARNING)
def check(
    driven: RobotTrial, *, full_speed_above: float = 1.05, full_acceleration_above: float = 1.25
) -> Findings:
    """Report a speed and an acceleration that exceed these multiples of their limits.

    Options:
        full_speed_above: Multiple of the drive plugin's velocity limit; a higher speed at full
            command is reported.
        full_acceleration_above: Multiple of the drive plugin's acceleration limit; more, on average
            over 0.2 s, is reported.
    """
    value = driven.trial.value
    said = {}
    speed, limit = value("full_speed"), value("full_speed_limit")
    if speed is not None and limit and abs(speed) > full_speed_above * limit:
        said["full_speed"] = f"it drives at {abs(speed):.3g} m/s, its limit is {limit:g} m/s"
    gain, most = value("full_acceleration"), value("full_acceleration_limit")
    if gain is not None and most and abs(gain) > full_acceleration_above * most:
        said["full_acceleration"] = (
            f"it gains {abs(gain):.3g} m/s each second, its limit is {most:g} m/s²"
        )
    if said:
        yield finding(
            driven.drive, f"at full command {' and '.join(said.values())}", key=" ".join(said)
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


def _rover(radius: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
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
  <wheel_radius>{radius}</wheel_radius>
  <max_velocity>1</max_velocity><min_velocity>-1</min_velocity>
  <max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>
</plugin>
</model>
</sdf>
"""


GOOD = [_rover(0.1)]
BAD = [_rover(0.08, "  <!-- ^ TRI014 -->")]
