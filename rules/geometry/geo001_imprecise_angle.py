"""An angle that means a multiple of π/2 and is not written to 16 digits.

A wheel's cylinder that is turned by 1.5708 instead of π/2 stands askew by microradians. The
contact solver feels it: the robot creeps sideways and its wheels never come to rest. Elsewhere in
a model the same digits are only untidy.

Fix: write 1.5707963267948966 or 3.1415926535897932.
Source: Model Migration Guide, step 3: "ensure that the orientations of the wheel collisions use
high precision numbers".
"""

import math
from collections.abc import Iterator

from checker.model.components import Pose
from checker.model.robot import Robot
from checker.rule import Finding, Findings, Severity, finding, replace_text, rule
from checker.source.text import Located

HALF_PI = math.pi / 2


@rule("GEO001", "imprecise-angle", Severity.INFO)
def check(
    robot: Robot,
    *,
    tolerance: float = 1e-3,
    harmless: float = 1e-6,
    typos: tuple[str, ...] = ("3.14", "3.1459"),
) -> Findings:
    """Report angles near a multiple of π/2: an error in a wheel's collision, else information."""
    wheels = {link.scoped_name for link in robot.wheels}
    for link in robot.links:
        for shape in link.collisions:
            on_wheel = link.scoped_name in wheels
            yield from _angles(shape.pose, tolerance, harmless, typos, on_wheel)
        others = [link.pose, *(visual.pose for visual in link.visuals)]
        others += [sensor.pose for sensor in link.sensors]
        if link.inertial is not None:
            others.append(link.inertial.pose)
        for pose in others:
            yield from _angles(pose, tolerance, harmless, typos, False)
    for joint in robot.joints:
        yield from _angles(joint.pose, tolerance, harmless, typos, False)


def _angles(
    pose: Pose, tolerance: float, harmless: float, typos: tuple[str, ...], on_wheel: bool
) -> Iterator[Finding]:
    for angle in pose.numbers[3:6]:
        quarters = round(angle.value / HALF_PI)
        exact = quarters * HALF_PI
        off = abs(angle.value - exact)
        typo = angle.stated and angle.span.text.lstrip("+-") in typos
        if quarters == 0 or off <= 1e-15 * abs(quarters) or not (off < tolerance or typo):
            continue
        grave = on_wheel and off > harmless
        yield _finding(angle, exact, quarters, off, grave)


def _finding(
    angle: Located[float], exact: float, quarters: int, off: float, grave: bool
) -> Finding:
    meant = {1: "π/2", 2: "π"}.get(abs(quarters), f"{abs(quarters)}·π/2")
    where = "angle of a wheel's collision" if grave else "angle"
    return finding(
        angle,
        f"{where} is {angle.span.text}, off {'-' if quarters < 0 else ''}{meant} by {off:.1e} rad",
        severity=Severity.ERROR if grave else Severity.INFO,
        key="wheel" if grave else "elsewhere",
        fix=replace_text(angle, f"{exact:.16f}"),
    )


GOOD = [
    """
<link name="wheel">
  <collision name="c"><pose>0 0 0 1.5707963267948966 0 0</pose></collision>
  <collision name="d"><pose>0 0 0 0.3 0 3.1415926535897932</pose></collision>
</link>
""",
]
BAD = [
    """
<link name="front_left_wheel">
  <collision name="c">
    <pose>0 0 0 1.57079 0 0</pose>  <!-- ^ GEO001 -->
  </collision>
</link>
""",
    """
<link name="lid">
  <pose>0 0 0.1 0 0 3.14</pose>  <!-- ^ GEO001 -->
</link>
""",
]
