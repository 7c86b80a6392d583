"""The limits of the drive differ from those of specifications.md.

Teams plan with specifications.md. The drive must reach the velocities and accelerations that
specifications.md states, no more and no less. It drives as the model says, so this is a warning. No
accepted package that we checked has this fault.

Fix: correct specifications.md, or the limits of the drive plugin. If specifications.md gives
different figures for the two directions and the plugin has one parameter for both, any figure
between them is right.
Source: SubT maintainers compare specifications.md and plugin in their reviews.
"""

from collections.abc import Iterator

from checker.model.locomotion.motion_limits import (
    BoundedMotion,
    Ends,
    bounded_motions,
    is_unlimited,
)
from checker.model.robot import Robot
from checker.model.specification.motion import Limit, MotionQuantity
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_EXACT = 1e-6
"""Relative difference from which two figures count as different."""


@rule("DRV004", "limits-differ-from-sheet", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot, specification: Specification, *, tolerance: float = 0.02, about: float = 0.1
) -> Findings:
    """Compare each limit of specifications.md with the drive's.

    Options:
        tolerance: Share of the figure in specifications.md by which a limit of the drive may
            differ; more is reported.
        about: Share used instead of `tolerance` if specifications.md says "about", "~" or the like.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for motion in bounded_motions(robot.locomotion):
        # One figure for speed and turn rate cannot fit two of the sheet: it is the speed.
        for quantity, unit, ends in () if motion.both_kinds else motion.quantities:
            claim = _claim(specification, motion, quantity)
            if claim is None or claim.maximum <= 0:
                continue
            allowed = about if claim.approximate else tolerance
            yield from _differing_limits(motion, quantity, unit, ends, claim, allowed)


def _claim(sheet: Specification, motion: BoundedMotion, quantity: str) -> Limit | None:
    named = MotionQuantity[f"{motion.kind}_{quantity}".upper()]
    claim = sheet.limit(named, motion.axis)
    if claim is not None and not claim.axes and motion.kind == "angular" and motion.axis != "z":
        # A turn rate without an axis is the one about the vertical.
        return None
    return claim


def _differing_limits(
    motion: BoundedMotion, quantity: str, unit: str, ends: Ends, claim: Limit, tolerance: float
) -> Iterator[Finding]:
    low, high = ends
    if high is None or is_unlimited(high) or (low is not None and is_unlimited(low)):
        return
    least = -high.value if low is None else low.value
    if _fits(least, high.value, claim, tolerance):
        return
    minimum = claim.minimum if _both_ways(claim) else None
    says = f"{claim.maximum:g}" if minimum is None else f"{minimum:g} to {claim.maximum:g}"
    yield finding(
        claim,
        f"the {motion.axis} {motion.kind} {quantity} of {motion.plugin.class_name} is between "
        f"{least:g} and {high.value:g} {unit}, but specifications.md says {says} {unit}",
        related=[(high, "the limit of the model")],
    )


def _fits(least: float, most: float, claim: Limit, tolerance: float) -> bool:
    """Return whether the model's limits are those of the sheet; symmetric ones may be between."""
    forward = claim.maximum
    back = -claim.minimum if claim.minimum is not None and _both_ways(claim) else forward
    if abs(least + most) <= _EXACT * abs(most):
        slow, fast = sorted((forward, back))
        return slow * (1 - tolerance) - _EXACT <= most <= fast * (1 + tolerance) + _EXACT
    return all(
        abs(actual - stated) <= tolerance * stated + _EXACT
        for actual, stated in ((most, forward), (-least, back))
    )


def _both_ways(claim: Limit) -> bool:
    return claim.minimum is not None and claim.minimum < 0


def _sheet(*lines: str) -> str:
    items = "".join(f"* {line}\n" for line in lines)
    return f"# Rover\n\n## Motion Characteristics\n\n{items}"


def _drive(velocity: str, acceleration: str = "-3 3") -> str:
    low, high = velocity.split()
    down, up = acceleration.split()
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <min_velocity>{low}</min_velocity><max_velocity>{high}</max_velocity>
  <min_acceleration>{down}</min_acceleration><max_acceleration>{up}</max_acceleration>
</plugin>
"""


_COPTER = """
<plugin filename="libp.so" name="ignition::gazebo::systems::MulticopterVelocityControl">
  <maximumLinearVelocity>6.5 5 3</maximumLinearVelocity>
  <maximumAngularVelocity>3 3 1.2</maximumAngularVelocity>
</plugin>
"""
_MARK = " <!-- ^ DRV004 -->"

GOOD = [
    {
        "@fragment": _drive("-1 1"),
        "specifications.md": _sheet(
            "_x_ velocity range from -1.0 m/s to 1.0 m/s",
            "_x_ acceleration range from -3.0 m/s^2 to 3.0 m/s^2",
            "_z_ turn rate range from -2 rad/s to 2 rad/s",
        ),
    },
    {
        "@fragment": _drive("-1 1", "-4 4"),
        "specifications.md": _sheet(
            "_x_ acceleration range from -3.6 m/s^2 to 6.6 m/s^2 (modeled as +-4 m/s^2)"
        ),
    },
    {
        "@fragment": _COPTER,
        "specifications.md": _sheet(
            "_x_ velocity range from -5.5 m/s to 7.6 m/s",
            "Maximum turn rate of 1.2 rad/s",
        ),
    },
]
BAD = [
    {
        "@fragment": _drive("-1 2"),
        "specifications.md": _sheet(f"_x_ velocity range from -1.5 m/s to 1.5 m/s{_MARK}"),
    },
    {
        "@fragment": _drive("-1 1"),
        "specifications.md": _sheet(
            "Maximum velocity is 1.0 m/s", f"Maximum acceleration is 2 m/s^2{_MARK}"
        ),
    },
    {
        "@fragment": _COPTER,
        "specifications.md": _sheet(
            f"_y_ velocity range from -6 m/s to 6 m/s{_MARK}",
            f"_z_ angular velocity range from -3 rad/s to 3 rad/s{_MARK}",
        ),
    },
]
