"""Materials of URDF, and those of Gazebo Classic by name, as colours of SDF."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from lxml import etree

from checker.base.record import Record
from checker.base.resources import table
from checker.convert.conversion import Notes
from checker.convert.gazebo_tags import value_of
from checker.convert.xml_writer import add, number, tidy
from checker.model.components import Visual
from checker.model.robot import Robot
from checker.model.values import ValueReader
from checker.source.xml import Element

_SHINE = (0.1, 0.1, 0.1)
"""Specular part of a colour that states none: that of Gazebo's own plain colours."""
_BYTE = 255.0
_COLOURS = ("ambient", "diffuse", "specular", "emissive")


class Paint(Record):
    """Appearance of a visual.

    Attributes:
        colours: `ambient`, `diffuse`, `specular`, `emissive`: red, green, blue, alpha.
        transparency: 0 for solid.
        texture: File as the source writes it; empty for none.
    """

    colours: Mapping[str, Sequence[float]]
    transparency: float = 0.0
    texture: str = ""

    def write(self, visual: etree._Element, texture_uri: str) -> None:
        """Add `<transparency>` and `<material>` to a visual of SDF.

        Args:
            visual: The visual of the result.
            texture_uri: What to write for the texture.
        """
        if self.transparency > 0.0:
            add(visual, "transparency", number(self.transparency))
        material = add(visual, "material")
        for name in _COLOURS:
            if name in self.colours:
                add(material, name, " ".join(map(tidy, self.colours[name])))
        if self.texture:
            metal = add(add(material, "pbr"), "metal")
            add(metal, "albedo_map", texture_uri)


class Materials:
    """The materials of a description, by the names under which it defines them."""

    def __init__(self, robot: Robot, notes: Notes) -> None:
        self._notes = notes
        inside = [visual.element.child("material") for visual in _visuals(robot)]
        every = (
            *robot.element.all("material"),
            *(material for material in inside if material is not None),
        )
        self._named: dict[str, Paint] = {}
        for element in every:
            paint = _paint(element, notes)
            if paint is not None:
                self._named.setdefault(element.get("name") or "", paint)

    def paint_of(self, visual: Visual, materials: Sequence[Element]) -> Paint | None:
        """Return how a visual looks; None for its own appearance, such as a mesh's.

        Args:
            visual: The visual of the source.
            materials: The `<material>`s of `<gazebo>` tags about its link; they come first.
        """
        for element in reversed(materials):
            paint = self._of_gazebo(element)
            if paint is not None:
                return paint
        element_ = visual.element.child("material")
        if element_ is None:
            return None
        paint = _paint(element_, self._notes) or self._named.get(element_.get("name") or "")
        if paint is None:
            self._notes.say(element_, f"material {element_.get('name')!r} is not defined")
        return paint

    def _of_gazebo(self, element: Element) -> Paint | None:
        name = value_of(element)
        known = table("gazebo_colours")["colours"].get(name)
        if known is None:
            self._notes.say(element, f"material {name} is not a plain colour of Gazebo: left out")
            return None
        colours = {part: (*known[part], 1.0) for part in _COLOURS if part in known}
        return Paint(colours, known.get("transparency", 0.0))


def _visuals(robot: Robot) -> list[Visual]:
    return [visual for link in robot.links for visual in link.visuals]


def _paint(material: Element, notes: Notes) -> Paint | None:
    """Return what a material of URDF states; None for one that only names another."""
    colour, texture = material.child("color"), material.child("texture")
    if colour is None and texture is None:
        return None
    rgba = [1.0, 1.0, 1.0, 1.0]
    if colour is not None:
        read = ValueReader().attribute_numbers(colour, "rgba", (0.0, 0.0, 0.0, 1.0))
        rgba = [value.value for value in read]
        if max(rgba[:3]) > 1.0:
            notes.say(colour, f"colour {colour.get('rgba')!r} is read as 0 to 255, not 0 to 1")
            rgba = [*(value / _BYTE for value in rgba[:3]), rgba[3]]
        rgba = [min(max(value, 0.0), 1.0) for value in rgba]
    opaque = (*rgba[:3], 1.0)
    file = texture.get("filename") or "" if texture is not None else ""
    colours = {"ambient": opaque, "diffuse": opaque, "specular": (*_SHINE, 1.0)}
    return Paint(colours, 1.0 - rgba[3], file)
