"""A robot that does not stop when it is told to.

It rolls or slides on after the command has gone to zero. Brakes are what a drive plugin does by
itself; a robot that drives on has a part that pushes it, or wheels that do not grip.

Fix: look at the friction of the wheels, at their axes, and at plugins that fight each other.
Source: experience; the speed at the end of a stop, 1.5 s or as long as its limits let it brake.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI008", "does-not-stop", Severity.ERROR)
def check(driven: RobotTrial, *, error_above: float = 0.05) -> Findings:
    """Report a speed beyond the command that is left after a stop.

    Options:
        error_above: Speed in m/s, over what is still commanded, that may be left at the end of a
            stop; more is an error.
    """
    speed = driven.trial.value("stop_speed")
    if speed is None or abs(speed) <= error_above:
        return
    distance = driven.trial.value("stop_distance")
    way = f" and has gone {distance:.2g} m" if distance is not None else ""
    yield finding(
        driven.drive,
        f"after a stop it still moves at {abs(speed):.2g} m/s{way}, expected "
        f"at most {error_above:g} m/s",
        key="stop_speed",
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


def _rover(friction: float, mark: str = "") -> str:
    wheels = "".join(_WHEEL.format(name=name, x=x, y=y) for name, (x, y) in _PLACES.items())
    surface = f"<surface><friction><ode><mu>{friction}</mu></ode></friction></surface>"
    wheels = wheels.replace("</geometry>", f"</geometry>{surface}")
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


GOOD = [_rover(1.0)]
BAD = [_rover(0.01, "  <!-- ^ TRI008 -->")]
