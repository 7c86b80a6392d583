"""What comes out of a conversion: a document, and what a person ought to know about it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field

from lxml import etree

from checker.model.components import Plugin
from checker.model.transform import Transform
from checker.record import record


@record(eq=False)
class CarriedPlugin:
    """A plugin of the source that stands in the result, for the caller to judge.

    Attributes:
        plugin: As the source says it; its element leads to the file and line.
        link: Name of the link of the result that its tag is about; empty for the whole robot.
        sensor: Name of the sensor that it stands in; else empty.
        reference: Name, without prefix, of the link or joint that the source's tag is about.
        node: Its element in the result.
    """

    plugin: Plugin
    link: str
    sensor: str
    reference: str
    node: etree._Element = field(repr=False)

    def remove(self) -> None:
        """Take the plugin out of the result."""
        parent = self.node.getparent()
        if parent is not None:
            parent.remove(self.node)


@record(eq=False)
class Lumped:
    """Where a link of the source is to be found in the result.

    Attributes:
        link: Name of the link of the result that carries it; its own where it stays a link.
        pose: Its frame in that link's frame.
    """

    link: str
    pose: Transform


@record(eq=False)
class Conversion:
    """A converted robot.

    Attributes:
        tree: The outermost element of the new document: `<sdf>` or `<robot>`.
        notes: What was dropped or decided, as sentences that start with the file and line.
        plugins: What stands in the document and was copied from the source as it is.
        lumped: Links of the source by their name without prefix; one that was dropped is missing.
    """

    tree: etree._Element = field(repr=False)
    notes: tuple[str, ...] = ()
    plugins: tuple[CarriedPlugin, ...] = ()
    lumped: Mapping[str, Lumped] = field(default_factory=dict)
