"""A joint axis without direction, or not of length 1.

A joint cannot turn about an axis of zeros: parsers refuse the model, or use another axis. Most
simulators normalise other lengths; in some they scale the motion. No accepted package that we
checked has this fault.

Fix: write a direction of length 1, such as `0 0 1`.
Source: SDFormat specification, axis/xyz: "The vector should be normalized"; URDF, joint/axis.
"""

import math
from collections.abc import Iterator

from checker.base.resources import table
from checker.formats.corrections import rewrite
from checker.model.components import Axis, Joint
from checker.model.robot import Robot
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule


@rule("KIN004", "invalid-joint-axis", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, context: Context, *, tolerance: float = 1e-3) -> Findings:
    """Report missing axes, axes of zeros, and axes that are not of length 1.

    Options:
        tolerance: Difference of the axis's length from 1, without unit; more is a warning.
    """
    types = table("joint_types")["types"][robot.conventions.joint_types]
    for joint in robot.joints:
        needed = types.get(joint.type.value.lower(), {"axes": 0})["axes"]
        if not needed:
            continue
        if not robot.conventions.has_default_axis and len(joint.axes) < needed:
            tag = "axis2" if joint.axes else "axis"
            yield finding(
                joint,
                f"{joint.type.value} joint {joint.name.value!r} has no <{tag}>",
                severity=None if context.release else Severity.WARNING,
                key=tag,
            )
        for axis in joint.axes[:needed]:
            yield from _judged(joint, axis, tolerance)


def _judged(joint: Joint, axis: Axis, tolerance: float) -> Iterator[Finding]:
    length = math.hypot(*(number.value for number in axis.xyz))
    what = f"the axis of joint {joint.name.value!r}"
    written = " ".join(f"{number.value:g}" for number in axis.xyz)
    if length == 0.0 or not math.isfinite(length):
        yield finding(axis.xyz[0], f"{what} is {written}, which has no direction")
    elif abs(length - 1.0) > tolerance:
        message = f"{what} is {written}, of length {length:.4g}, expected 1"
        unit = rewrite([(number, number.value / length) for number in axis.xyz])
        yield finding(axis.xyz[0], message, severity=Severity.WARNING, fix=unit)


def _hinge(axis: str, kind: str = "revolute") -> str:
    return f"""
<link name="lid"/>
<joint name="hinge" type="{kind}">
  <parent>base_link</parent>
  <child>lid</child>
  {axis}
</joint>
"""


GOOD = [
    _hinge("<axis><xyz>0 -1 0</xyz></axis>"),
    _hinge("<axis><xyz>0.7071 0 0.7071</xyz></axis>"),
    _hinge("", "fixed"),
    _hinge("<axis><xyz>0 0 0</xyz></axis>", "fixed"),
]
BAD = [
    _hinge("<axis><xyz>0 0 0</xyz></axis>  <!-- ^ KIN004 -->"),
    _hinge("<axis><xyz>0 2 0</xyz></axis>  <!-- ^ KIN004 -->"),
    """
<link name="lid"/>
<joint name="hinge" type="revolute">  <!-- ^ KIN004 -->
  <parent>base_link</parent>
  <child>lid</child>
</joint>
""",
]
