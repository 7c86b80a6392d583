"""An interface whose limits, start value or name do not fit its joint.

`<param name="min">` and `max` can make the limits of the URDF tighter, not wider. Mock hardware and
Gazebo put the joint at its start position even if that is outside of its limits, and the limits
then push it back. Controllers do not find an interface whose name is a misspelt standard one.
gazebo_ros2_control offers `position_pid` as `position`, and `velocity_pid` as `velocity`.

Fix: keep `min`, `max` and `initial_value` within the `<limit>` of the joint, and write `position`,
`velocity`, `acceleration` or `effort`.
Source: ros2_control, hardware_interface/src/component_parser.cpp and joint_limits; types/
hardware_interface_type_values.hpp.
"""

from collections.abc import Iterator, Mapping

from checker.base.words import Suggestions
from checker.model.components import Axis, Joint
from checker.ros.ros2_control.hardware import (
    STANDARD_INTERFACES,
    WITH_PID,
    HardwareJoint,
    Interface,
)
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Finding, Findings, Severity, finding, misspelt, rule
from checker.rulebook.example_parts import ros2_control

_LIMITED = ("revolute", "prismatic")


@rule("R2C007", "invalid-control-interface", Severity.WARNING, Concern.INTERFACE)
def check(control: RobotControl) -> Findings:
    """Report misspelt interfaces, and numbers that the joint does not allow.

    Limits that are wider than those of the URDF are infos.
    """
    suggestions = Suggestions(STANDARD_INTERFACES)
    for hardware in control.hardware:
        for joint in hardware.joints:
            known = control.joint(joint)
            for interface in (*joint.commands, *joint.states):
                yield from _misspelt(joint, interface, suggestions)
                yield from _no_numbers(joint, interface)
                yield from _numbers(joint, interface, known)


def _misspelt(
    joint: HardwareJoint, interface: Interface, suggestions: Suggestions
) -> Iterator[Finding]:
    name = interface.name.value
    if name not in (*STANDARD_INTERFACES, *WITH_PID) and suggestions.closest(name):
        message = f"joint {joint.name.value!r} has the interface {name!r}, which no controller uses"
        yield misspelt(interface.name, message, suggestions)


def _no_numbers(joint: HardwareJoint, interface: Interface) -> Iterator[Finding]:
    for name in ("min", "max", "initial_value"):
        text = interface.params.get(name)
        if text is not None and name not in interface.numbers and "$" not in text.value:
            yield finding(
                text,
                f"{name} of {interface.name.value} of joint {joint.name.value!r} is "
                f"{text.value!r}, which is not a number",
            )


def _numbers(joint: HardwareJoint, interface: Interface, known: Joint | None) -> Iterator[Finding]:
    low, high = interface.numbers.get("min"), interface.numbers.get("max")
    called = f"{interface.name.value} of joint {joint.name.value!r}"
    if low is not None and high is not None and low.value >= high.value:
        yield finding(low, f"min {low.value:g} of {called} is not below max {high.value:g}")
        return
    bounds = _bounds(known, interface.name.value)
    if bounds is None:
        return
    lower, upper = bounds
    for name, number in interface.numbers.items():
        if lower <= number.value <= upper or name not in ("min", "max", "initial_value"):
            continue
        allowed = f"outside of {lower:g} to {upper:g}, which the URDF allows"
        starts = name == "initial_value"
        yield finding(
            number,
            f"{'initial_value' if starts else name} {number.value:g} of {called} is {allowed}",
            severity=None if starts else Severity.INFO,
            key="" if starts else name,
        )


def _bounds(joint: Joint | None, interface: str) -> tuple[float, float] | None:
    """Return what the URDF allows an interface of a joint; None if it states nothing."""
    if joint is None or not joint.axes:
        return None
    axis = joint.axes[0]
    if interface == "position" and joint.type.value in _LIMITED and axis.lower.stated:
        return axis.lower.value, axis.upper.value
    most = _most(axis).get(interface)
    return None if most is None or most <= 0.0 else (-most, most)


def _most(axis: Axis) -> Mapping[str, float]:
    return {
        name: limit.value
        for name, limit in (("velocity", axis.velocity), ("effort", axis.effort))
        if limit.stated
    }


def _arm(inside: str) -> object:
    return {"@urdf": ros2_control(f'<joint name="shoulder">\n{inside}\n</joint>')}


def _param(interface: str, name: str, value: str, mark: str = "") -> str:
    return (
        f'<command_interface name="{interface}">\n'
        f'<param name="{name}">{value}</param>{mark}\n</command_interface>'
    )


_MARK = "  <!-- ^ R2C007 -->"
GOOD = [
    _arm(_param("position", "min", "-0.5")),
    _arm(_param("position", "initial_value", "0.3")),
    _arm('<command_interface name="velocity"/><state_interface name="gripper_force"/>'),
    _arm('<command_interface name="position_pid"/>'),
]
BAD = [
    _arm(_param("position", "max", "3", _MARK)),
    _arm(_param("velocity", "min", "-2", _MARK)),
    _arm(_param("velocity", "min", "fast", _MARK)),
    _arm(_param("position", "initial_value", "1.5", _MARK)),
    _arm(f'<command_interface name="postion"/>{_MARK}'),
    _arm(
        f"""<command_interface name="effort">
        <param name="min">-500</param>{_MARK}
        <param name="max">-500</param>
        </command_interface>"""
    ),
    _arm(
        f"""<command_interface name="position">
        <param name="min">0.5</param>{_MARK}
        <param name="max">-0.5</param>
        </command_interface>"""
    ),
]
