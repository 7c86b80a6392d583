"""The drive plugin's wheel radius differs from that of the wheels.

The plugin computes the wheel rate from the speed and `wheel_radius`. If the radius is 10 % too
large, the robot is 10 % slower than commanded and its odometry is 10 % wrong. No accepted package
that we checked has this fault.

Fix: set the parameter that the message names to the radius of the wheels' collisions, or to twice
the radius if it is a diameter, in metres. The drive of Gazebo Classic for ROS 2 reads one
`<wheel_diameter>` for each pair of wheels.
Source: parameters of Gazebo's DiffDrive, AckermannSteering and MecanumDrive, 0.2 m by default;
gazebo_ros_diff_drive.cpp, 0.15 m by default.
"""

from collections.abc import Iterator

from checker.formats.corrections import rewrite
from checker.model.components import Plugin
from checker.model.locomotion.locomotion import Wheel, WheelDrive
from checker.model.locomotion.wheels import is_misaligned
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked


@rule("GEO004", "wheel-radius-disagrees", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, *, error_above: float = 0.10, warning_above: float = 0.03) -> Findings:
    """Compare a drive's radius with the radius of its wheels' collisions.

    Tilted wheels have no radius to compare: GEO003 reports them.

    Options:
        error_above: Share of a wheel's true radius by which the drive's may differ before it is an
            error.
        warning_above: Share of a wheel's true radius by which the drive's may differ; more is a
            warning.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for drive in robot.locomotion.wheel_drives:
        yield from _worst(robot, drive, error_above, warning_above)


def _worst(
    robot: Robot, drive: WheelDrive, error_above: float, warning_above: float
) -> Iterator[Finding]:
    stated = drive.wheel_radius
    off: list[tuple[float, float, Wheel]] = []
    for number, wheel in enumerate(drive.wheels):
        if wheel.radius is not None and wheel.radius > 0 and not is_misaligned(robot, wheel):
            off.append((abs(stated.value / wheel.radius - 1), -number, wheel))
    if not off:
        return
    share, _, wheel = max(off, key=lambda row: row[:2])
    if not share > warning_above:
        return
    differing = sum(other[0] > warning_above for other in off)
    length, times = ("diameter", 2) if drive.diameter_tag else ("radius", 1)
    # As many digits as the message has.
    true = float(f"{wheel.radius or 0.0:.4g}")
    tag = drive.diameter_tag or drive.radius_tag
    yield finding(
        stated,
        f"{drive.plugin.label} {_says(drive, tag)} {stated.value * times:g} m, but wheel "
        f"{wheel.link.name.value!r} has a {length} of {(wheel.radius or 0.0) * times:.4g} m"
        + (f" ({differing} wheels differ)" if differing > 1 else ""),
        severity=Severity.ERROR if share > error_above else Severity.WARNING,
        # Plugin and controller, or the files of two distributions, say the same of one wheel.
        key=f"{wheel.link.name.value} {stated.value:g}",
        related=[(wheel.link, "the wheel")],
        fix=rewrite([(stated, true)], times) if differing == len(off) else None,
    )


def _says(drive: WheelDrive, tag: str) -> str:
    """Return what a drive says of its wheels: Classic's plugin has a diameter for each pair."""
    if drive.wheel_radius.stated:
        return f"has {tag}"
    plugin = drive.plugin
    if isinstance(plugin, Plugin) and any(plugin.at(tag)):
        return f"states <{tag}> for other pairs of wheels only; its default is"
    return f"states no {tag}; its default is"


def _rover(radius: str, shape: str = "", plugin: str = "DiffDrive") -> str:
    shape = shape or "<cylinder><radius>0.1</radius><length>0.05</length></cylinder>"
    return f"""
<link name="wheel">
  <collision name="c">
    <pose>0 0 0 1.5707963267948966 0 0</pose>
    <geometry>{shape}</geometry>
  </collision>
</link>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::{plugin}">
  <left_joint>axle</left_joint>
  {radius}
</plugin>
"""


_MARK = "  <!-- ^ GEO004 -->"
GOOD = [
    _rover("<wheel_radius>0.1</wheel_radius>"),
    _rover("<wheel_radius>0.102</wheel_radius>"),
    _rover("<wheel_radius>0.5</wheel_radius>", plugin="TrackedVehicle"),
    _rover("", "<sphere><radius>0.2</radius></sphere>"),
]
BAD = [
    _rover(f"<wheel_radius>0.12</wheel_radius>{_MARK}"),
    _rover(f"<wheel_radius>0.105</wheel_radius>{_MARK}"),
    _rover(f"<wheel_radius>0.05</wheel_radius>{_MARK}", plugin="AckermannSteering"),
    _rover("").replace('DiffDrive">', f'DiffDrive">{_MARK}'),
]
