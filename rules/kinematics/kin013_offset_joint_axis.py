"""A joint axis far from the part that it moves, or a part far from its parent.

The part swings around its axis on an invisible arm, or floats in the air. Usually a pose has a
wrong decimal point or unit, or refers to an unintended frame. No accepted package that we checked
has this fault. Parts with a fixed joint that both touch a third part are not reported: the frames
of a stereo camera touch its housing.

Fix: correct the pose of the joint or of the child link, in metres.
Source: geometry; SDF gives a joint's pose in its child link, URDF in its parent.
"""

import math
from collections.abc import Iterable, Iterator

from checker.model.geometry.boxes import Box
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.model.tree import WORLD, Tie
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_HINGES = ("revolute", "continuous")


@rule("KIN013", "offset-joint-axis", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, sizes: float = 1.0, gap: float = 1.0, marker: float = 0.02) -> Findings:
    """Report parts far from their axis or parent.

    Meshes count as their convex hull; parts with an unreadable mesh are skipped.

    Options:
        sizes: Distance of a hinge's axis from the sphere around the box of the part's collisions,
            as a multiple of that box's diagonal; more is reported.
        gap: Distance between the boxes around a part and its parent, divided by the sum of their
            diagonals; more is reported.
        marker: Diagonal in metres of a box that only marks a frame, such as one of a stereo camera;
            the gap between two boxes that are no larger is not reported.
    """
    boxes = {name: robot.box_of(link) for name, link in robot.tree.links.items()}
    for tie in robot.tree.ties:
        if tie.parent in (WORLD, tie.child):
            continue
        child, parent = boxes[tie.child], boxes[tie.parent]
        if (
            child is not None
            and parent is not None
            and max(child.diagonal, parent.diagonal) > marker
            and child.gap(parent) > gap * (together := child.diagonal + parent.diagonal)
            and not (tie.joint.type.value == "fixed" and _share_part(child, parent, boxes.values()))
        ):
            yield finding(
                tie.joint,
                f"joint {tie.joint.name.value!r} connects {tie.child!r} to {tie.parent!r}, which "
                f"is {child.gap(parent):.3g} m away, {child.gap(parent) / together:.2g} times "
                f"their diagonals together, expected at most {gap:g}",
            )
        elif tie.joint.type.value in _HINGES:
            yield from _offset_axis(robot, tie, sizes)


def _share_part(child: Box, parent: Box, boxes: Iterable[Box | None]) -> bool:
    """Return whether another box touches both."""
    others = (box for box in boxes if box is not None and box not in (child, parent))
    return any(box.gap(child) == box.gap(parent) == 0.0 for box in others)


def _offset_axis(robot: Robot, tie: Tie, sizes: float) -> Iterator[Finding]:
    part = robot.box_of(robot.tree.links[tie.child], visuals_too=False)
    pose = robot.pose_of_joint(tie.joint)
    axis = robot.axis_in_model(tie.joint, tie.joint.axes[0]) if tie.joint.axes else None
    if part is None or pose is None or axis is None:
        return
    beside = _distance(part.centre, pose.translation, axis) - part.diagonal / 2
    if beside > sizes * part.diagonal > 0.0:
        yield finding(
            tie.joint,
            f"the axis of joint {tie.joint.name.value!r} is {beside:.3g} m away from "
            f"{tie.child!r}, which measures {part.diagonal:.3g} m",
        )


def _distance(point: Vector, origin: Vector, direction: Vector) -> float:
    """Return the distance of a point from a line, metres; `direction` has the length 1."""
    to_point = [a - b for a, b in zip(point, origin, strict=True)]
    along = sum(a * b for a, b in zip(to_point, direction, strict=True))
    return math.hypot(*(a - along * b for a, b in zip(to_point, direction, strict=True)))


def _wheel(joint_pose: str, wheel_pose: str = "0 0.3 0 0 0 0", mark: str = "") -> str:
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <collision name="c"><geometry><box><size>0.6 0.4 0.2</size></box></geometry></collision>
</link>
<link name="wheel">
  <pose>{wheel_pose}</pose>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="axle" type="revolute">{mark}
  <pose>{joint_pose}</pose>
  <parent>base_link</parent>
  <child>wheel</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
</model>
</sdf>
"""


def _stereo(side: float, mark: str = "") -> str:
    cube = f"<geometry><box><size>{side} {side} {side}</size></box></geometry>"
    return f"""
<link name="left_camera"><visual name="v">{cube}</visual></link>
<link name="right_camera">
  <pose>0 -0.09 0 0 0 0</pose>
  <visual name="v">{cube}</visual>
</link>
<joint name="baseline" type="fixed">{mark}
  <parent>left_camera</parent>
  <child>right_camera</child>
</joint>
"""


def _housing(z: float) -> str:
    box = "<box><size>0.02 0.13 0.03</size></box>"
    return f"""
<link name="housing">
  <pose>0 -0.045 {z} 0 0 0</pose>
  <visual name="v"><geometry>{box}</geometry></visual>
</link>
<joint name="front" type="fixed"><parent>housing</parent><child>left_camera</child></joint>
"""


_MARK = "  <!-- ^ KIN013 -->"
GOOD = [
    _stereo(0.01),
    _stereo(0.015) + _housing(0.0),
    _wheel("0 0 0 0 0 0"),
    _wheel("0.2 0.3 0 0 0 0"),
    _wheel("0 5 0 0 0 0"),
]
BAD = [
    _wheel("1 0 0 0 0 0", mark=_MARK),
    _wheel("0 0 0 0 0 0", "0 30 0 0 0 0", mark=_MARK),
    _stereo(0.015, _MARK),
    _stereo(0.015, _MARK) + _housing(0.03),
]
