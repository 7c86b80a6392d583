"""A joint that starts outside its limits.

The physics engine throws the joint back to the limit in the first step, and the robot jumps.
Without `<initial_position>` a joint starts at 0, so its limits must include 0: this is the pose
that the model file shows.

Fix: choose the zero of the joint so that it is within the limits: turn the child link's pose and
shift both limits by the same angle. Or correct the initial position.
Source: SDFormat specification, axis/initial_position and axis/limit.
"""

from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("KIN017", "starts-outside-limits", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, tolerance: float = 1e-6) -> Findings:
    """Report joints whose first position is outside their limits.

    For a URDF robot the start depends on the node that spawns it.

    Options:
        tolerance: Radians (sliding joints: metres) that the first position may be outside the
            limits; more is reported.
    """
    if not robot.conventions.states_start:
        return
    for joint in robot.joints:
        if joint.type.value not in ("revolute", "prismatic", "screw"):
            continue
        for axis in joint.axes:
            lower, upper, start = axis.lower, axis.upper, axis.initial_position
            if lower.value > upper.value:
                continue
            if lower.value - tolerance <= start.value <= upper.value + tolerance:
                continue
            crossed = lower if start.value < lower.value else upper
            yield finding(
                start if start.stated else crossed,
                f"joint {joint.name.value!r} starts at {start.value:g}, outside its limits "
                f"{lower.value:g} … {upper.value:g}",
                key=f"{start.value:g} of {lower.value:g} … {upper.value:g}",
            )


def _knee(lower: str, upper: str, start: str = "") -> str:
    return f"""
<link name="shank"/>
<joint name="knee" type="revolute">
  <parent>base_link</parent>
  <child>shank</child>
  <axis>
    <xyz>0 1 0</xyz>
    {start}
    <limit>
      <lower>{lower}
      <upper>{upper}
    </limit>
  </axis>
</joint>
"""


_MARK = "  <!-- ^ KIN017 -->"
GOOD = [
    _knee("-1</lower>", "1</upper>"),
    _knee("0</lower>", "1</upper>", "<initial_position>0.5</initial_position>"),
    _knee("0.5</lower>", "-0.5</upper>"),
]
BAD = [
    _knee("-2.8</lower>", f"-0.25</upper>{_MARK}"),
    _knee("-1</lower>", "1</upper>", f"<initial_position>2</initial_position>{_MARK}"),
]
