"""The layer of masses: a ball at each link's centre of mass, a cross at the robot's."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from functools import cache

from msgspec.structs import replace

from checker.model.components import Joint, Link
from checker.model.geometry.transform import Rotation, Transform, Vector
from checker.physics.mass.inertia import moments_of
from checker.physics.mesh.surface import Colour, Surface
from checker.physics.trial.mjcf.names import FAR, is_finite_pose, usable
from checker.report.scene.mesh_files import short
from checker.report.scene.primitives import (
    bar,
    box,
    cone_profile,
    merge_surfaces,
    revolve,
    sphere,
    tube,
)
from checker.report.scene.scene import Item, Layer
from checker.report.scene.shapes import turn_to
from checker.report.scene.shown_robot import Hung, Showing

# The layer of joints: an arrow along each axis.


_YELLOW: Colour = (1.0, 0.85, 0.1, 1.0)
_ARROW_SHARE = 0.3
"""Length of an arrow, as a share of the robot's size."""
_ARROW_BALL = 0.15
"""Radius of a ball joint's ball, as a share of the length of an arrow."""
_SHAFT, _HEAD, _NECK = 0.02, 0.06, 0.8
"""Radii, and where the head begins, as shares of the length."""


def joints(showing: Showing) -> Hung:
    """Yield the axes of a robot's joints, each on the child that it moves; fixed ones have none."""
    for tie in showing.robot.tree.ties:
        frame = showing.robot.pose_of_joint(tie.joint)
        if tie.child not in showing.frames or frame is None:
            continue
        to_child = showing.frames[tie.child].inverse
        for surfaces, direction, share in _marks(showing, tie.joint):
            turned = Transform(turn_to(to_child.rotate(direction)))
            place = Transform(turned.rotation, to_child.apply(frame.translation))
            if is_finite_pose(place):
                size = share * _ARROW_SHARE * showing.size
                yield (
                    tie.child,
                    Item(
                        Layer.JOINT,
                        tie.joint.name.value,
                        tie.joint.element.path,
                        place,
                        surfaces,
                        (size, size, size),
                    ),
                )


def _marks(showing: Showing, joint: Joint) -> Iterator[tuple[tuple[Surface, ...], Vector, float]]:
    """Yield surfaces of size 1 that show how a joint moves, where they point, and a size."""
    if joint.type.value == "ball":
        yield (replace(sphere(), colour=_YELLOW),), (0.0, 0.0, 1.0), _ARROW_BALL
    elif joint.type.value != "fixed":
        for axis in joint.axes:
            direction = showing.robot.axis_in_model(joint, axis)
            if direction is not None:
                yield _arrow(), direction, 1.0


@cache
def _arrow() -> tuple[Surface, ...]:
    shaft, head = revolve(tube(_SHAFT, 0.0, _NECK)), revolve(cone_profile(_HEAD, _NECK, 1.0))
    return (replace(shaft, colour=_YELLOW), replace(head, colour=_YELLOW))


# The layer of frames: x, y and z of each link in red, green and blue.


_COLOURS: Sequence[Colour] = (
    (0.9, 0.15, 0.15, 1.0),
    (0.15, 0.7, 0.15, 1.0),
    (0.2, 0.35, 1.0, 1.0),
)
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_AXIS_WIDTH = 0.04
_AXIS_SHARE = 0.15
"""Length of an axis, as a share of the robot's size."""


def frames(showing: Showing) -> Hung:
    """Yield the frames of a robot's links."""
    length = _AXIS_SHARE * showing.size
    for link in showing.links:
        name, path = link.name.value, link.element.path
        item = Item(Layer.FRAME, name, path, Transform(), _axes(), (length, length, length))
        yield link.scoped_name, item


@cache
def _axes() -> tuple[Surface, ...]:
    return tuple(
        replace(bar((0.0, 0.0, 0.0), axis, _AXIS_WIDTH), colour=colour)
        for axis, colour in zip(_AXES, _COLOURS, strict=True)
    )


# The layer of inertias: boxes that would turn as the links do.


_VIOLET: Colour = (0.6, 0.25, 0.9, 0.4)
_SLACK = 1e-9
_THINNEST = 1e-3
"""Share of its longest edge that an edge of a box keeps, so that rods and discs can be seen."""
_LARGEST = 4.0
"""Sizes of the robot beyond which a box would hide all the rest."""


