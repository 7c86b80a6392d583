"""Collisions, visuals, inertials and colours of a robot in URDF."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field

import msgspec
from lxml import etree

from checker.base.record import Record
from checker.convert.conversion import Notes
from checker.convert.xml_writer import (
    add,
    exact,
    exact_numbers,
    is_identity,
    six_numbers,
    unique,
)
from checker.model.components import Collision, Link, Pose, Visual
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.model.values import stated_number
from checker.source.text import Located

# Shapes in the words of a format that lacks some of them.


class Shape(Record, eq=False):
    """One shape of the replacement of a geometry.

    Attributes:
        kind: Its tag.
        sizes: The sizes, as in `Geometry.sizes`.
        pose: The pose in the frame of the geometry.
    """

    kind: str
    sizes: Mapping[str, tuple[Located[float], ...]] = msgspec.field(default_factory=dict)
    pose: Transform = msgspec.field(default_factory=Transform)


def shapes_of(geometry: Geometry, primitives: Collection[str]) -> tuple[Shape, ...]:
    """Return a geometry in a format that knows meshes and some primitives.

    A capsule is a cylinder between two spheres where the format has none. Nothing is returned for
    what it has no way to state.
    """
    kind = geometry.shape
    if kind in primitives or (kind == "mesh" and geometry.uri is not None):
        return (Shape(kind, geometry.sizes),)
    if kind != "capsule":
        return ()
    radius, half = geometry.sizes["radius"], geometry.sizes["length"][0].value / 2
    ends = (Transform(translation=(0.0, 0.0, z)) for z in (half, -half))
    spheres = (Shape("sphere", {"radius": radius}, end) for end in ends)
    return (Shape("cylinder", geometry.sizes), *spheres)


_PRIMITIVES = ("box", "sphere", "cylinder")
_MOMENTS = ("ixx", "ixy", "ixz", "iyy", "iyz", "izz")

Look = tuple[str, str]
"""Colour (red, green, blue, alpha) and texture as URDF writes them; either may be empty."""


@dataclass
class LinkWriter:
    """Writes the content of links.

    Attributes:
        mesh_uri: Gives the URI to write for a mesh or texture.
        looks: The materials that were used, each with its name.
    """

    robot: Robot
    mesh_uri: Callable[[str], str]
    notes: Notes
    looks: dict[Look, str] = field(default_factory=dict)

    def write(self, link: Link, element: etree._Element) -> None:
        """Fill the element of a link."""
        self._inertial(link, element)
        for kind, shapes in (("visual", link.visuals), ("collision", link.collisions)):
            taken: dict[str, int] = {}
            for shape in shapes:
                self._shape(link, shape, kind, element, taken)

    def _inertial(self, link: Link, element: etree._Element) -> None:
        if link.inertial is None and not link.default_mass:
            return
        inertial = add(element, "inertial")
        if link.inertial is None:
            message = f"link {link.scoped_name!r} has no inertial: SDFormat's default is written"
            self.notes.say(link, message)
            mass, moments = exact(link.mass), ["1", "0", "0", "1", "0", "1"]
        else:
            self._origin(inertial, link, link.inertial.pose)
            mass = exact(link.inertial.mass.value)
            moments = [exact(moment.value) for moment in link.inertial.moments]
        add(inertial, "mass", value=mass)
        add(inertial, "inertia", **dict(zip(_MOMENTS, moments, strict=True)))

    def _shape(
        self,
        link: Link,
        source: Collision | Visual,
        kind: str,
        element: etree._Element,
        taken: dict[str, int],
    ) -> None:
        shapes = shapes_of(source.geometry, _PRIMITIVES)
        if not shapes and source.geometry.shape != "empty":
            what = source.geometry.shape or "missing or unknown shape"
            self.notes.say(
                source, f"a {kind} that is a {what} is left out: URDF does not have this shape"
            )
        if source.geometry.element.child("submesh") is not None:
            self.notes.say(source, f"a {kind} uses the whole mesh: URDF has no submeshes")
        for shape in shapes:
            stem = source.name.value or f"{link.name.value}_{kind}"
            child = add(element, kind, name=unique(stem, taken))
            self._origin(child, link, source.pose, shape.pose)
            self._geometry(child, source, shape)
            if isinstance(source, Visual):
                self._material(child, source)

    def _origin(
        self, element: etree._Element, link: Link, stated: Pose, inside: Transform | None = None
    ) -> None:
        """Pose an element in its link."""
        pose = self._pose(link, stated)
        pose = pose if inside is None else pose @ inside
        if not is_identity(pose):
            add_origin(element, pose, stated)

    def _pose(self, link: Link, stated: Pose) -> Transform:
        pose = self.robot.pose_in_link(link, stated)
        if pose is None:
            message = f"a pose is relative to {stated.relative_to!r}, which is not known"
            self.notes.say(stated, f"{message}: the link's frame is used")
            return Transform()
        return pose

    def _geometry(self, element: etree._Element, source: Collision | Visual, shape: Shape) -> None:
        sizes = {name: exact_numbers(values) for name, values in shape.sizes.items()}
        if shape.kind == "mesh" and source.geometry.uri is not None:
            sizes = {"filename": self.mesh_uri(source.geometry.uri.value), **sizes}
        add(add(element, "geometry"), shape.kind, **sizes)

    def _material(self, element: etree._Element, visual: Visual) -> None:
        look = self._look(visual)
        if look != ("", ""):
            name = self.looks.setdefault(look, f"material_{len(self.looks) + 1}")
            add(element, "material", name=name)

    def _look(self, visual: Visual) -> Look:
        material = visual.material
        if material is None:
            return ("", "")
        colour = material.colours.get("diffuse") or material.colours.get("ambient") or ()
        rgba = [number.value for number in colour]
        if len(rgba) in (3, 4):
            rgba = [*rgba, 1.0][:4]
            see_through = stated_number(visual.element, "transparency")
            rgba[3] *= 1.0 - (see_through.value if see_through is not None else 0.0)
            # As in Gazebo; readers of URDF refuse what lies beyond.
            rgba = [min(max(number, 0.0), 1.0) for number in rgba]
        texture = material.textures[0].value if self._has_texture(visual) else ""
        text = " ".join(map(exact, rgba)) if len(rgba) == 4 else ""
        return (text, self.mesh_uri(texture) if texture else "")

    def _has_texture(self, visual: Visual) -> bool:
        """Return whether the first texture of a visual is its colour."""
        if visual.material is None or not visual.material.textures:
            return False
        tag = visual.material.textures[0].span.element.rpartition("/")[2]
        return tag.startswith(("texture", "albedo_map"))


def add_origin(element: etree._Element, pose: Transform, stated: Pose | None = None) -> None:
    """Add `<origin>` to an element."""
    xyz, rpy = six_numbers(pose, stated)
    add(element, "origin", xyz=xyz, rpy=rpy)


def add_material(element: etree._Element, name: str, look: Look) -> None:
    """Add a `<material>` that defines a look."""
    colour, texture = look
    material = add(element, "material", name=name)
    if colour:
        add(material, "color", rgba=colour)
    if texture:
        add(material, "texture", filename=texture)
