"""The layer of collisions: what touches things, see-through in one colour."""

from __future__ import annotations

from dataclasses import replace

from checker.display.scene import Item, Layer
from checker.display.shapes import drawn
from checker.display.showing import Hung, Showing
from checker.display.surface import Colour

_ORANGE: Colour = (1.0, 0.55, 0.1, 0.4)


def collisions(showing: Showing) -> Hung:
    """Yield the collisions of a robot."""
    for link in showing.links:
        for collision in link.collisions:
            shape, place = (
                drawn(showing, collision),
                showing.placed(link, collision, collision.pose),
            )
            if shape is not None and place is not None:
                coloured = tuple(
                    replace(surface, colour=_ORANGE, vertex_colours=None)
                    for surface in shape.surfaces
                )
                yield (
                    link.scoped_name,
                    Item(
                        Layer.COLLISION,
                        collision.name.value,
                        collision.element.path,
                        place @ shape.turn,
                        coloured,
                        shape.scale,
                    ),
                )