def inertias(showing: Showing) -> Hung:
    """Yield a box for each link: of its mass, uniform, with its inertia.

    Inertias that no body can have are left out; rules report them. So are those of boxes that
    the robot would be lost in, with a note.
    """
    violet = replace(box(), colour=_VIOLET)
    for link in showing.links:
        place, found = showing.centre_in_link(link), _equal_box(link)
        if place is not None and found is not None:
            edges, axes = found
            if max(edges) > _LARGEST * showing.size:
                _say_how_large(showing, link, max(edges))
                continue
            pose = place @ Transform(axes)
            part = "inertial" if link.inertial is not None else "no inertial: the default is used"
            item = Item(Layer.INERTIA, part, showing.inertial_path(link), pose, (violet,), edges)
            yield link.scoped_name, item


def _say_how_large(showing: Showing, link: Link, edge: float) -> None:
    name = short(link.scoped_name)
    what = f"the inertia of link {name!r} is that of a box of {edge:.3g} m"
    showing.notes.say(f"{what}: it is not shown")


def _equal_box(link: Link) -> tuple[Vector, Rotation] | None:
    """Return the edges (metres) and axes of the uniform box of a link's mass and inertia.

    A box of mass m and edges a, b, c has the moment m (b² + c²) / 12 along a, and so on. None
    where no such box exists: then one moment is greater than the other two together.
    """
    import numpy as np

    moments = moments_of(link)
    if not (np.isfinite(moments).all() and 0.0 < link.mass < math.inf and np.abs(moments).max()):
        return None
    # Scaled, for the solver squares what it is given.
    scale = float(np.abs(moments).max())
    principal, axes = np.linalg.eigh(moments / scale)
    squares = 6.0 * (principal.sum() - 2.0 * principal)
    if principal.min() < -_SLACK or squares.min() < -_SLACK:
        return None
    if np.linalg.det(axes) < 0.0:
        axes[:, 0] *= -1.0
    longest = float(np.sqrt(squares.max()))
    unit = math.sqrt(scale) / math.sqrt(link.mass)
    x, y, z = (np.sqrt(np.maximum(squares, (_THINNEST * longest) ** 2)) * unit).tolist()
    first, second, third = ((a, b, c) for a, b, c in axes.tolist())
    return ((x, y, z), (first, second, third)) if 0.0 < max(x, y, z) <= FAR else None


_TEAL: Colour = (0.0, 0.65, 0.65, 1.0)
_RED: Colour = (0.85, 0.1, 0.1, 1.0)
_BALL = 0.15
"""Radius of the ball for all of the mass, as a share of the robot's size."""
_CROSS = 0.2
"""Half length of the cross, as a share of the robot's size."""
_WIDTH = 0.06


def masses(showing: Showing) -> Hung:
    """Yield balls whose volumes are as the masses of the links, and the robot's centre of mass."""
    ball = replace(sphere(), colour=_TEAL)
    weighed = [
        (link, place)
        for link in showing.links
        if usable(link.mass) and link.mass > 0.0 and (place := showing.centre_in_link(link))
    ]
    total = math.fsum(link.mass for link, _ in weighed)
    for link, place in weighed:
        radius = _BALL * showing.size * (link.mass / total) ** (1 / 3)
        path = showing.inertial_path(link)
        name = f"{link.mass:.4g} kg"
        yield link.scoped_name, Item(Layer.MASS, name, path, place, (ball,), (radius,) * 3)
    if weighed:
        yield _whole(showing, weighed, total)


def _whole(
    showing: Showing, weighed: Sequence[tuple[Link, Transform]], total: float
) -> tuple[str, Item]:
    """Return the robot's centre of mass with all joints at 0, on its heaviest link."""
    places = [
        (link.mass / total, showing.frames[link.scoped_name].apply(place.translation))
        for link, place in weighed
    ]
    x, y, z = (math.fsum(share * at[i] for share, at in places) for i in range(3))
    heaviest = max((link for link, _ in weighed), key=lambda link: link.mass).scoped_name
    pose = showing.frames[heaviest].inverse @ Transform(translation=(x, y, z))
    length = _CROSS * showing.size
    path, name = showing.robot.element.path, f"centre of mass, {total:.4g} kg"
    return heaviest, Item(Layer.MASS, name, path, pose, _cross(), (length,) * 3)


@cache
def _cross() -> tuple[Surface, ...]:
    ends = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
    bars = [bar([-number for number in end], end, _WIDTH) for end in ends]
    return (replace(merge_surfaces(bars), colour=_RED),)
