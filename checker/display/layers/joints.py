"""The layer of joints: an arrow along each axis."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import cache

from checker.display.primitives import revolved, sphere, tapered, tube
from checker.display.scene import Item, Layer
from checker.display.shapes import turn_to
from checker.display.showing import Hung, Showing
from checker.display.surface import Colour, Surface
from checker.model.components import Joint
from checker.model.transform import Transform, Vector
from checker.trial.mjcf_text import well_placed

_YELLOW: Colour = (1.0, 0.85, 0.1, 1.0)
_SHARE = 0.3
"""Length of an arrow, as a share of the robot's size."""
_BALL = 0.15
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
            if well_placed(place):
                size = share * _SHARE * showing.size
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
        yield (replace(sphere(), colour=_YELLOW),), (0.0, 0.0, 1.0), _BALL
    elif joint.type.value != "fixed":
        for axis in joint.axes:
            direction = showing.robot.axis_in_model(joint, axis)
            if direction is not None:
                yield _arrow(), direction, 1.0


@cache
def _arrow() -> tuple[Surface, ...]:
    shaft, head = revolved(tube(_SHAFT, 0.0, _NECK)), revolved(tapered(_HEAD, _NECK, 1.0))
    return (replace(shaft, colour=_YELLOW), replace(head, colour=_YELLOW))
