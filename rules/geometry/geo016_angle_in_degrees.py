"""An angle that looks like degrees, but is read as radians.

90 rad are more than 14 turns: the part is tilted, and a joint with limits of ±180 turns freely.

Fix: write the angle in radians (90° is 1.5707963267948966); in SDF 1.8 and later, a pose can state
`degrees="true"`.
Source: SDFormat and URDF specifications: angles are in radians; 30, 45, 60, 90 and 180 are not
plausible angles in radians.
"""

import math
from collections.abc import Iterator

from checker.formats.corrections import rewrite
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located


@rule("GEO016", "angle-in-degrees", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot, *, least: float = 30.0, most: float = 360.0, step: float = 15.0
) -> Findings:
    """Report angles of poses, and limits of revolute joints, that are whole degrees.

    Options:
        least: Degrees; a smaller angle is not reported.
        most: Degrees; a larger angle is not reported.
        step: Degrees, at least 1; angles that are not multiples of it are not reported.
    """

    def is_in_degrees(angle: float) -> bool:
        return least <= abs(angle) <= most and math.remainder(angle, max(step, 1.0)) == 0.0

    for pose, _ in robot.poses():
        for angle in pose.numbers[3:6] if pose.in_radians else ():
            if is_in_degrees(angle.value):
                yield _finding(angle, "the angle")
    for joint in robot.joints:
        limits = [*_limits(joint)]
        # Both ends, or one of them and zero: a single round number may be some turns of a winch.
        if limits and all(limit.value == 0.0 or is_in_degrees(limit.value) for limit in limits):
            for limit in limits:
                if limit.value:
                    yield _finding(limit, f"a limit of joint {joint.name.value!r}")


def _limits(joint: Joint) -> Iterator[Located[float]]:
    if joint.type.value == "revolute" and len(joint.axes) == 1:
        axis = joint.axes[0]
        if axis.lower.stated and axis.upper.stated and axis.lower.value < axis.upper.value:
            yield from (axis.lower, axis.upper)


def _finding(angle: Located[float], what: str) -> Finding:
    return finding(
        angle,
        f"{what} is {angle.value:g} rad, {abs(angle.value) / math.tau:.3g} turns: if degrees are "
        f"meant, write {math.radians(angle.value):.17g}",
        key="degrees",
        fix=rewrite([(angle, math.radians(angle.value))]),
    )


def _hinge(limits: str, mark: str = "") -> str:
    return f"""
<link name="arm"><pose>0 0 1 0 1.5707963267948966 0</pose></link>
<joint name="elbow" type="revolute">
  <parent>base_link</parent>
  <child>arm</child>
  <axis><xyz>0 1 0</xyz><limit>{limits}</limit></axis>{mark}
</joint>
"""


_MARK = "  <!-- ^ GEO016 -->"
GOOD = [
    _hinge("<lower>-3.14</lower><upper>3.14</upper>"),
    _hinge("<lower>-100</lower><upper>100</upper>"),
    _hinge("<lower>-1e16</lower><upper>1e16</upper>"),
    '<link name="mast"><pose degrees="true">0 0 1 0 0 90</pose></link>',
    '<link name="mast"><pose>0 0 90 0 0 6.2831853071795862</pose></link>',
]
BAD = [
    _hinge("<lower>-90</lower><upper>90</upper>", _MARK),
    _hinge("<lower>0</lower><upper>180</upper>", _MARK),
    f'<link name="mast"><pose>0 0 1 0 0 90</pose>{_MARK}</link>',
]
