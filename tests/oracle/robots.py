"""A robot of ours beside one of libsdformat's: where the two differ."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import Any

from checker.model.components import Axis, Joint, Link
from checker.model.geometry.transform import Transform, rotation_from_quaternion
from checker.model.robot import Robot

EXACT = 1e-9
"""Metres and radians of poses; of other values the share of the larger one."""
TYPES = (
    *("", "ball", "continuous", "fixed", "gearbox", "prismatic"),
    *("revolute", "revolute2", "screw", "universal"),
)
"""Types of joints as libsdformat numbers them."""
_UNLIMITED = 1e16
_MERGED = "_merged__"
"""What the frame is called that libsdformat makes of a merged model."""

Theirs = Mapping[str, Any]


def differences(ours: Robot, theirs: Theirs, tolerance: float = EXACT) -> Iterator[str]:
    """Yield what differs: links, joints, frames and models, and all that they state."""
    links = {link.scoped_name: link for link in ours.links}
    joints = {joint.scoped_name: joint for joint in ours.joints}
    placed = {
        "frames": [frame.scoped_name for frame in ours.frames],
        "models": [model.scoped_name for model in ours.models if _MERGED not in model.scoped_name],
    }
    for kind, names in (("links", links), ("joints", joints), *placed.items()):
        yield from _names(kind, names, theirs[kind])
    for each in (*theirs["links"], *theirs["frames"], *theirs["models"]):
        yield from _pose(each["name"], ours.pose_of(each["name"]), each["pose"], tolerance)
    for each in theirs["links"]:
        if each["name"] in links:
            yield from _link(links[each["name"]], each)
    ties = {tie.joint.scoped_name: [tie.parent, tie.child] for tie in ours.tree.ties}
    for each in theirs["joints"]:
        name = each["name"]
        if name in joints:
            yield from _same(f"ends of {name}", ties.get(name), [each["parent"], each["child"]])
            yield from _joint(ours, joints[name], each, tolerance)


def _names(kind: str, ours: Collection[str], theirs: Sequence[Theirs]) -> Iterator[str]:
    names = {each["name"] for each in theirs if _MERGED not in each["name"]}
    yield from _same(kind, sorted(ours), sorted(names))


def _same(what: str, ours: object, theirs: object) -> Iterator[str]:
    if ours != theirs:
        yield f"{what}: ours {ours}, theirs {theirs}"


def _alike(what: str, ours: Sequence[float], theirs: Sequence[float]) -> Iterator[str]:
    if not all(
        one == other or math.isclose(one, other, rel_tol=EXACT, abs_tol=1e-15)
        for one, other in zip(ours, theirs, strict=True)
    ):
        yield f"{what}: ours {ours}, theirs {theirs}"


def _pose(
    name: str, ours: Transform | None, theirs: Sequence[float] | None, tolerance: float = EXACT
) -> Iterator[str]:
    if ours is None or theirs is None:
        yield from _same(f"pose of {name}", ours, theirs)
        return
    place, quaternion = theirs[:3], theirs[3:]
    w, x, y, z = quaternion
    reach = max(1.0, *map(abs, place))
    apart = math.dist(ours.translation, place)
    turned = math.dist(
        [number for row in ours.rotation for number in row],
        [number for row in rotation_from_quaternion(w, x, y, z) for number in row],
    )
    if not (apart <= tolerance * reach and turned <= tolerance):
        yield f"pose of {name}: {apart:.3g} m and {turned:.3g} rad apart"


def _link(link: Link, theirs: Theirs) -> Iterator[str]:
    name = link.scoped_name
    counts = [len(link.collisions), len(link.visuals), len(link.sensors)]
    kinds = ("collisions", "visuals", "sensors")
    yield from _same(f"parts of {name}", counts, [theirs[kind] for kind in kinds])
    yield from _alike(f"mass of {name}", [link.mass], [theirs["mass"]])
    if link.inertial is not None:
        moments = [moment.value for moment in link.inertial.moments]
        yield from _alike(f"moments of {name}", moments, theirs["moments"])
        yield from _pose(f"the inertial of {name}", link.inertial.pose.transform, theirs["centre"])


def _joint(robot: Robot, joint: Joint, theirs: Theirs, tolerance: float) -> Iterator[str]:
    name = joint.scoped_name
    yield from _same(f"type of {name}", joint.type.value.lower(), TYPES[theirs["type"]])
    yield from _pose(name, robot.pose_of_joint(joint), theirs["pose"], tolerance)
    yield from _same(f"axes of {name}", len(joint.axes), len(theirs["axes"]))
    for axis, other in zip(joint.axes, theirs["axes"], strict=False):
        ours = robot.axis_in_model(joint, axis)
        if ours is None or other["xyz"] is None or math.dist(ours, other["xyz"]) > tolerance:
            yield from _same(f"axis of {name}", ours, other["xyz"])
        yield from _alike(f"limits of {name}", _limits(axis), [*map(_bounded, other["limits"])])
        dynamics = [part.value for part in (axis.damping, axis.friction, axis.stiffness)]
        yield from _alike(f"dynamics of {name}", dynamics, other["dynamics"])


def _limits(axis: Axis) -> list[float]:
    return [bound.value for bound in (axis.lower, axis.upper, axis.effort, axis.velocity)]


def _bounded(value: float) -> float:
    return value if abs(value) < _UNLIMITED else math.copysign(math.inf, value)
