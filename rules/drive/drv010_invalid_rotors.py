"""Rotors that cannot carry or steer the multicopter, or that do not match its controller.

The controller commands the rotors by number, and computes each speed from the constants and
directions it is given. A repeated number, a wrong direction or a motor that the controller does not
know makes the robot tumble. With less thrust than weight it stays on the ground. A rotor that spins
across its thrust sweeps through the robot. Of the accepted packages that we checked, one shows
this: rotors that lift thousands of times its weight.

Fix: number the rotors from 0 in the order of `<rotorConfiguration>`; turn half of them `ccw` and
half `cw`, adjacent ones opposite; copy `motorConstant`, `momentConstant` and the direction (ccw is
1) to the controller; correct `maxRotVelocity`, in rad/s.
Source: gz-sim's MulticopterMotorModel (thrust = motorConstant · ω²) and MulticopterVelocityControl,
which refuses rotors that do not command climb, roll, pitch and yaw independently.
"""

from collections import defaultdict
from collections.abc import Iterable, Iterator, Sequence

from checker.model.components import Plugin
from checker.model.locomotion.locomotion import DriveKind, Rotor, RotorEntry
from checker.model.locomotion.rotors import (
    controlled_motions,
    greatest_thrust,
    thrust_to_weight,
    yaw_imbalance,
)
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_ALL_MOTIONS = 4
"""Climb, roll, pitch and yaw."""


