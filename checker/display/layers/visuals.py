"""The layer of visuals: the robot as it looks."""

from __future__ import annotations

from checker.display.colours import Paint
from checker.display.scene import Item, Layer
from checker.display.shapes import drawn
from checker.display.showing import Hung, Showing


def visuals(showing: Showing) -> Hung:
    """Yield the visuals of a robot."""
    paint = Paint(showing.robot)
    for link in showing.links:
        for visual in link.visuals:
            shape, place = drawn(showing, visual), showing.placed(link, visual, visual.pose)
            if shape is not None and place is not None:
                yield (
                    link.scoped_name,
                    Item(
                        Layer.VISUAL,
                        visual.name.value,
                        visual.element.path,
                        place @ shape.turn,
                        paint.painted(visual, shape.surfaces),
                        shape.scale,
                    ),
                )
