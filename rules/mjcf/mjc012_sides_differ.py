"""A left part that is not the mirror image of the right one.

In a model whose left and right bodies lie at mirrored places, the ranges, damping, armature, masses
and actuators of twins are compared; joints that an equality holds are left out. A
mirrored hinge keeps its range if its axis is mirrored as an axis of rotation is, and else has it
negated and exchanged; a slide keeps it if its axis is mirrored. What differs is often a sign, a
power of ten or a class that was copied to one side only: the robot reaches further on one side, or
leans.

Fix: correct the side that is wrong.
Source: six public models whose authors mended such faults.
"""

import math
from collections.abc import Iterator

from checker.physics.compiled.model import Compiled, CompiledModel, Joint
from checker.physics.compiled.twins import Twins, joint_pairs, twins_of
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_RANGE = 0.1
_SHARE = 0.02
_ALONG = 0.99


@rule("MJC012", "sides-differ", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, angle: float = _RANGE) -> Findings:
    """Report twin joints and bodies whose ranges, dynamics or masses do not mirror.

    Options:
        angle: Radians, or metres, by which the bounds of twins may differ.
    """
    twins = twins_of(model.compiled)
    if twins is None:
        return
    for pair in joint_pairs(model.compiled, twins):
        left, right = (model.compiled.joints[number] for number in pair)
        if not {*pair}.isdisjoint(model.compiled.held) or _may_differ(model.compiled, left, right):
            continue
        yield from _actuators(model, pair)
        expected = _mirrored_range(left, right, twins.axis)
        if expected is None:
            continue
        off = max(abs(one - other) for one, other in zip(expected, right.range, strict=True))
        if left.limited and right.limited and off > angle:
            yield _ranges(model, left, right, expected)
        yield from _dynamics(model, left, right)
    if not model.compiled.lacks_meshes:
        yield from _masses(model, twins, {it.body for it in model.compiled.joints})


def _may_differ(compiled: Compiled, left: Joint, right: Joint) -> bool:
    """Return whether two joints are fingers of one gripper: slides of one parent."""
    parents = [compiled.bodies[joint.body].parent for joint in (left, right)]
    return left.type != right.type or (left.type == "slide" and parents[0] == parents[1])


def _mirrored_range(left: Joint, right: Joint, axis: int) -> tuple[float, float] | None:
    """Return the range of the right joint that mirrors the left one; None if axes differ."""
    sign = -1 if left.type == "hinge" else 1
    image = [sign * (-it if at == axis else it) for at, it in enumerate(left.axis)]
    along = sum(one * other for one, other in zip(image, right.axis, strict=True))
    if left.type not in ("hinge", "slide") or abs(along) < _ALONG:
        return None
    low, high = left.range
    return (low, high) if along > 0 else (0.0 - high, 0.0 - low)


def _ranges(
    model: CompiledModel, left: Joint, right: Joint, expected: tuple[float, float]
) -> Finding:
    return finding(
        model.span(right.line),
        f"range of joint {right.name!r} is {_shown(right, right.range)}, but its twin "
        f"{left.name!r} mirrored would give {_shown(right, expected)}",
        related=[(model.span(left.line), "its twin")],
    )


def _dynamics(model: CompiledModel, left: Joint, right: Joint) -> Findings:
    for what, one, other in _unequal(
        ("damping", left.damping, right.damping),
        ("armature", left.armature, right.armature),
        ("stiffness", left.stiffness, right.stiffness),
    ):
        yield finding(
            model.span(right.line),
            f"{what} of joint {right.name!r} is {other}, that of its twin {left.name!r} {one}",
            related=[(model.span(left.line), "its twin")],
        )
    if left.limited is not right.limited:
        free, bound = (right, left) if left.limited else (left, right)
        yield finding(
            model.span(free.line),
            f"joint {free.name!r} has no limits, but its twin {bound.name!r} has",
            related=[(model.span(bound.line), "its twin")],
        )


def _unequal(*pairs: tuple[str, float, float]) -> Iterator[tuple[str, str, str]]:
    """Yield names and texts of the pairs of values that are not negative and differ."""
    for what, one, other in pairs:
        if abs(one - other) > _SHARE * max(one, other):
            yield what, f"{one:.4g}", f"{other:.4g}"


def _actuators(model: CompiledModel, pair: tuple[int, int]) -> Findings:
    """Report the only actuators of two joints if one is stronger than the other."""
    compiled = model.compiled
    left, right = (compiled.joints[number] for number in pair)
    of_joints = [[it for it in compiled.actuators if it.joint == number] for number in pair]
    if [len(actuators) for actuators in of_joints] != [1, 1]:
        return
    one, other = of_joints[0][0], of_joints[1][0]
    for what, first, second in _unequal(
        ("gear", abs(one.gear), abs(other.gear)),
        ("gain", abs(one.gain), abs(other.gain)),
        ("force range", max(map(abs, one.force_range)), max(map(abs, other.force_range))),
    ):
        yield finding(
            model.span(other.line),
            f"{what} of the actuator of joint {right.name!r} is {second}, that of its twin "
            f"{left.name!r} {first}",
            related=[(model.span(one.line), "its twin")],
        )


def _shown(joint: Joint, bounds: tuple[float, float]) -> str:
    if joint.type == "slide":
        return f"{bounds[0]:.3g} to {bounds[1]:.3g} m"
    return f"{math.degrees(bounds[0]):.4g}° to {math.degrees(bounds[1]):.4g}°"


def _masses(model: CompiledModel, twins: Twins, jointed: set[int]) -> Findings:
    for left, right in twins.bodies:
        one, other = model.compiled.bodies[left], model.compiled.bodies[right]
        if not {left, right} <= jointed or abs(one.mass - other.mass) <= _SHARE * one.mass:
            continue
        yield finding(
            model.span(other.line),
            f"body {other.name!r} has {other.mass:.4g} kg, its twin {one.name!r} {one.mass:.4g} kg",
            related=[(model.span(one.line), "its twin")],
        )


def _walker(bounds: str, mark: str = "") -> dict[str, str]:
    def leg(side: str, y: float, bounds: str, mark: str) -> str:
        return (
            f'<body name="{side}_leg" pos="0 {y} 0"><joint name="{side}_hip" axis="1 0 0" '
            f'range="{bounds}"/>{mark}\n<geom size="0.1"/><body name="{side}_foot" pos="0 0 -1">'
            f'<joint name="{side}_ankle" axis="0 1 0" range="-20 20"/><geom size="0.1"/></body>'
            "</body>\n"
        )

    legs = leg("left", 0.2, "-10 40", "") + leg("right", -0.2, bounds, mark)
    torso = f'<body name="torso"><freejoint/><geom size="0.2"/>{legs}</body>'
    return {"@mjcf": f"<worldbody>{torso}</worldbody>"}


GOOD = [_walker("-40 10")]
BAD = [_walker("-10 40", "<!-- ^ MJC012 -->")]
