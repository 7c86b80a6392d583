"""A robot of ours beside one of libsdformat's: where the two differ."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.model.components import Joint, Link
from checker.model.geometry.transform import Transform, rotation_from_quaternion
from checker.model.robot import Robot

TOLERANCE = 1e-9
"""Metres and radians of poses; of other values the share of the larger one."""
TYPES = (
    *("", "ball", "continuous", "fixed", "gearbox", "prismatic"),
    *("revolute", "revolute2", "screw", "universal"),
)
"""Types of joints as libsdformat numbers them."""
_UNLIMITED = 1e16

Theirs = Mapping[str, Any]


def differences(ours: Robot, theirs: Theirs) -> Iterator[str]:
    """Yield what differs: links, joints, frames and models, and all that they state."""
    yield from _parts("link", {link.scoped_name: link for link in ours.links}, theirs["links"])
    yield from _parts(
        "joint", {joint.scoped_name: joint for joint in ours.joints}, theirs["joints"]
    )
    frames = {frame.scoped_name: frame for frame in ours.frames}
    yield from _parts("frame", frames, [each for each in theirs["frames"] if not _is_merged(each)])
    models = {
        model.scoped_name: model for model in ours.models if not _is_merged_model(model.scoped_name)
    }
    yield from _parts("model", models, theirs["models"])
    by_name = {
        each["name"]: each for kind in ("links", "frames", "models") for each in theirs[kind]
    }
    for name, each in by_name.items():
        yield from _pose(name, ours.pose_of(name), each["pose"])
    for link in ours.links:
        if link.scoped_name in by_name:
            yield from _link(link, by_name[link.scoped_name])
    tied = {tie.joint.scoped_name: (tie.parent, tie.child) for tie in ours.tree.ties}
    joints = {each["name"]: each for each in theirs["joints"]}
    for joint in ours.joints:
        each = joints.get(joint.scoped_name)
        if each is not None:
            if tied.get(joint.scoped_name) != (each["parent"], each["child"]):
                yield f"joint {joint.scoped_name} ties {tied.get(joint.scoped_name)}, theirs {each['parent'], each['child']}"
            yield from _joint(ours, joint, each)


def _is_merged(frame: Theirs) -> bool:
    return "_merged__" in frame["name"]


def _is_merged_model(name: str) -> bool:
    return "_merged__" in name


def _parts(kind: str, ours: Mapping[str, object], theirs: Sequence[Theirs]) -> Iterator[str]:
    names = {each["name"] for each in theirs}
    if names != set(ours):
        yield f"{kind}s: only ours {sorted(set(ours) - names)}, only theirs {sorted(names - set(ours))}"


def _pose(name: str, ours: Transform | None, theirs: Sequence[float] | None) -> Iterator[str]:
    if ours is None or theirs is None:
        if ours is not theirs:
            yield f"the pose of {name}: ours {ours}, theirs {theirs}"
        return
    x, y, z, *quaternion = theirs
    rotation = rotation_from_quaternion(*quaternion)
    apart = max(abs(a - b) for a, b in zip(ours.translation, (x, y, z), strict=True))
    turned = max(
        abs(a - b)
        for row, other in zip(ours.rotation, rotation, strict=True)
        for a, b in zip(row, other, strict=True)
    )
    if not (apart <= TOLERANCE * max(1.0, abs(x), abs(y), abs(z)) and turned <= TOLERANCE):
        yield f"the pose of {name}: ours {ours}, theirs {theirs}"


def _link(link: Link, theirs: Theirs) -> Iterator[str]:
    name = link.scoped_name
    counts = (len(link.collisions), len(link.visuals), len(link.sensors))
    if counts != (theirs["collisions"], theirs["visuals"], theirs["sensors"]):
        yield f"the parts of {name}"
    if not _alike(link.mass, theirs["mass"]):
        yield f"the mass of {name}: ours {link.mass}, theirs {theirs['mass']}"
    if link.inertial is not None:
        moments = [moment.value for moment in link.inertial.moments]
        if not all(map(_alike, moments, theirs["moments"])):
            yield f"the inertia of {name}: ours {moments}, theirs {theirs['moments']}"
        yield from _pose(f"the inertial of {name}", link.inertial.pose.transform, theirs["centre"])


def _joint(robot: Robot, joint: Joint, theirs: Theirs) -> Iterator[str]:
    name = joint.scoped_name
    if joint.type.value.lower() != TYPES[theirs["type"]]:
        yield f"the type of {name}: ours {joint.type.value}, theirs {TYPES[theirs['type']]}"
    yield from _pose(name, robot.pose_of_joint(joint), theirs["pose"])
    if len(joint.axes) != len(theirs["axes"]):
        yield f"the axes of {name}: ours {len(joint.axes)}, theirs {len(theirs['axes'])}"
    for axis, other in zip(joint.axes, theirs["axes"], strict=False):
        ours = robot.axis_in_model(joint, axis)
        if ours is None or other["xyz"] is None or math.dist(ours, other["xyz"]) > TOLERANCE:
            yield f"an axis of {name}: ours {ours}, theirs {other['xyz']}"
        limits = [bound.value for bound in (axis.lower, axis.upper, axis.effort, axis.velocity)]
        dynamics = [part.value for part in (axis.damping, axis.friction, axis.stiffness)]
        if not all(map(_alike, limits, map(_bounded, other["limits"]))):
            yield f"the limits of {name}: ours {limits}, theirs {other['limits']}"
        if not all(map(_alike, dynamics, other["dynamics"])):
            yield f"the dynamics of {name}: ours {dynamics}, theirs {other['dynamics']}"


def _bounded(value: float) -> float:
    return value if abs(value) < _UNLIMITED else math.copysign(math.inf, value)


def _alike(ours: float, theirs: float) -> bool:
    return ours == theirs or math.isclose(ours, theirs, rel_tol=TOLERANCE, abs_tol=1e-15)
