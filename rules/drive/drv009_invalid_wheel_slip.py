"""WheelSlip leaves out a wheel or has the numbers of another robot.

The plugin converts a wheel's slip to a force with its normal force and radius. A wheel that is left
out grips the ground while the others slip; numbers copied from a heavier robot make it glide. Of
the accepted packages that we checked, one shows this: its forces add up to 40 % of its weight.

Fix: list every driven wheel. `wheel_normal_force` is the robot's weight divided by the number of
wheels, m·g/n in N; `wheel_radius` is the radius of the wheel in m; `slip_compliance_lateral` is
above zero.
Source: parameters of Gazebo's WheelSlip; all accepted skid-steer robots that we checked state
m·g/n.
"""

import math
from collections.abc import Iterator, Sequence

from checker.model.components import Plugin
from checker.model.locomotion.rotors import GRAVITY
from checker.model.locomotion.wheel_slip import SlippingWheel, slipping_wheels
from checker.model.locomotion.wheels import is_misaligned
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked


@rule("DRV009", "invalid-wheel-slip", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, force: float = 0.2, radius: float = 0.03) -> Findings:
    """Compare WheelSlip with the robot.

    PLG004 reports wheels that do not exist.

    Options:
        force: Share by which `<wheel_normal_force>` may be above the weight divided by the number
            of driven or listed wheels, or below the weight divided by the number of all wheels.
        radius: Share of the wheel's radius, measured at its collisions, by which `<wheel_radius>`
            may differ.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    listed = list(slipping_wheels(robot))
    if not listed:
        return
    if robot.unweighed:
        yield unchecked(robot.unweighed)
        return
    yield from _left_out(robot, listed)
    yield from _compliances(listed)
    yield from _forces(robot, listed, force)
    yield from _radii(robot, listed, radius)


def _left_out(robot: Robot, listed: Sequence[SlippingWheel]) -> Iterator[Finding]:
    names = {entry.link for entry in listed}
    for wheel in robot.locomotion.wheels:
        if not names.intersection(link.scoped_name for link in wheel.body):
            yield finding(
                listed[0].plugin,
                f"WheelSlip does not list {wheel.link.name.value!r}, which the drive turns",
                related=[(wheel.link, "the wheel")],
            )


def _compliances(listed: Sequence[SlippingWheel]) -> Iterator[Finding]:
    for entry in listed:
        if entry.lateral is None:
            yield finding(
                entry,
                f"slip_compliance_lateral of {entry.link!r} is missing: without it the wheel does "
                "not slip sideways",
            )
        elif not entry.lateral.value > 0:
            yield finding(
                entry.lateral,
                f"slip_compliance_lateral of {entry.link!r} is {entry.lateral.value:g}, expected a "
                "positive number",
            )


def _forces(robot: Robot, listed: Sequence[SlippingWheel], tolerance: float) -> Iterator[Finding]:
    wheels = max(len({entry.link for entry in listed}), _driven(robot))
    # Wheels that turn freely may carry their share of the weight.
    carrying = max(wheels, len(robot.wheels))
    mass = robot.mass
    most = mass * GRAVITY / wheels
    least = mass * GRAVITY / carrying
    if not (math.isfinite(most) and least > 0):
        return
    for entry in listed:
        stated = entry.normal_force
        if stated is None or entry.link not in robot.links_by_name:
            continue
        if not least * (1 - tolerance) <= stated.value <= most * (1 + tolerance):
            yield finding(
                stated,
                f"wheel_normal_force of {entry.link!r} is {stated.value:g} N, expected "
                f"{most:.4g} N: {mass:.4g} kg on {wheels} wheels",
                key=f"{stated.value:g} N",
            )


def _driven(robot: Robot) -> int:
    """Return how many wheels the drive plugins name, including those that do not exist."""
    names = [
        name.value
        for drive in robot.locomotion.wheel_drives
        if isinstance(drive.plugin, Plugin)
        for name in drive.plugin.values("left_joint", "right_joint")
    ]
    return len(set(names))


def _radii(robot: Robot, listed: Sequence[SlippingWheel], tolerance: float) -> Iterator[Finding]:
    wheels = {link.scoped_name: wheel for wheel in robot.locomotion.wheels for link in wheel.body}
    for entry in listed:
        wheel = wheels.get(entry.link)
        if wheel is None or entry.radius is None or not wheel.radius or is_misaligned(robot, wheel):
            continue
        if abs(entry.radius.value - wheel.radius) > tolerance * wheel.radius:
            yield finding(
                entry.radius,
                f"wheel_radius of {entry.link!r} is {entry.radius.value:g} m, but its collision "
                f"has {wheel.radius:.4g} m",
                key=f"{entry.radius.value:g} {wheel.radius:.4g} m",
            )


def _rover(second: str, lateral: str = "0.1", force: str = "49", radius: str = "0.1") -> str:
    links = "".join(
        f"""
<link name="wheel_{side}">
  <inertial><mass>1</mass></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="axle_{side}" type="revolute">
  <parent>base_link</parent><child>wheel_{side}</child><axis><xyz>0 1 0</xyz></axis>
</joint>
"""
        for side in ("left", "right")
    )
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link"><inertial><mass>8</mass></inertial></link>
{links}
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle_left</left_joint>
  <right_joint>axle_right</right_joint>
</plugin>
<plugin filename="libw.so" name="ignition::gazebo::systems::WheelSlip">{second}
  <wheel link_name="wheel_left">
    <slip_compliance_lateral>0.1</slip_compliance_lateral>
    <wheel_normal_force>49</wheel_normal_force>
    <wheel_radius>0.1</wheel_radius>
  </wheel>
  <wheel link_name="{"wheel_left" if second else "wheel_right"}">
    <slip_compliance_lateral>{lateral}
    <wheel_normal_force>{force}
    <wheel_radius>{radius}
  </wheel>
</plugin>
</model>
</sdf>
"""


_LATERAL = "</slip_compliance_lateral>"
_FORCE = "</wheel_normal_force>"
_RADIUS = "</wheel_radius>"
_RIGHT = (f"0.1{_LATERAL}", f"49{_FORCE}", f"0.1{_RADIUS}")
_MARK = "  <!-- ^ DRV009 -->"

GOOD = [
    _rover("", *_RIGHT),
    _rover("", f"0.172{_LATERAL}", f"45{_FORCE}", f"0.1{_RADIUS}"),
    '<plugin filename="libw.so" name="gz::sim::systems::WheelSlip"/>',
]
BAD = [
    _rover(_MARK, *_RIGHT),
    _rover("", f"0{_LATERAL}{_MARK}", *_RIGHT[1:]),
    _rover("", _RIGHT[0], f"139{_FORCE}{_MARK}", _RIGHT[2]),
    _rover("", *_RIGHT[:2], f"0.2{_RADIUS}{_MARK}"),
]
