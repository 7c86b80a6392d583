"""Motors whose torque is limited by the numbers of the joint's range.

The command of a `<motor>` is a torque in N·m, or a force. With the range of the joint as its
`ctrlrange`, in radians, the motor gives a torque of 1.57 N·m at most, whatever it has to carry.

Fix: state the greatest torque of the motor as `ctrlrange`, or use `<position>`.
Source: XMLreference, actuator/motor; a humanoid whose author mended all 19 motors.
"""

from checker.physics.compiled.model import Actuator, CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_NEAR = 0.02
_FEWEST = 2


@rule("MJC011", "torque-range-is-angle", Severity.ERROR, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report motors that command a torque within the range of their joint."""
    found = [actuator for actuator in model.compiled.actuators if _is_angle(model, actuator)]
    for actuator in found if len(found) >= _FEWEST else ():
        joint = model.compiled.joints[actuator.joint]
        low, high = actuator.ctrl_range
        yield finding(
            model.span(actuator.line),
            f"torque of motor {actuator.name!r} is limited to {low:g} to {high:g} N·m, the range "
            f"of joint {joint.name!r} in radians: state its greatest torque, or use <position>",
            key="torques",
        )


def _is_angle(model: CompiledModel, actuator: Actuator) -> bool:
    """Return whether a plain motor has the range of its hinge, which no round number is."""
    is_motor = actuator.plain and actuator.stiffness == 0 and actuator.damping == 0
    if not is_motor or actuator.joint < 0 or not actuator.ctrl_limited:
        return False
    joint = model.compiled.joints[actuator.joint]
    if joint.type != "hinge" or not joint.limited or (actuator.gain, actuator.gear) != (1, 1):
        return False
    return all(
        abs(torque - angle) <= _NEAR * abs(angle)
        for torque, angle in zip(actuator.ctrl_range, joint.range, strict=True)
    )


def _arm(control: str, marks: tuple[str, str] = ("", "")) -> dict[str, str]:
    first, second = marks
    return {
        "@mjcf": f"""<compiler angle="radian"/>
<worldbody><body><joint name="pan" range="-1.5 1.5"/><geom size="0.1"/>
<body><joint name="tilt" range="-1.5 1.5"/><geom size="0.1"/></body></body></worldbody>
<actuator>
<motor joint="pan" ctrlrange="{control}"/>{first}
<motor joint="tilt" ctrlrange="{control}"/>{second}
</actuator>"""
    }


_MARK = "<!-- ^ MJC011 -->"
GOOD = [_arm("-20 20")]
BAD = [_arm("-1.5 1.5", (_MARK, _MARK))]
