"""XML that a package's spawner emits, with places in the lines of Ruby."""

from __future__ import annotations

import posixpath
import re
from collections import Counter
from collections.abc import Callable, Hashable, Iterator
from functools import cached_property
from typing import TypeVar

from checker.base.files import NotReadable
from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.launch.spawner.reader import Spawner
from checker.launch.spawner.signals import Unread
from checker.package.inheritance import SPAWNER
from checker.package.package import Package
from checker.source.emitted import EmittedText
from checker.source.text import SourceText, Span
from checker.source.xml import Element, XmlDocument
from checker.source.xml_fragments import parse_fragments, unwrapped
from checker.source.xml_positions import XmlFault

_FACTORY = "GazeboFactory"
_MODELS = ("include", "model")


class WorkspaceFiles(Record):
    """Gives the spawner reader the texts of a package and of its siblings."""

    package: Package

    @property
    def entry(self) -> str:
        """Path of the spawner, from the workspace."""
        return f"{self.package.root.name}/{SPAWNER}"

    def _local(self, path: str) -> str:
        """Return a path of the workspace as the package sees it."""
        return posixpath.relpath(path, self.package.root.name)

    def read(self, path: str) -> SourceText | str:
        """Return a text, or the reason why it cannot be given."""
        text = self.package.read(self._local(path))
        if isinstance(text, NotReadable):
            return f"{path} {text.reason}"
        return text

    def exists(self, path: str) -> bool:
        """Return whether there is a file or folder of this path."""
        return self.package.exists(self._local(path))

    def package_folder(self, name: str) -> str | None:
        """Return the folder of a package, None if it is not available."""
        package = self.package.workspace.package(name)
        return package.root.name if package is not None else None


class EmittedXml(Record, eq=False):
    """XML that a function of the spawner emits.

    Attributes:
        text: The text, with its places in the Ruby file.
        document: The same as XML; its elements are below `emitted`.
    """

    text: EmittedText
    document: XmlDocument

    def words_of(self, span: Span) -> list[Span]:
        """Return the words of a stretch, as blanks part them."""
        words = re.finditer(r"\S+", span.text)
        return [Span(span.source, span.start + w.start(), span.start + w.end()) for w in words]


class SpawnedXml(EmittedXml, dict=True):
    """XML that `spawner` emits: the robot and the plugins that it gets.

    Attributes:
        spawner: The spawner that emits it.
    """

    spawner: Spawner

    def parameters_of(self, span: Span) -> frozenset[str]:
        """Return the function's parameters and the globals that a stretch of the text depends on.

        It depends on those whose other value changes one of its pieces, or leaves it out.
        """
        return frozenset().union(
            *(self._parameters[at] for at in self.text.pieces_in(*unwrapped(span)))
        )

    @cached_property
    def _parameters(self) -> list[frozenset[str]]:
        """The parameters and globals that each piece of the text depends on."""
        variants = [(name, set(_numbered(other))) for name, other in self.spawner.variants()]
        return [
            frozenset(name for name, others in variants if piece not in others)
            for piece in _numbered(self.text)
        ]

    @cached_property
    def spawns(self) -> list[Element]:
        """The outermost `<spawn>` elements, and what older spawners have instead."""
        wrapped = [each for plugin in self.gazebo_factories for each in _spawns_in(plugin)]
        return [*self.document.root.all("spawn"), *wrapped]

    @cached_property
    def gazebo_factories(self) -> list[Element]:
        """The launcher's plugins that older spawners wrap the robot in."""
        plugins = self.document.root.descendants("plugin")
        return [
            plugin
            for plugin in plugins
            if "gazebo-factory" in (plugin.get("filename") or "")
            or (plugin.get("name") or "").rpartition("::")[2] == _FACTORY
        ]

    @cached_property
    def plugins(self) -> list[Element]:
        """The plugins that `spawner` adds to the robot."""
        models = [model for spawn in self.spawns for model in models_of(spawn)]
        return [plugin for model in models for plugin in model.all("plugin")]


def _numbered(emitted: EmittedText | Unread) -> Iterator[Hashable]:
    """Yield what tells each piece from others: its text, origin, and number among that one's."""
    counts: Counter[Hashable] = Counter()
    if isinstance(emitted, Unread):
        return
    for piece in emitted.pieces:
        span = piece.span or emitted.origin
        origin = (span.source.file, span.start, span.end)
        yield piece.text, origin, counts[origin]
        counts[origin] += 1


def _spawns_in(factory: Element) -> list[Element]:
    """Return what a plugin spawns: the `<spawn>` elements in it, else what itself describes."""
    return factory.all("spawn") or [factory]


def models_of(spawn: Element) -> list[Element]:
    """Return the models in a `<spawn>`: the robot first, then its payload.

    They belong into `<sdf>`; where it was left out, they are still what is meant.
    """
    holders = spawn.all("sdf") or [spawn]
    return [model for holder in holders for tag in _MODELS for model in holder.all(tag)]


class StartedXml(EmittedXml, dict=True):
    """XML that `rosExecutables` emits: the commands that start the robot's ROS nodes."""

    @cached_property
    def commands(self) -> list[Element]:
        """The `<command>` elements."""
        return self.document.find_all("executable/command")


Emitted = TypeVar("Emitted", bound=EmittedXml)


def emitted_xml(
    kind: Callable[[EmittedText, XmlDocument], Emitted],
    function: str,
    emitted: EmittedText | Unread,
) -> Emitted | NotAvailable:
    """Parse what a function of the spawner emits; what cannot be read is not available."""
    if isinstance(emitted, Unread):
        place = emitted.span.place()
        return NotAvailable(
            f"{function} cannot be read at {place.file}:{place.line}: {emitted.reason}"
        )
    document = parse_fragments(emitted)
    if isinstance(document, XmlFault):
        return NotAvailable(f"the XML that {function} emits is not well-formed: {document.message}")
    return kind(emitted, document)
