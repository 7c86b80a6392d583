"""SDF inside `<gazebo>` tags, copied into the result: sensors, lights, plugins."""

from __future__ import annotations

from dataclasses import dataclass, field

from lxml import etree

from checker.base.record import Record
from checker.convert.conversion import CarriedPlugin, Notes
from checker.convert.gazebo_tags import COPIED
from checker.convert.names import Naming
from checker.convert.sdf_shapes import copy_without_tail
from checker.convert.xml_writer import is_identity, six_numbers, unique
from checker.formats.sdf.links import read_plugin
from checker.formats.sdf.scope import Scope
from checker.model.frames import MODEL_FRAME, FrameGraph
from checker.model.geometry.transform import Transform
from checker.model.values import ValueReader
from checker.source.xml import Element

_NAMED = frozenset({"sensor", "light"})
_POSED = COPIED - {"plugin", "audio_sink"}


class CarriedFrom(Record):
    """Comment of `CarriedPlugin` about the place of a plugin."""

    link: str
    sensor: str
    reference: str


@dataclass
class Copier:
    """Copies elements of the source.

    Attributes:
        naming: The naming whose prefix is removed from names inside.
        plugins: Takes the plugins that are copied.
        taken: Names in use, by link and kind.
    """

    naming: Naming
    notes: Notes
    plugins: list[CarriedPlugin]
    taken: dict[tuple[str, str], dict[str, int]] = field(default_factory=dict)

    def copy(
        self,
        element: Element,
        parent: etree._Element,
        *,
        link: str,
        reference: str,
        pose: Transform | None = None,
    ) -> None:
        """Add a copy of an element at the end of one of the result.

        Args:
            element: The element of the source.
            parent: The parent of the result.
            link: Name of the link of the result that it is about; empty for the robot.
            reference: Name that the source's tag refers to, without prefix.
            pose: The pose of the source's link in that of the result.
        """
        twin = copy_without_tail(element.node)
        parent.append(twin)
        name = self._unique_name(element, twin, link)
        self._list_plugins(element, twin, CarriedFrom(link, name, reference))
        if pose is not None and element.tag in _POSED and not is_identity(pose):
            self._move(element, twin, pose)
        self.naming.strip(twin)

    def _unique_name(self, element: Element, twin: etree._Element, link: str) -> str:
        """Give a sensor or light its own name in its link, and return a sensor's."""
        name = element.get("name") or ""
        if name and element.tag in _NAMED:
            chosen = unique(name, self.taken.setdefault((link, element.tag), {}))
            if chosen != name:
                twin.set("name", chosen)
                message = f"{element.tag} {name!r} is renamed to {chosen!r}"
                self.notes.say(element, f"{message}: link {link!r} already has one with that name")
            name = chosen
        return name if element.tag == "sensor" else ""

    def _list_plugins(self, element: Element, twin: etree._Element, origin: CarriedFrom) -> None:
        nodes = list(twin.iter(etree.Element))
        for source, node in zip((element, *element.descendants()), nodes, strict=True):
            if source.tag == "plugin":
                plugin = read_plugin(source, owner=origin.sensor)
                carried = CarriedPlugin(plugin, origin.link, origin.sensor, origin.reference, node)
                self.plugins.append(carried)

    def _move(self, element: Element, twin: etree._Element, pose: Transform) -> None:
        """Pose a copy in the link that its own link has become part of."""
        scope = Scope("", MODEL_FRAME, (1, 6), ValueReader(), FrameGraph())
        own = scope.pose(element)
        if own.relative_to:
            message = f"<pose> of a {element.tag} is relative to {own.relative_to!r}: not changed"
            self.notes.say(own, message)
            return
        node = twin.find("pose")
        if node is None:
            node = etree.Element("pose")
            twin.insert(0, node)
        node.attrib.clear()
        for child in list(node):
            node.remove(child)
        node.text = " ".join(six_numbers(pose @ own.transform))
