"""Soft limits of a safety controller that are outside the limits of the joint.

Between the soft limit and the limit a controller slows the joint down, so that it never hits the
stop. A soft limit beyond the stop never acts, and the joint hits it at full speed; usually one of
the two was changed and the other forgotten. Soft limits that are reversed allow no position at all.

Fix: put `soft_lower_limit` and `soft_upper_limit` a little inside `lower` and `upper`.
Source: URDF, joint/safety_controller; ROS wiki, pr2_controller_manager/safety_limits.
"""

from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.model.components import Axis, Joint
from checker.model.values import ValueReader
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml import Element


@rule("URD017", "soft-limit-outside-limit", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription, *, tolerance: float = 1e-6) -> Findings:
    """Compare the soft limits of each joint with its limits.

    Options:
        tolerance: Radians or metres by which a soft limit may exceed the limit.
    """
    for joint in description.robot.joints:
        soft = joint.element.child("safety_controller")
        if soft is None:
            continue
        lower, upper = (
            _stated_limit(soft, "soft_lower_limit"),
            _stated_limit(soft, "soft_upper_limit"),
        )
        for axis in joint.axes[:1]:
            yield from _outside(joint, axis, lower, upper, tolerance)
        if lower is not None and upper is not None and lower.value > upper.value:
            yield finding(
                lower,
                f"joint {joint.name.value!r} has the soft limits {lower.value:g} to "
                f"{upper.value:g}, which are reversed",
            )


def _outside(
    joint: Joint,
    axis: Axis,
    lower: Located[float] | None,
    upper: Located[float] | None,
    tolerance: float,
) -> Iterator[Finding]:
    name = joint.name.value
    if lower is not None and lower.value < axis.lower.value - tolerance:
        yield finding(
            lower,
            f"joint {name!r} has the soft lower limit {lower.value:g}, below its limit "
            f"{axis.lower.value:g}",
            related=[(axis.lower, "the limit")],
        )
    if upper is not None and upper.value > axis.upper.value + tolerance:
        yield finding(
            upper,
            f"joint {name!r} has the soft upper limit {upper.value:g}, above its limit "
            f"{axis.upper.value:g}",
            related=[(axis.upper, "the limit")],
        )


def _stated_limit(soft: Element, name: str) -> Located[float] | None:
    number = ValueReader().attribute_numbers(soft, name, (0.0,))[0]
    return number if number.stated else None


def _robot(soft: str, mark: str = "") -> dict[str, object]:
    text = f"""<robot name="arm">
<link name="base_link"/>
<link name="hand"/>
<joint name="hand_joint" type="revolute">
  <parent link="base_link"/><child link="hand"/>
  <limit lower="-1" upper="1" effort="10" velocity="1"/>
  <safety_controller k_velocity="10" {soft}/>{mark}
</joint>
</robot>
"""
    return {"@urdf": True, "urdf/arm.urdf": text}


_MARK = "  <!-- ^ URD017 -->"
GOOD = [
    _robot('soft_lower_limit="-0.9" soft_upper_limit="0.9"'),
    _robot(""),
]
BAD = [
    _robot('soft_lower_limit="-1.1" soft_upper_limit="0.9"', _MARK),
    _robot('soft_upper_limit="1.1"', _MARK),
    _robot('soft_lower_limit="0.9" soft_upper_limit="-0.9"', _MARK),
]
