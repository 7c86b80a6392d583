"""Frames that parts and axes of a robot name and that do not exist.

Links, joints and frames hang in the frame graph, which finds those itself.
"""

from __future__ import annotations

from collections.abc import Iterator

from checker.model.components import Link, Part, Pose
from checker.model.faults import Fault, FaultKind
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