@rule("DRV010", "invalid-rotors", Severity.ERROR, Concern.ROBOT, judges=("thrust_to_weight",))
def check(
    robot: Robot,
    *,
    least_thrust: float = 1.1,
    most_thrust: float = 50.0,
    imbalance: float = 0.05,
    tolerance: float = 0.01,
    least_cosine: float = 0.5,
) -> Findings:
    """Check each motor, and compare it with the others and with the controller.

    PLG004 reports joints and links that do not exist.

    Options:
        least_thrust: Thrust of all rotors at full speed, in multiples of the robot's weight; less
            is an error.
        most_thrust: Thrust of all rotors at full speed, in multiples of the robot's weight; more is
            a warning.
        imbalance: Share of the sum of the rotors' torques that may remain at equal speed; more is a
            warning.
        tolerance: Share of a motor's `<motorConstant>` or `<momentConstant>` by which the
            controller's may differ; more is a warning.
        least_cosine: Cosine of the angle between a rotor's joint axis and its thrust, up or down;
            less is an error.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    rotors = robot.locomotion.rotors
    by_themselves = [
        *(fault for rotor in rotors for fault in _incomplete(rotor)),
        *(fault for group in _groups(rotors) for fault in _numbers(group)),
    ]
    yield from by_themselves
    yield from _askew(robot, least_cosine)
    for copter in robot.locomotion.copters:
        own = [rotor for rotor in rotors if rotor.plugin.nested_in == copter.plugin.nested_in]
        strangers = list(_strangers(copter.entries, own))
        yield from strangers
        yield from _disagreements(copter.entries, own, tolerance)
        if not by_themselves and not strangers:
            yield from _order(copter.entries, own)
        yield from _control(copter.plugin, own, imbalance)
    if rotors and robot.unweighed:
        yield unchecked(robot.unweighed)
    elif not robot.unread_plugins:
        yield from _thrust(robot, least_thrust, most_thrust)


def _incomplete(rotor: Rotor) -> Iterator[Finding]:
    missing = [tag for tag in ("jointName", "linkName") if not any(rotor.plugin.at(tag))]
    if rotor.number is None:
        missing.append("motorNumber")
    if not rotor.direction:
        missing.append("turningDirection (ccw or cw)")
    if missing:
        yield finding(
            rotor.plugin,
            f"the motor of {rotor.name.value!r} states no {', '.join(missing)}, so it does not "
            "turn",
        )


def _groups(rotors: Iterable[Rotor]) -> Iterable[list[Rotor]]:
    """Group rotors by the commands they listen to."""
    groups: dict[tuple[str, ...], list[Rotor]] = defaultdict(list)
    for rotor in rotors:
        topics = (t.value for tag in _TOPIC_TAGS for t in rotor.plugin.at(tag))
        groups[(rotor.plugin.nested_in, *topics)].append(rotor)
    return groups.values()


def _askew(robot: Robot, least_cosine: float) -> Iterator[Finding]:
    """Report rotors that spin about another axis than their thrust: z of the link."""
    for rotor in robot.locomotion.rotors:
        pose = robot.pose_of(rotor.link.scoped_name) if rotor.link is not None else None
        if pose is None or rotor.axis is None or rotor.joint is None:
            continue
        thrust = pose.rotate((0.0, 0.0, 1.0))
        if abs(sum(a * b for a, b in zip(thrust, rotor.axis, strict=True))) < least_cosine:
            yield finding(
                rotor.joint.axes[0].xyz[0],
                f"rotor {rotor.name.value!r} spins across its thrust: its joint axis must be the "
                "z axis of its link",
                related=[(rotor.plugin, "the motor")],
            )


_TOPIC_TAGS = ("robotNamespace", "commandSubTopic")


def _numbers(rotors: Sequence[Rotor]) -> Iterator[Finding]:
    first: dict[float, Rotor] = {}
    for rotor in rotors:
        if rotor.number is None:
            continue
        number = rotor.number.value
        other = first.setdefault(number, rotor)
        if other is not rotor:
            yield finding(
                rotor.number,
                f"motorNumber of {rotor.name.value!r} is {number:g}, and {other.name.value!r} has "
                "the same number",
                related=[(other.plugin, "the other motor")],
            )
        elif number not in range(len(rotors)):
            yield finding(
                rotor.number,
                f"motorNumber of {rotor.name.value!r} is {number:g}, expected 0 to "
                f"{len(rotors) - 1}: there are {len(rotors)} motors",
            )


def _strangers(entries: Sequence[RotorEntry], rotors: Sequence[Rotor]) -> Iterator[Finding]:
    motors = {rotor.name.value for rotor in rotors}
    known = {entry.joint_name.value for entry in entries}
    for entry in entries:
        if entry.joint_name.value not in motors:
            yield finding(
                entry.joint_name,
                f"rotor {entry.joint_name.value!r} of the controller has no MulticopterMotorModel",
            )
    for rotor in rotors if entries else ():
        if rotor.name.value not in known:
            yield finding(
                rotor.plugin, f"the controller does not know the rotor {rotor.name.value!r}"
            )


def _pairs(
    entries: Sequence[RotorEntry], rotors: Sequence[Rotor]
) -> Iterator[tuple[int, RotorEntry, Rotor]]:
    """Yield the entries of the controller, counted from 0, with their motors."""
    motors = {rotor.name.value: rotor for rotor in rotors}
    for number, entry in enumerate(entries):
        if entry.joint_name.value in motors:
            yield number, entry, motors[entry.joint_name.value]


def _order(entries: Sequence[RotorEntry], rotors: Sequence[Rotor]) -> Iterator[Finding]:
    for number, entry, motor in _pairs(entries, rotors):
        if motor.number is not None and motor.number.value != number:
            yield finding(
                motor.number,
                f"motorNumber of {motor.name.value!r} is {motor.number.value:g}, but it is rotor "
                f"{number} of the controller, which counts from 0",
                related=[(entry, "in the controller")],
            )


def _disagreements(
    entries: Sequence[RotorEntry], rotors: Sequence[Rotor], tolerance: float
) -> Iterator[Finding]:
    for _, entry, motor in _pairs(entries, rotors):
        name, direction = motor.name.value, entry.direction
        if direction is not None and motor.direction and direction.value != motor.direction:
            yield finding(
                direction,
                f"direction of {name!r} is {direction.value:g} for the controller, but "
                f"{motor.direction} for its motor",
                related=[(motor.plugin, "the motor")],
            )
        pairs = (
            ("forceConstant", entry.force_constant, motor.motor_constant),
            ("momentConstant", entry.moment_constant, motor.moment_constant),
        )
        for tag, expected, actual in pairs:
            yield from _other_constant(name, tag, expected, actual, tolerance)


def _other_constant(
    name: str,
    tag: str,
    stated: Located[float] | None,
    actual: Located[float] | None,
    tolerance: float,
) -> Iterator[Finding]:
    if stated is None or actual is None:
        return
    if abs(stated.value - actual.value) > tolerance * abs(actual.value):
        yield finding(
            stated,
            f"{tag} of {name!r} is {stated.value:g}, but its motor has {actual.value:g}",
            severity=Severity.WARNING,
            related=[(actual, "the motor's")],
        )


def _control(plugin: Plugin, own: Sequence[Rotor], imbalance: float) -> Iterator[Finding]:
    share = yaw_imbalance(own)
    motions = controlled_motions(own)
    if share is not None and share > imbalance:
        yield finding(
            own[0].plugin,
            f"the directions of the {len(own)} rotors do not cancel: at equal speed {share:.0%} "
            "of their torque turns the robot",
            severity=Severity.WARNING,
        )
    if own and motions is not None and motions < _ALL_MOTIONS:
        yield finding(
            plugin,
            f"the places and directions of the {len(own)} rotors command {motions} of climb, "
            "roll, pitch and yaw independently, expected all 4",
        )


def _thrust(robot: Robot, least: float, most: float) -> Iterator[Finding]:
    rotors = [rotor for rotor in robot.locomotion.rotors if rotor.lifts]
    if robot.locomotion.kind is not DriveKind.MULTICOPTER:
        return
    ratio = thrust_to_weight(rotors, robot.mass)
    if ratio is None or least <= ratio <= most:
        return
    strongest = max(rotors, key=greatest_thrust)
    weak, shown = ratio < least, f"{ratio:,.0f}" if ratio > most else f"{ratio:.3g}"
    expected = (
        f"at least {least:g}"
        if weak
        else f"at most {most:g}: maxRotVelocity or motorConstant is wrong"
    )
    yield finding(
        strongest.max_velocity or strongest.plugin,
        f"the {len(rotors)} rotors lift {shown} times the weight of {robot.mass:.4g} kg, "
        f"expected {expected}",
        severity=Severity.ERROR if weak else Severity.WARNING,
        key="thrust_to_weight",
    )


_PLACES = ("1 -1", "-1 1", "1 1", "-1 -1")
_WAYS = ("ccw", "ccw", "cw", "cw")
_MARK = "  <!-- ^ DRV010 -->"


def _motor(number: int, way: str) -> str:
    return f"""
