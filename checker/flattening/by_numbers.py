"""Before SDF 1.7: what was written in a nested model's frame is written in the robot's."""

from __future__ import annotations

from checker.flattening.draft import Draft
from checker.flattening.holder import Holder
from checker.flattening.numbers import stated_pose, write_direction, write_pose
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.model.transform import Transform, Vector
from checker.source.xml import Element

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
    """Return the frame that the pose of an element names; mostly none."""
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
