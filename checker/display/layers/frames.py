"""The layer of frames: x, y and z of each link in red, green and blue."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import cache

from checker.display.primitives import bar
from checker.display.scene import Item, Layer
from checker.display.showing import Hung, Showing
from checker.display.surface import Colour, Surface
from checker.model.transform import Transform

_COLOURS: Sequence[Colour] = (
    (0.9, 0.15, 0.15, 1.0),
    (0.15, 0.7, 0.15, 1.0),
    (0.2, 0.35, 1.0, 1.0),
)
_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
_WIDTH = 0.04
_SHARE = 0.15
"""Length of an axis, as a share of the robot's size."""


def frames(showing: Showing) -> Hung:
    """Yield the frames of a robot's links."""
    length = _SHARE * showing.size
    for link in showing.links:
        name, path = link.name.value, link.element.path
        item = Item(Layer.FRAME, name, path, Transform(), _axes(), (length, length, length))
        yield link.scoped_name, item


@cache
def _axes() -> tuple[Surface, ...]:
    return tuple(
        replace(bar((0.0, 0.0, 0.0), axis, _WIDTH), colour=colour)
        for axis, colour in zip(_AXES, _COLOURS, strict=True)
    )
