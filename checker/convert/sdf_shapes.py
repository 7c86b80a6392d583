"""Collisions and visuals of a body of URDF, in SDF."""

from __future__ import annotations

import copy
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from lxml import etree

from checker.base.record import Record
from checker.convert.bodies import Body, PartOfBody
from checker.convert.conversion import Notes
from checker.convert.gazebo_tags import GazeboSettings, Setting
from checker.convert.names import Naming
from checker.convert.urdf_materials import Materials
from checker.convert.urdf_shapes import Shape, shapes_of
from checker.convert.xml_writer import add, child_of, exact, exact_numbers, six_numbers, unique
from checker.model.components import UNLIMITED, Axis, Collision, Joint, Visual
from checker.model.geometry.transform import Transform

# Joints of URDF in SDF 1.6. Both let a joint stand where the child's frame stands.


_TYPES = {
    "revolute": "revolute",
    "continuous": "revolute",
    "prismatic": "prismatic",
    "fixed": "fixed",
}


class Ends(Record):
    """The links that a joint ties, by their names in the result."""

    parent: str
    child: str


def add_joint(
    model: etree._Element,
    joint: Joint,
    name: str,
    ends: Ends,
    settings: Sequence[Setting],
    notes: Notes,
) -> etree._Element | None:
    """Add a joint to a model; None for one of a type that leaves its child free in Gazebo."""
    kind = _TYPES.get(joint.type.value)
    if kind is None:
        message = (
            f"joint {joint.name.value!r} has the type {joint.type.value!r}, which SDF does not have"
        )
        notes.say(joint, f"{message}: left out, so link {ends.child!r} moves freely")
        return None
    element = add(model, "joint", name=name, type_=kind)
    add(element, "parent", ends.parent)
    add(element, "child", ends.child)
    if kind != "fixed":
        for axis in joint.axes:
            _add_axis(element, axis, endless=joint.type.value == "continuous")
    for setting in settings:
        if kind != "fixed" or setting.path[0] != "axis":
            child_of(element, *setting.path).text = setting.value
    for named in joint.mimics:
        message = (
            f"joint {joint.name.value!r} mimics {named.value!r}, which SDF 1.6 cannot describe"
        )
        notes.say(named, f"{message}: it moves independently")
    return element


def _add_axis(joint: etree._Element, axis: Axis, *, endless: bool) -> None:
    element = add(joint, "axis")
    add(element, "xyz", exact_numbers(axis.xyz))
    limit = add(element, "limit")
    lower, upper = axis.lower.value, axis.upper.value
    add(limit, "lower", _bound(-math.inf if endless else lower))
    add(limit, "upper", _bound(math.inf if endless else upper))
    for tag, most in (("effort", axis.effort), ("velocity", axis.velocity)):
        if most.stated and math.isfinite(most.value):
            add(limit, tag, exact(most.value))
    resisting = [("damping", axis.damping), ("friction", axis.friction)]
    if any(value.stated for _, value in resisting):
        dynamics = add(element, "dynamics")
        for tag, value in resisting:
            add(dynamics, tag, exact(value.value))


def _bound(value: float) -> str:
    """Return a limit; SDFormat's own ±1e16 for none."""
    return exact(math.copysign(UNLIMITED, value) if abs(value) >= UNLIMITED else value)


_LUMP = "_fixed_joint_lump__"
_PRIMITIVES = ("box", "sphere", "cylinder")


