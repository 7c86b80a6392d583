"""Frames that parts and axes of a robot name and that do not exist.

Links, joints and frames hang in the frame graph, which finds those itself.
"""

from __future__ import annotations

from collections.abc import Iterator

from checker.model.components import Link, Part, Pose
from checker.model.faults import Fault, FaultKind
from checker.model.frames import MODEL_FRAME
from checker.model.robot import Robot


def unknown_frames(robot: Robot) -> Iterator[Fault]:
    """Yield a fault for each part or axis whose frame does not exist."""
    known = robot.frame_graph.nodes
    for link in robot.links:
        for label, pose in _poses(link):
            if pose.relative_to and pose.relative_to not in known:
                message = f"{label} is posed relative to {pose.relative_to!r}"
                yield Fault(FaultKind.FRAME, pose.span, f"{message}, which does not exist")
    for joint in robot.joints:
        for axis in joint.axes:
            if axis.expressed_in and axis.expressed_in not in known:
                message = f"the axis of joint {joint.name.value!r} is expressed in"
                yield Fault(
                    FaultKind.FRAME,
                    axis.span,
                    f"{message} {axis.expressed_in!r}, which does not exist",
                )
    yield from _attachments(robot)


def _attachments(robot: Robot) -> Iterator[Fault]:
    """Yield a fault for each frame attached to nothing or, over others, to itself.

    A frame that states no other frame for its pose is posed in the one it is attached to: then
    the graph has found it.
    """
    frames = {frame.scoped_name: frame for frame in reversed(robot.frames)}
    attached = {
        name: name.removesuffix(frame.name.value) + frame.attached_to
        for name, frame in frames.items()
        if frame.attached_to not in ("", MODEL_FRAME)
    }
    known = robot.frame_graph.nodes
    for name, other in attached.items():
        if frames[name].pose.relative_to and other not in known:
            message = f"frame {name!r} is attached to {other!r}, which does not exist"
            yield Fault(FaultKind.FRAME, frames[name].span, message)
    done: set[str] = set()
    for name in attached:
        path: dict[str, None] = {}
        at = name
        while at in attached and at not in done and at not in path:
            path[at] = None
            at = attached[at]
        done.update(path)
        if at in path and any(frames[each].pose.relative_to for each in path):
            message = f"frame {at!r} is attached to itself through {attached[at]!r}"
            yield Fault(FaultKind.FRAME, frames[at].span, message)


def _poses(link: Link) -> Iterator[tuple[str, Pose]]:
    if link.inertial is not None:
        yield f"the inertial of link {link.name.value!r}", link.inertial.pose
    parts: tuple[tuple[Part, Pose], ...] = (
        *((part, part.pose) for part in link.collisions),
        *((part, part.pose) for part in link.visuals),
        *((part, part.pose) for part in link.sensors),
        *((part, part.pose) for part in link.lights),
    )
    for part, pose in parts:
        yield f"{part.element.tag} {part.name.value!r}", pose
