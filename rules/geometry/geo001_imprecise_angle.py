"""An angle close to a multiple of π/2 that is not written with 16 digits.

A wheel's cylinder that is turned by 1.5708 instead of π/2 is tilted by microradians. The robot
drives anyway, so this is not an error. But the SubT checklist requires exact wheels, since a solver
may let tilted ones creep: under the profile `subt` it is a warning. Elsewhere in a model, and for
other targets, it is an info; for Gazebo from Fortress on, less than a microradian is not reported.
Where the angle of a part that is not a wheel changes by more than the rounding of four decimals, as
for 3.14, the part moves: the fix is unsafe.

Fix: write 1.5707963267948966 or 3.1415926535897932.
Source: Model Migration Guide, step 3: "ensure that the orientations of the wheel collisions use
high precision numbers".
"""

import math
from collections.abc import Iterator
from decimal import Decimal

from checker.model.components import Pose
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Located

HALF_PI = math.pi / 2
EXACT_HALF_PI = Decimal("1.57079632679489661923")
"""To more digits than a float has, so that a multiple of it is right in every digit written."""
_ROUNDED = 2e-5
"""Radians that readers with six digits do not see; 1.5708 and 3.1416 are closer."""
_MOST_DIGITS = 17
"""Digits behind the point that distinguish one float near π from the next."""


@rule("GEO001", "imprecise-angle", Severity.INFO, Concern.ROBOT)
def check(
    robot: Robot,
    context: Context,
    *,
    tolerance: float = 1e-3,
    harmless: float = 1e-6,
    typos: tuple[str, ...] = ("3.14", "3.1459"),
    digits: int = 16,
) -> Findings:
    """Report angles near a multiple of π/2: of wheels' collisions, and others.

    Angles in degrees are skipped: in degrees a quarter turn is exact.

    Options:
        tolerance: Radians; an angle closer than this to a multiple of π/2 other than 0, but not
            equal to it, is reported.
        harmless: Radians by which an angle of a wheel's collision may differ before it is a warning
            instead of an info.
        typos: Texts, without sign, that mean the nearest multiple of π/2, whatever the difference.
        digits: Digits after the decimal point of the angle that the fix writes, at most 17.
    """
    severity = Severity.WARNING if context.profile == "subt" else Severity.INFO
    decimals = min(digits, _MOST_DIGITS)
    wheels = {link.scoped_name for link in robot.wheels}
    for pose, link in robot.poses():
        for angle, quarters, off in _quarter_turns(pose, tolerance, typos):
            if off <= harmless and context.is_gazebo_sim:
                continue
            of_wheel = link in wheels and off > harmless
            meant = {1: "π/2", 2: "π"}.get(abs(quarters), f"{abs(quarters)}·π/2")
            safe = off <= (tolerance if of_wheel else _ROUNDED)
            kind = "wheel" if of_wheel else "elsewhere"
            where = "angle of a wheel's collision" if of_wheel else "angle"
            yield finding(
                angle,
                f"{where} is {angle.span.text}, which differs from "
                f"{'-' if quarters < 0 else ''}{meant} by {off:.1e} rad",
                severity=severity if of_wheel else Severity.INFO,
                key=kind if safe else f"{kind} by more",
                fix=replace_text(
                    angle,
                    f"{quarters * EXACT_HALF_PI:.{decimals}f}",
                    Safety.SAFE if safe else Safety.UNSAFE,
                ),
            )


def _quarter_turns(
    pose: Pose, tolerance: float, typos: tuple[str, ...]
) -> Iterator[tuple[Located[float], int, float]]:
    """Yield angles that mean quarter turns: how many of them, and the difference."""
    for angle in pose.numbers[3:6] if pose.in_radians else ():
        quarters = round(angle.value / HALF_PI)
        off = abs(angle.value - quarters * HALF_PI)
        typo = angle.stated and angle.span.text.lstrip("+-") in typos
        if quarters and off > 1e-15 * abs(quarters) and (off < tolerance or typo):
            yield angle, quarters, off


GOOD = [
    """
<link name="wheel">
  <collision name="c"><pose>0 0 0 1.5707963267948966 0 0</pose></collision>
  <collision name="d"><pose>0 0 0 0.3 0 3.1415926535897932</pose></collision>
</link>
""",
    """
<link name="base_link"><pose degrees="true">0 0 0.1 0 0 355</pose></link>
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
