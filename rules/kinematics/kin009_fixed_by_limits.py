"""A joint whose two limits are equal: a fixed joint is meant.

The physics engine holds it in place by force in every step, which costs time and gives way under
load; a fixed joint costs nothing.

Fix: write `type="fixed"` and remove the axis; Ignition keeps the link, its sensors and its frame.
Source: SDFormat specification, joint/type.
"""

import math

from checker.model.robot import Robot
from checker.rule import Findings, Severity, finding, rule


@rule("KIN009", "fixed-by-limits", Severity.INFO)
def check(robot: Robot) -> Findings:
    """Report revolute and prismatic joints whose stated limits are equal."""
    for joint in robot.joints:
        if joint.type.value not in ("revolute", "prismatic") or len(joint.axes) != 1:
            continue
        lower, upper = joint.axes[0].lower, joint.axes[0].upper
        stated = lower.stated and upper.stated and math.isfinite(lower.value)
        if stated and lower.value == upper.value:
            yield finding(
                joint,
                f"{joint.type.value} joint {joint.name.value!r} cannot move: both limits are "
                f"{lower.value:g}",
                key="equal limits",
            )


def _hinge(limits: str, mark: str = "", kind: str = "revolute") -> str:
    return f"""
<link name="mast"/>
<joint name="mast_joint" type="{kind}">{mark}
  <parent>base_link</parent>
  <child>mast</child>
  <axis><xyz>0 0 1</xyz><limit>{limits}</limit></axis>
</joint>
"""


_MARK = "  <!-- ^ KIN009 -->"
GOOD = [
    _hinge("<lower>-0.1</lower><upper>0.1</upper>"),
    _hinge("<lower>0</lower><upper>0</upper>", kind="fixed"),
    _hinge(""),
]
BAD = [
    _hinge("<lower>0</lower><upper>0</upper>", _MARK),
    _hinge("<lower>0.2</lower><upper>0.2</upper>", _MARK, "prismatic"),
]
