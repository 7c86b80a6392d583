"""Before SDF 1.7: poses in a nested model's frame become poses in the robot's."""

from __future__ import annotations

import math
from collections.abc import Sequence

from checker.formats.sdf.flattening.draft import Draft, Holder
from checker.formats.sdf.poses import in_degrees, transform_of
from checker.model.components import Joint
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.source.text import Located
from checker.source.xml import Element

# Poses and directions in other frames, written over the numbers that stand there.


_SAME = 1e-14
"""Numbers that differ by less differ only by rounding."""
_DIGITS = 15
"""Digits behind the point: metres and radians far below the precision of any solver."""


def write_pose(draft: Draft, holder: Element, pose: Transform) -> None:
    """Have the `<pose>` of an element state this one; what it states already stays as it is."""
    element = holder.child("pose")
    if element is None:
        if not pose.is_near(Transform(), _SAME):
            draft.insert(holder, f"<pose>{pose_text(pose)}</pose>")
        return
    read = None if in_degrees(element) else _numbers(element, 6)
    if read is None:
        draft.put(element.whole_span, f"<pose>{pose_text(pose)}</pose>")
        return
    stated = Transform(stated_pose(element).rotation)
    kept = Transform(pose.rotation).is_near(stated, _SAME)
    angles = tuple(number.value for number in read[3:]) if kept else pose.rpy
    _write_numbers(draft, read, (*pose.translation, *angles))


def stated_pose(element: Element) -> Transform:
    """Return what the numbers in a `<pose>` state; that of no change where there are not six."""
    read = _numbers(element, 6)
    if read is None:
        return Transform()
    return transform_of(element, (number.value for number in read))


def write_direction(draft: Draft, axis: Element, direction: Vector) -> None:
    """Have the `<xyz>` of an axis state this direction."""
    element = axis.child("xyz")
    read = _numbers(element, 3) if element is not None else None
    if read is not None:
        _write_numbers(draft, read, direction)
    elif element is not None:
        draft.put(element.whole_span, f"<xyz>{_text(direction)}</xyz>")
    else:
        draft.insert(axis, f"<xyz>{_text(direction)}</xyz>")


def pose_text(pose: Transform) -> str:
    """Return the six numbers of a pose."""
    return _text((*pose.translation, *pose.rpy))


def _numbers(element: Element, count: int) -> tuple[Located[float], ...] | None:
    """Return the numbers in an element; None if there are not as many as there should be."""
    reader = ValueReader()
    read = reader.numbers_in(element.text)
    return read if len(read) == count and not reader.faults else None


def _write_numbers(draft: Draft, read: Sequence[Located[float]], values: Sequence[float]) -> None:
    for number, value in zip(read, values, strict=True):
        if abs(number.value - value) > _SAME:
            draft.put(number.span, _number(value))


def _text(values: Sequence[float]) -> str:
    return " ".join(map(_number, values))


def _number(value: float) -> str:
    """Write a number; quarter turns to 16 digits, and no trace of rounding."""
    quarters = round(value / (math.pi / 2))
    if quarters and abs(value - quarters * (math.pi / 2)) < _SAME:
        return repr(quarters * (math.pi / 2))
    text = repr(round(value, _DIGITS) + 0.0)
    return text.removesuffix(".0")


_AXES = ("axis", "axis2")
_OF_FRAME = "frame"


def move_part(draft: Draft, part: Element, holder: Holder, robot: Robot) -> None:
    """Write the numbers of a link, joint or frame that depend on where they are written."""
    name = holder.scoped(part.get("name") or "")
    if part.tag == "joint":
        joint = robot.joints_by_name[name]
        own = robot.pose_of_joint(joint)
        child = robot.pose_of(holder.scoped(joint.child.value))
        _move_axes(draft, part, joint, holder, robot)
        stated = child.inverse @ own if _names_frame(part) and child and own else None
    else:
        own = stated = robot.pose_of(name)
    if stated is not None:
        _write(draft, part, stated)
    for inner in part.children:
        frame = _names_frame(inner)
        base = robot.pose_of(holder.scoped(frame)) if frame else None
        pose = inner.child("pose")
        if own is not None and base is not None and pose is not None:
            _write(draft, inner, own.inverse @ base @ stated_pose(pose))


def _write(draft: Draft, holder: Element, pose: Transform) -> None:
    element = holder.child("pose")
    if element is not None and _names_frame(holder):
        draft.take_attribute(element, _OF_FRAME)
    write_pose(draft, holder, pose)


def _names_frame(holder: Element) -> str:
    """Return the frame that the pose of an element names; usually none."""
    pose = holder.child("pose")
    return pose.get(_OF_FRAME) or "" if pose is not None else ""


def _move_axes(draft: Draft, part: Element, joint: Joint, holder: Holder, robot: Robot) -> None:
    """Turn the axes that are expressed in the model's frame; others are in the joint's own."""
    frame = robot.pose_of(holder.frame)
    elements = [child for child in part.children if child.tag in _AXES]
    for element, axis in zip(elements, joint.axes, strict=True):
        if frame is not None and axis.expressed_in == holder.frame:
            x, y, z = (number.value for number in axis.xyz)
            direction: Vector = frame.rotate((x, y, z))
            write_direction(draft, element, direction)
