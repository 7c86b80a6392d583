"""A mimic joint of ros2_control that contradicts the URDF.

A joint with `<mimic>` in the URDF follows its leader and cannot be commanded as well. From Jazzy
on, the controller manager ends with an error if such a joint has a command interface, if its leader
is not in the same `<ros2_control>` tag, and if a joint is marked `mimic="true"` that has no
`<mimic>`. `<param name="mimic">` is only read by Humble: later, the joint does not move.

Fix: leave only state interfaces at the joint and keep `<mimic>` in the URDF; for a joint with a
separate motor, write `mimic="false"`.
Source: ros2_control, hardware_interface/src/component_parser.cpp,
`parse_control_resources_from_urdf`; migration notes from Iron to Jazzy.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.ros.ros2_control.distributions import distribution_of, is_from
from checker.ros.ros2_control.hardware import Hardware, HardwareJoint
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule

_STOPS = "the controller manager (ros2_control_node) stops, and no controller runs"


@rule("R2C002", "invalid-mimic-joint", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl, context: Context) -> Findings:
    """Report mimic joints that end the controller manager, from Jazzy on.

    A `<param name="mimic">` that nothing reads is a warning.
    """
    if not is_from(distribution_of(context), "jazzy"):
        return
    for hardware in control.hardware:
        for joint in hardware.joints:
            known = control.joint(joint)
            if known is not None:
                yield from _judged(hardware, joint, known)


def _judged(hardware: Hardware, joint: HardwareJoint, known: Joint) -> Iterator[Finding]:
    name, says = joint.name.value, joint.mimic.value if joint.mimic is not None else ""
    leader = next(iter(known.mimics), None)
    if leader is None:
        if joint.mimic is not None and says == "true":
            yield finding(
                joint.mimic,
                f"{_STOPS}: joint {name!r} is marked as mimic, but has no <mimic> in the URDF",
            )
        elif "mimic" in joint.params and not joint.commands:
            yield finding(
                joint.params["mimic"],
                f"joint {name!r} does not follow {joint.params['mimic'].value!r}: "
                '<param name="mimic"> is read by Humble only, expected <mimic> in the URDF',
                severity=Severity.WARNING,
            )
    elif says != "false":
        if joint.commands:
            yield finding(
                joint.commands[0],
                f"{_STOPS}: joint {name!r} mimics {leader.value!r}, but has the command interface "
                f"{joint.commands[0].name.value!r}",
                related=[(leader, "the joint that it mimics")],
            )
        elif leader.value not in hardware.joints_by_name:
            yield finding(
                joint,
                f"{_STOPS}: joint {name!r} mimics {leader.value!r}, which is not in <ros2_control> "
                f"{hardware.name.value!r}",
                related=[(leader, "the joint that it mimics")],
            )


_COMMAND = '<command_interface name="position"/>'
_LEADER = f'<joint name="shoulder">{_COMMAND}<state_interface name="position"/></joint>'


def _hand(finger: str, leader: str = _LEADER, mimic: str = '<mimic joint="shoulder"/>') -> object:
    return {
        "@urdf": f"""
<link name="finger"/>
<joint name="finger_joint" type="revolute">
  <parent link="upper_arm"/>
  <child link="finger"/>
  <limit lower="-1" upper="1" effort="10" velocity="1"/>
  {mimic}
</joint>
<ros2_control name="arm" type="system">
  <hardware><plugin>mock_components/GenericSystem</plugin></hardware>
  {leader}
  <joint name="finger_joint"{finger}
    <state_interface name="position"/>
  </joint>
</ros2_control>
"""
    }


_MARK = "  <!-- ^ R2C002 -->"
_PARAM = f'><param name="mimic">shoulder</param>{_MARK}'
GOOD = [_hand(">"), _hand(f' mimic="false">{_COMMAND}'), _hand(">" + _COMMAND, mimic="")]
BAD = [
    _hand(f">{_COMMAND}{_MARK}"),
    _hand(f">{_MARK}", leader=""),
    _hand(f' mimic="true">{_MARK}', mimic=""),
    _hand(_PARAM, mimic=""),
]
