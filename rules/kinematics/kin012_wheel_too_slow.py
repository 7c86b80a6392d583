"""A wheel's velocity limit is below the speed that the drive plugin may command.

The drive plugin uses its own limit, but the joint stays below it: the robot is slower than
specified. If only some wheels are limited, odometry and turning are wrong too. No accepted package
that we checked has this fault.

Fix: raise the joint's `<velocity>` to at least `max_velocity` / `wheel_radius` of the plugin, or
lower `max_velocity`.
Source: a wheel of radius r that turns at ω rolls at ω·r; parameters of Gazebo's DiffDrive and
AckermannSteering.
"""

from collections.abc import Iterator

from checker.model.components import Plugin
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_WHEELS = {
    "DiffDrive": ("left_joint", "right_joint"),
    "AckermannSteering": ("left_joint", "right_joint"),
    "MecanumDrive": (
        *("front_left_joint", "front_right_joint"),
        *("back_left_joint", "back_right_joint"),
    ),
}
_SPEEDS = ("max_linear_velocity", "max_velocity")
"""Parameters that limit a drive's speed; only the first stated one counts."""


@rule("KIN012", "wheel-too-slow", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, tolerance: float = 0.01) -> Findings:
    """Report wheels that do not reach their drive's maximum speed.

    Options:
        tolerance: Share of the drive's maximum speed by which the joint's velocity limit times
            `<wheel_radius>` may be less.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for plugin in robot.plugins:
        speeds = [speed for path in _SPEEDS if (speed := plugin.number(path))]
        radius = plugin.number("wheel_radius")
        if plugin.class_name in _WHEELS and speeds and radius is not None:
            yield from _slow_wheels(robot, plugin, speeds[0], radius.value, tolerance)


def _slow_wheels(
    robot: Robot, plugin: Plugin, speed: Located[float], radius: float, tolerance: float
) -> Iterator[Finding]:
    scope = f"{plugin.nested_in}::" if plugin.nested_in else ""
    names = [name.value for path in _WHEELS[plugin.class_name] for name in plugin.at(path)]
    for name in dict.fromkeys(names):
        joint = robot.joints_by_name.get(scope + name)
        if joint is None or not joint.axes:
            continue
        limit = joint.axes[0].velocity
        reached = limit.value * radius
        if reached < speed.value * (1.0 - tolerance):
            yield finding(
                limit,
                f"joint {name!r} turns at {limit.value:g} rad/s at most, which is {reached:.3g} "
                f"m/s on a wheel of {radius:g} m, but {plugin.class_name} allows {speed.value:g} "
                "m/s",
                key=f"{limit.value:g} {speed.value:g}",
                related=[(speed, "the drive's maximum speed")],
                covered_by=("TRI003",),
            )


def _driven(velocity: str, plugin: str = "DiffDrive") -> str:
    return f"""
<link name="wheel"/>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>wheel</child>
  <axis>
    <xyz>0 1 0</xyz>
    <limit><velocity>{velocity}
  </axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::{plugin}">
  <left_joint>axle</left_joint>
  <wheel_radius>0.1</wheel_radius>
  <max_velocity>2</max_velocity>
</plugin>
"""


_OVER = "</velocity></limit>"
_MARK = f"{_OVER}  <!-- ^ KIN012 -->"
GOOD = [_driven(f"20{_OVER}"), _driven(f"-1{_OVER}"), _driven(f"5{_OVER}", "TrackedVehicle")]
BAD = [_driven(f"5{_MARK}"), _driven(f"19{_MARK}", "AckermannSteering")]