@dataclass
class ShapeWriter:
    """Writes the shapes of bodies.

    Attributes:
        mesh_uri: Gives the URI to write for a mesh or texture.
        settings: Content of `<gazebo>` tags, by the name of the link as the source has it.
    """

    naming: Naming
    settings: Mapping[str, GazeboSettings]
    materials: Materials
    mesh_uri: Callable[[str], str]
    notes: Notes
    _nothing: GazeboSettings = field(default_factory=GazeboSettings)

    def collisions(self, body: Body, link: etree._Element) -> None:
        """Add the collisions of a body to its element."""
        taken: dict[str, int] = {}
        for count, (part, collision) in enumerate(_every(body, "collisions")):
            for shape in self._shapes(collision):
                name = unique(self._name(body, part, collision, "collision", count), taken)
                element = add(link, "collision", name=name)
                self._place(element, part, collision, shape)
                self._surface(element, part)
                self._blobs(element, part)

    def visuals(self, body: Body, link: etree._Element) -> None:
        """Add the visuals of a body to its element."""
        taken: dict[str, int] = {}
        for count, (part, visual) in enumerate(_every(body, "visuals")):
            for shape in self._shapes(visual):
                name = unique(self._name(body, part, visual, "visual", count), taken)
                element = add(link, "visual", name=name)
                self._place(element, part, visual, shape)
                if isinstance(visual, Visual):
                    self._paint(element, part, visual)
                self._blobs(element, part)

    def _name(
        self, body: Body, part: PartOfBody, shape: Collision | Visual, kind: str, count: int
    ) -> str:
        """Name a shape as Gazebo's parser does; what states a name keeps it."""
        stated = shape.name.value if shape.name.stated else ""
        own = stated or self.naming.local(part.link.name.value)
        if part.link is not body.link:
            own = f"{self.naming.local(body.link.name.value)}{_LUMP}{own}"
        elif stated:
            return own
        stem = own if own.endswith(f"_{kind}") else f"{own}_{kind}"
        return f"{stem}_{count}" if count else stem

    def _shapes(self, shape: Collision | Visual) -> Sequence[Shape]:
        """Return what a shape consists of in SDF 1.6; nothing, with a note, for what it lacks."""
        elements = shapes_of(shape.geometry, _PRIMITIVES)
        if not elements:
            kind = shape.geometry.shape or "missing or unknown shape"
            self.notes.say(shape, f"a {shape.element.tag} that is a {kind} is left out")
        return elements

    def _place(
        self, element: etree._Element, part: PartOfBody, source: Collision | Visual, shape: Shape
    ) -> None:
        pose = part.pose @ source.pose.transform @ shape.pose
        if pose != Transform():
            add(element, "pose", " ".join(six_numbers(pose, source.pose)))
        geometry = add(add(element, "geometry"), shape.kind)
        if shape.kind == "mesh":
            uri = source.geometry.uri
            add(geometry, "uri", self.mesh_uri(uri.value) if uri is not None else "")
        for name, sizes in shape.sizes.items():
            if shape.kind != "mesh" or any(size.value != 1.0 for size in sizes):
                add(geometry, name, exact_numbers(sizes))

    def _surface(self, element: etree._Element, part: PartOfBody) -> None:
        for setting in self._settings_of(part).collision:
            child_of(element, *setting.path).text = setting.value

    def _paint(self, element: etree._Element, part: PartOfBody, visual: Visual) -> None:
        paint = self.materials.paint_of(visual, self._settings_of(part).materials)
        if paint is not None:
            texture = self.mesh_uri(paint.texture) if paint.texture else ""
            paint.write(element, texture)

    def _blobs(self, element: etree._Element, part: PartOfBody) -> None:
        """Add the content of a `<gazebo>` tag to each shape of the link, or replace it."""
        for blob in self._settings_of(part).shapes:
            if blob.tag != element.tag:
                continue
            for child in blob.children:
                for there in [node for node in element if node.tag == child.node.tag]:
                    element.remove(there)
                element.append(copy_without_tail(child.node))

    def _settings_of(self, part: PartOfBody) -> GazeboSettings:
        return self.settings.get(part.link.name.value, self._nothing)


def copy_without_tail(node: etree._Element) -> etree._Element:
    """Return a copy of an element without the text behind it."""
    twin = copy.deepcopy(node)
    twin.tail = None
    return twin


def _every(body: Body, kind: str) -> Iterator[tuple[PartOfBody, Collision | Visual]]:
    for part in body.parts:
        shapes = part.link.collisions if kind == "collisions" else part.link.visuals
        for shape in shapes:
            yield part, shape
