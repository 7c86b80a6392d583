"""The layer of visuals: the robot as it looks."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property

from msgspec.structs import replace

from checker.base.resources import table
from checker.model.components import Visual
from checker.model.geometry.shapes import Material
from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.physics.mesh.surface import Colour, Surface
from checker.report.scene.scene import Item, Layer
from checker.report.scene.shapes import triangulate
from checker.report.scene.shown_robot import Hung, Showing
from checker.source.xml import Element

# The layer of collisions: what touches things, see-through in one colour.


_ORANGE: Colour = (1.0, 0.55, 0.1, 0.4)


def collisions(showing: Showing) -> Hung:
    """Yield the collisions of a robot."""
    for link in showing.links:
        for collision in link.collisions:
            shape, place = (
                triangulate(showing, collision),
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


# The colours of visuals, as their materials state them.


_BYTE = 255.0
_FACTS = ("diffuse", "ambient")
"""Gazebo draws a material without diffuse part black; its ambient part shows more of the robot."""


class Paint:
    """Paints the visuals of a robot."""

    def __init__(self, robot: Robot) -> None:
        self._robot = robot

    def paint(self, visual: Visual, surfaces: Sequence[Surface]) -> tuple[Surface, ...]:
        """Return surfaces as a visual shows them: in its own colour, else as they are."""
        colour = self._colour(visual)
        clear = ValueReader().number(visual.element, "transparency", 0.0).value
        solid = 1.0 - _share(clear)
        return tuple(_faded(_coloured(surface, colour), solid) for surface in surfaces)

    def _colour(self, visual: Visual) -> Colour | None:
        material = visual.material
        if material is None:
            return None
        if material.textures and visual.geometry.shape == "mesh":
            # What the picture would cover is no better known than by the file's own colours.
            return None
        if self._robot.conventions.has_named_materials:
            own = _rgba(_values(material, "diffuse"), bytes_too=True)
            return own or self._named.get(material.element.get("name") or "")
        stated = (_rgba(_values(material, fact)) for fact in _FACTS)
        return next((colour for colour in stated if colour is not None), None) or _script(material)

    @cached_property
    def _named(self) -> dict[str, Colour]:
        """Materials that the file defines, by name."""
        visuals = (visual for link in self._robot.links for visual in link.visuals)
        inside = (visual.material.element for visual in visuals if visual.material is not None)
        named: dict[str, Colour] = {}
        for element in (*self._robot.element.all("material"), *inside):
            colour = _of_urdf(element)
            if colour is not None:
                named.setdefault(element.get("name") or "", colour)
        return named


def _coloured(surface: Surface, colour: Colour | None) -> Surface:
    return surface if colour is None else replace(surface, colour=colour, vertex_colours=None)


def _faded(surface: Surface, solid: float) -> Surface:
    if solid == 1.0:
        return surface
    red, green, blue, alpha = surface.colour
    return replace(surface, colour=(red, green, blue, alpha * solid))


def _values(material: Material, fact: str) -> list[float]:
    return [number.value for number in material.colours.get(fact, ())]


def _of_urdf(material: Element) -> Colour | None:
    colour = material.child("color")
    if colour is None:
        return None
    read = ValueReader().attribute_numbers(colour, "rgba", (0.0, 0.0, 0.0, 1.0))
    return _rgba([number.value for number in read], bytes_too=True)


def _rgba(values: Sequence[float], *, bytes_too: bool = False) -> Colour | None:
    """Return a colour of three or four numbers; None for anything else.

    Args:
        values: Red, green, blue and perhaps alpha.
        bytes_too: Whether colours that go beyond 1 are taken to go up to 255.
    """
    if len(values) not in (3, 4) or not all(map(math.isfinite, values)):
        return None
    scale = _BYTE if bytes_too and max(values[:3]) > 1.0 else 1.0
    red, green, blue = (_share(value / scale) for value in values[:3])
    return (red, green, blue, _share(values[3]) if len(values) == 4 else 1.0)


def _share(value: float) -> float:
    return 0.0 if math.isnan(value) else min(max(value, 0.0), 1.0)


def _script(material: Material) -> Colour | None:
    """Return the colour of a material of Gazebo Classic by its name."""
    name = material.element.child("script", "name")
    known = table("gazebo_colours")["colours"].get(name.text.value) if name is not None else None
    if known is None:
        return None
    red, green, blue = known["diffuse"]
    return (red, green, blue, 1.0 - known.get("transparency", 0.0))


def visuals(showing: Showing) -> Hung:
    """Yield the visuals of a robot."""
    paint = Paint(showing.robot)
    for link in showing.links:
        for visual in link.visuals:
            shape, place = triangulate(showing, visual), showing.placed(link, visual, visual.pose)
            if shape is not None and place is not None:
                yield (
                    link.scoped_name,
                    Item(
                        Layer.VISUAL,
                        visual.name.value,
                        visual.element.path,
                        place @ shape.turn,
                        paint.paint(visual, shape.surfaces),
                        shape.scale,
                    ),
                )
