"""A joint of ros2_control that the URDF does not have, or that is fixed.

From Jazzy on, the controller manager compares the joints of each `<ros2_control>` tag with those of
the URDF and ends with an error: none of the robot's controllers runs. Humble does not compare them;
there, the joint just never moves.

Fix: write the joint's name as the URDF has it, with its prefix, and leave out joints that cannot
move.
Source: ros2_control, hardware_interface/src/component_parser.cpp,
`parse_control_resources_from_urdf`.
"""

from checker.base.words import Suggestions
from checker.ros.ros2_control.distributions import distribution_of, is_from
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Context, Findings, Severity, finding, misspelt, rule
from checker.rulebook.example_parts import ros2_control


@rule("R2C001", "joint-not-movable", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl, context: Context) -> Findings:
    """Report joints of `<ros2_control>` that do not exist or are fixed; for Humble as warnings."""
    distribution = distribution_of(context)
    severity = None if is_from(distribution, "jazzy") else Severity.WARNING
    suggestions = Suggestions(control.robot.joints_by_name)
    for hardware in control.hardware:
        for joint in hardware.joints:
            name, known = joint.name, control.joint(joint)
            message = f"<ros2_control> {hardware.name.value!r} has joint {name.value!r}, which"
            if known is None and name.stated and not control.may_be_included(name):
                message += " the URDF does not have"
                yield misspelt(name, message, suggestions, severity=severity)
            elif known is not None and known.type.value == "fixed" and name.stated:
                yield finding(name, f"{message} is fixed", severity=severity)


def _arm(joint: str, more: str = "") -> dict[str, str]:
    interfaces = '<command_interface name="position"/><state_interface name="position"/>'
    return {"@urdf": more + ros2_control(f"{joint}\n{interfaces}</joint>")}


_FIXED = """
<link name="tool"/>
<joint name="tool_joint" type="fixed"><parent link="upper_arm"/><child link="tool"/></joint>
"""
GOOD = [_arm('<joint name="shoulder">'), {"@urdf": True}]
BAD = [
    _arm('<joint name="shoulder_joint">  <!-- ^ R2C001 -->'),
    _arm('<joint name="tool_joint">  <!-- ^ R2C001 -->', _FIXED),
]
