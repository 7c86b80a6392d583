"""A continuous joint with limits of its angle, which are ignored.

Readers of URDF ignore `lower` and `upper` of a continuous joint: in simulators and planners it
turns without an end. Limits of a whole turn and more are harmless, and so are two zeros; none is
reported.

Fix: write `type="revolute"` if the joint has an end, else remove `lower` and `upper`.
Source: URDF specification, joint: a continuous joint has no limits; what libsdformat 12 makes of
such a joint.
"""

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.ignored_limits import ignored_limits
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD029", "limits-of-continuous-joint", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report limits of less than a turn."""
    for joint in description.robot.joints:
        limits = ignored_limits(joint)
        if limits is not None:
            lower, upper = limits
            yield finding(
                joint.element.child("limit") or joint,
                f"continuous joint {joint.name.value!r} ignores its limits {lower:g} and {upper:g} "
                'rad: write type="revolute", or remove the limits',
                key="limits of a continuous joint",
            )


def _wheel(kind: str, limits: str, mark: str = "") -> dict[str, str]:
    return {
        "@urdf": f"""<link name="hand"/>
<joint name="wrist" type="{kind}"><parent link="upper_arm"/><child link="hand"/>
<axis xyz="0 0 1"/>
<limit {limits} effort="1" velocity="1"/>{mark}
</joint>"""
    }


GOOD = [
    _wheel("continuous", 'lower="0" upper="0"'),
    _wheel("continuous", 'lower="-6.28" upper="6.28"'),
    _wheel("continuous", ""),
    _wheel("revolute", 'lower="-1" upper="1"'),
]
BAD = [_wheel("continuous", 'lower="-1.57" upper="1.57"', "  <!-- ^ URD029 -->")]
