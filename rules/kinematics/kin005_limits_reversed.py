"""A joint whose lower limit is above its upper limit.

No position satisfies both limits: physics engines refuse the joint, jam it, or throw it from one
limit to the other. No accepted package that we checked has this fault.

Fix: swap the two limits; angles are in radians.
Source: SDFormat specification, axis/limit; URDF, joint/limit.
"""

from checker.base.resources import table
from checker.formats.corrections import rewrite
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("KIN005", "limits-reversed", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report axes with a lower limit above the upper one."""
    types = table("joint_types")["types"][robot.conventions.joint_types]
    for joint in robot.joints:
        if not types.get(joint.type.value.lower(), {"limits": True})["limits"]:
            continue
        for axis in joint.axes:
            lower, upper = axis.lower, axis.upper
            if lower.value > upper.value:
                yield finding(
                    lower if lower.stated else upper,
                    f"joint {joint.name.value!r} has the lower limit {lower.value:g} "
                    f"above its upper limit {upper.value:g}",
                    fix=rewrite([(lower, upper.value), (upper, lower.value)]),
                )


def _hinge(limits: str, kind: str = "revolute") -> str:
    return f"""
<link name="lid"/>
<joint name="hinge" type="{kind}">
  <parent>base_link</parent>
  <child>lid</child>
  <axis><xyz>0 0 1</xyz><limit>{limits}</limit></axis>
</joint>
"""


GOOD = [
    _hinge("<lower>-1</lower><upper>1</upper>"),
    _hinge("<lower>-1e16</lower><upper>1e16</upper>"),
    _hinge("<lower>0</lower>"),
    _hinge("<lower>1</lower><upper>-1</upper>", "fixed"),
]
BAD = [
    _hinge("<lower>0.5</lower>  <!-- ^ KIN005 -->\n<upper>-0.5</upper>"),
    _hinge("<lower>1e16</lower>  <!-- ^ KIN005 -->\n<upper>-1e16</upper>", "prismatic"),
]
