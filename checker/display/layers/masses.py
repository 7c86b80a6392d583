"""The layer of masses: a ball at each link's centre of mass, a cross at the robot's."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cache

from checker.display.primitives import bar, joined, sphere
from checker.display.scene import Item, Layer
from checker.display.showing import Hung, Showing
from checker.display.surface import Colour, Surface
from checker.model.components import Link
from checker.model.transform import Transform
from checker.trial.mjcf_text import usable

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
    bars = [bar([-each for each in end], end, _WIDTH) for end in ends]
    return (replace(joined(bars), colour=_RED),)