<plugin filename="libm.so" name="ignition::gazebo::systems::MulticopterMotorModel">
  <jointName>hub_{number}</jointName>
  <linkName>rotor_{number}</linkName>
  <turningDirection>{way}</turningDirection>
  <motorConstant>8e-06</motorConstant>
  <momentConstant>0.016</momentConstant>
  <maxRotVelocity>80{number}</maxRotVelocity>
  <motorNumber>{number}</motorNumber>
</plugin>"""


def _entry(number: int, way: str) -> str:
    return f"""
  <rotor>
    <jointName>hub_{number}</jointName>
    <forceConstant>8e-06</forceConstant><!-- {number} -->
    <momentConstant>0.016</momentConstant>
    <direction>{1 if way == "ccw" else -1}</direction><!-- {number} -->
  </rotor>"""


def _copter(*changes: tuple[str, str], ways: Sequence[str] = _WAYS) -> str:
    """Return a quadrotor of 1.04 kg that lifts twice its weight, with texts replaced."""
    links = "".join(
        f"""
<link name="rotor_{n}">
  <pose>{place} 0 0 0 0</pose><inertial><mass>0.01</mass></inertial>
</link>
<joint name="hub_{n}" type="revolute">
  <parent>base_link</parent><child>rotor_{n}</child><axis><xyz>0 0 1</xyz></axis>
</joint>"""
        for n, place in enumerate(_PLACES)
    )
    text = f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link"><inertial><mass>1</mass></inertial></link>
{links}
{"".join(_motor(n, way) for n, way in enumerate(ways))}
<plugin filename="libc.so" name="ignition::gazebo::systems::MulticopterVelocityControl">
  <rotorConfiguration>{"".join(_entry(n, way) for n, way in enumerate(ways))}
  </rotorConfiguration>
</plugin>
</model>
</sdf>
"""
    for old, new in changes:
        text = text.replace(old, new)
    return text


def _marked(old: str, new: str) -> tuple[str, str]:
    return old, new + _MARK


def _marked_before(text: str, line: str) -> tuple[str, str]:
    return f"{line}\n  {text}", f"{line}{_MARK}\n  {text}"


_CONTROL = 'MulticopterVelocityControl">'
_BASE = "<mass>1</mass>"
_MOTOR = 'MulticopterMotorModel">'
_AXIS = "<child>rotor_3</child><axis><xyz>0 0 1</xyz></axis>"
_SECOND = "<motorNumber>2</motorNumber>"
_THIRD = "<motorNumber>3</motorNumber>"

GOOD = [
    _copter(),
    _copter(("ignition::gazebo", "gz::sim")),
    _copter((_BASE, "<mass>1.5</mass>")),
    _copter(("1 -1 0 0", "0.9 -1 0 0")),
    '<plugin filename="libc.so" name="gz::sim::systems::MulticopterVelocityControl"/>',
]
BAD = [
    _copter(_marked(_AXIS, _AXIS.replace("0 0 1", "1 0 0"))),
    _copter((_BASE, "<mass>3</mass>"), _marked("803</maxRotVelocity>", "803</maxRotVelocity>")),
    _copter(_marked("802</maxRotVelocity>", "8000</maxRotVelocity>")),
    _copter(_marked(_THIRD, _THIRD.replace("3", "2"))),
    _copter(_marked(_THIRD, _THIRD.replace("3", "4"))),
    _copter(
        (_THIRD, "<motorNumber>other</motorNumber>"),
        _marked(_SECOND, _THIRD),
        _marked("<motorNumber>other</motorNumber>", _SECOND),
    ),
    _copter(_marked("8e-06</forceConstant><!-- 1 -->", "9e-06</forceConstant>")),
    _copter(_marked("<direction>1</direction><!-- 1 -->", "<direction>-1</direction>")),
    _copter(
        ("<jointName>hub_3</jointName>\n    ", "<jointName>hub_2</jointName>\n    "),
        _marked_before("<jointName>hub_3", _MOTOR),
    ),
    _copter(
        _marked(_CONTROL, _CONTROL),
        _marked_before("<jointName>hub_0</jointName>\n  <l", _MOTOR),
        ways=("ccw",) * 4,
    ),
    _copter(_marked(_CONTROL, _CONTROL), ways=("ccw", "cw", "ccw", "cw")),
]
