"""A robot that drives slower or faster than it is told.

Odometry counts on the commanded speed: whoever steers the robot believes it elsewhere. Mostly
`wheel_radius` is not the radius of the wheels, or the wheels slip because they carry too little.
With a limit of 0 it does not move at all.

Fix: set `wheel_radius` to the radius of the wheels' collisions, and look at friction and loads.
Source: a prototype trial of 60 accepted ground robots: all reach 0.98 to 1.00 of the command.
"""

from checker.model.locomotion.locomotion import DriveKind
from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule, unchecked


@rule("TRI003", "speed-not-reached", Severity.ERROR)
def check(
    driven: RobotTrial, *, warning_beyond: float = 0.05, error_beyond: float = 0.15
) -> Findings:
    """Report a speed that differs from the command by more than these shares of it.

    Options:
        warning_beyond: Share of the commanded speed by which the robot may be slower or faster;
            more is a warning.
        error_beyond: Share of the commanded speed beyond which the difference is an error instead
            of a warning.
    """
    if driven.robot.unread_plugins and driven.trial.drive == DriveKind.NONE:
        yield unchecked(driven.robot.unread_plugins)
    if driven.trial.not_driven:
        yield unchecked(f"the robot was not driven: {driven.trial.not_driven}")
    ratio, leg = driven.trial.value("speed_ratio"), driven.leg("drive")
    if leg is None or driven.drives_backwards:
        return
    if ratio is None:
        yield finding(
            driven.drive,
            "a limit of its velocity or acceleration is 0: it stands still, whatever it is told",
            key="speed_ratio",
        )
        return
    off = abs(ratio - 1.0)
    if off <= warning_beyond:
        return
    reached = round(ratio * leg.linear, 3) + 0.0
    yield finding(
        driven.drive,
        f"told to drive at {leg.linear:.3g} m/s, it reaches {reached:g} m/s: off by {off:.0%}, "
        f"expected at most {warning_beyond:.0%}{_cause(driven, ratio, warning_beyond)}",
        severity=Severity.ERROR if off > error_beyond else Severity.WARNING,
        key="speed_ratio",
    )


def _cause(driven: RobotTrial, ratio: float, tolerance: float) -> str:
    """Say so when the radius that the plugin counts with explains the speed."""
    for drive in driven.robot.locomotion.wheel_drives:
        stated = drive.wheel_radius.value
        for wheel in drive.wheels:
            if wheel.radius and stated > 0.0 and abs(wheel.radius / stated - ratio) <= tolerance:
                return f"; wheel_radius is {stated:g} m, the wheels' own is {wheel.radius:.3g} m"
    return ""


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
BAD = [_rover(0.15, "  <!-- ^ TRI003 -->")]
