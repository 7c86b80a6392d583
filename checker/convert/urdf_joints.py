"""Joints in URDF, where a joint turns about its child's origin and has one axis at most."""

from __future__ import annotations

import math
from collections.abc import Sequence

from lxml import etree

from checker.base.record import Record
from checker.convert.urdf_shapes import add_origin
from checker.convert.xml_writer import add, exact, numbers
from checker.model.components import UNLIMITED, Axis, Joint
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.tree import Tie
from checker.physics.mass.joint_motion import Freedom, Motion, motions_of

_NEAR = 1e-12
"""Metres between a joint and its child's origin that make no difference."""
_AXES: tuple[Vector, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_ENDLESS = (-math.inf, math.inf)


class Step(Record):
    """One joint of URDF.

    Attributes:
        kind: Its type.
        pose: Of its frame, and so of its child's, in the robot's frame.
        axis: In that frame; None for a fixed joint.
        limits: What the source says of the axis, if anything.
    """

    kind: str
    pose: Transform
    axis: Vector | None = None
    limits: Axis | None = None


def steps_of(robot: Robot, tie: Tie, child: Transform) -> Sequence[Step]:
    """Return the joints of URDF that let a link move as a tie does; the last one carries the link.

    Where a joint turns its child about a point that is not the child's origin, a frame without
    mass stands at that point, so that the child's own frame stays where it is.

    Args:
        robot: The tie's.
        tie: By which a link hangs.
        child: The link's pose in the robot's frame.
    """
    motions = motions_of(robot, tie.joint)
    if not motions:
        return [Step("fixed", child)]
    at = robot.pose_of_joint(tie.joint)
    place = child if at is None else Transform(child.rotation, at.translation)
    if _passes(motions, place, child):
        place = child
    steps = [step for motion in motions for step in _steps(tie.joint, motion, place)]
    return steps if place is child else [*steps, Step("fixed", child)]


def _passes(motions: Sequence[Motion], place: Transform, child: Transform) -> bool:
    """Say whether the joints may as well stand at the child's origin."""
    arm = tuple(a - b for a, b in zip(child.translation, place.translation, strict=True))
    if len(motions) > 1 or motions[0].freedom is Freedom.BALL:
        return math.hypot(*arm) <= _NEAR
    along = sum(a * b for a, b in zip(arm, motions[0].axis, strict=True))
    beside = [a - along * b for a, b in zip(arm, motions[0].axis, strict=True)]
    return motions[0].freedom is Freedom.SLIDE or math.hypot(*beside) <= _NEAR


def _steps(joint: Joint, motion: Motion, place: Transform) -> Sequence[Step]:
    if motion.freedom is Freedom.BALL:
        return [Step("continuous", place, axis) for axis in _AXES]
    limits = joint.axes[motion.number]
    axis = Transform(place.inverse.rotation).rotate(motion.axis)
    if motion.freedom is Freedom.SLIDE:
        return [Step("prismatic", place, axis, limits)]
    endless = (limits.lower.value, limits.upper.value) == _ENDLESS
    endless = endless or joint.type.value == "continuous"
    return [Step("continuous" if endless else "revolute", place, axis, limits)]


class Named(Record):
    """A joint of URDF and the links that it ties, by name."""

    name: str
    parent: str
    child: str


def add_joint(robot: etree._Element, named: Named, step: Step, base: Transform) -> None:
    """Add a joint.

    Args:
        robot: The element of the result.
        named: What to call it.
        step: What it does.
        base: The parent's pose in the source robot's frame.
    """
    joint = add(robot, "joint", name=named.name, type_=step.kind)
    add_origin(joint, base.inverse @ step.pose)
    add(joint, "parent", link=named.parent)
    add(joint, "child", link=named.child)
    if step.axis is None:
        return
    add(joint, "axis", xyz=numbers(step.axis))
    if step.limits is not None:
        _add_limits(joint, step.kind, step.limits)


def _add_limits(joint: etree._Element, kind: str, axis: Axis) -> None:
    said = {}
    if kind != "continuous":
        said = {"lower": _finite(axis.lower.value), "upper": _finite(axis.upper.value)}
    most = (axis.effort.value, axis.velocity.value)
    if said or any(map(math.isfinite, most)):
        # URDF wants both of every joint that states limits.
        said |= {"effort": _finite(most[0]), "velocity": _finite(most[1])}
        add(joint, "limit", **said)
    resistance = {"damping": axis.damping.value, "friction": axis.friction.value}
    if any(resistance.values()):
        add(joint, "dynamics", **{name: exact(value) for name, value in resistance.items()})


def _finite(value: float) -> str:
    return exact(math.copysign(UNLIMITED, value) if math.isinf(value) else value)
