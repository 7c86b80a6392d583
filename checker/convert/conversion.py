"""Result of a conversion: a document, and notes for its author."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

import msgspec
from lxml import etree

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.geometry.transform import Transform
from checker.source.text import Span

# What a conversion drops or decides, each with the line it is about.


class Placed(Protocol):
    """Anything that is somewhere in the source."""

    @property
    def span(self) -> Span:
        """Place in the source."""
        ...


@dataclass
class Notes:
    """Sentences, each once, in the order in which they were stated."""

    _sentences: dict[str, None] = field(default_factory=dict)

    def say(self, where: Placed, what: str) -> None:
        """Note something about a place of the source."""
        place = where.span.place()
        self._sentences[f"{place.file}:{place.line}: {what}"] = None

    @property
    def all(self) -> tuple[str, ...]:
        """The sentences."""
        return tuple(self._sentences)


class CarriedPlugin(Record, eq=False):
    """A plugin of the source that is in the result, for the caller to judge.

    Attributes:
        plugin: The plugin as the source states it; its element leads to the file and line.
        link: Name of the link of the result that its tag is about; empty for the whole robot.
        sensor: Name of the sensor that contains it; else empty.
        reference: Name, without prefix, of the link or joint that the source's tag is about.
        node: Its element in the result.
    """

    plugin: Plugin
    link: str
    sensor: str
    reference: str
    node: etree._Element

    def remove(self) -> None:
        """Take the plugin out of the result."""
        parent = self.node.getparent()
        if parent is not None:
            parent.remove(self.node)


class Lumped(Record, eq=False):
    """The place of a link of the source in the result.

    Attributes:
        link: Name of the link of the result that carries it; its own where it stays a link.
        pose: Its frame in that link's frame.
    """

    link: str
    pose: Transform


class Conversion(Record, eq=False):
    """A converted robot.

    Attributes:
        tree: The outermost element of the new document: `<sdf>` or `<robot>`.
        notes: What was dropped or decided, as sentences that start with the file and line.
        plugins: Plugins copied from the source unchanged.
        lumped: Links of the source by their name without prefix; one that was dropped is missing.
    """

    tree: etree._Element
    notes: tuple[str, ...] = ()
    plugins: tuple[CarriedPlugin, ...] = ()
    lumped: Mapping[str, Lumped] = msgspec.field(default_factory=dict)
