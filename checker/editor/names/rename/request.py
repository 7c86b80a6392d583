"""A thing and its new name: the input of all reasons against the change."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.editor.names.mention import FileNames, Mention, NameKind, WrittenName
from checker.editor.names.readers.expressions import is_composed
from checker.editor.names.readers.topics import own_part
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.editor.names.index import NameIndex

OWN_SCOPE = ("sdf", "robot", "launch")
"""Formats whose names mean things of their own file, or of those that include it."""


class Rename(Record, eq=False, dict=True):
    """A thing and its new name.

    Attributes:
        index: The index of the package.
        mention: The mention of the thing, with its old name.
        new: The new name.
    """

    index: NameIndex
    mention: Mention
    new: str

    @property
    def kind(self) -> NameKind:
        """Kind of the thing."""
        return self.mention.kind

    @cached_property
    def mentions(self) -> tuple[Mention, ...]:
        """All mentions of the thing."""
        return self.index.mentions_of_same(self.mention)

    @cached_property
    def old(self) -> str:
        """The old name as it is written."""
        return self.text(self.mention)

    @cached_property
    def names(self) -> frozenset[str]:
        """The full names that the thing has now."""
        return frozenset(it.name for it in self.mentions)

    @cached_property
    def scopes(self) -> frozenset[str]:
        """Owners of the thing."""
        return frozenset(it.scope for it in self.mentions)

    @cached_property
    def new_full_names(self) -> frozenset[str]:
        """The full names that mean the thing once it has its new name."""
        if self.kind is NameKind.TOPIC:
            return frozenset(self.topic_after(name) for name in self.names)
        if is_composed(self.old):
            return frozenset({self.new})
        return frozenset("".join([*name.rpartition("::")[:2], self.new]) for name in self.names)

    def topic_after(self, key: str) -> str:
        """Return what a topic is compared by once it has its new name."""
        return key.removesuffix(own_part(key)) + self.new

    def text(self, mention: Mention) -> str:
        """Return what is written at a mention."""
        return self.index.files[mention.path].source.text[mention.start : mention.end]

    def place_text(self, mention: Mention) -> str:
        """Return the file and line of a mention."""
        span = Span(self.index.files[mention.path].source, mention.start, mention.end)
        return f"{mention.path}:{span.line}"

    def files(self) -> Iterator[tuple[str, FileNames, bool]]:
        """Yield the files whose names may mean the thing, and whether it belongs to them."""
        for path, file in self.index.files.items():
            is_same = self._scope(path) in self.scopes
            if is_same or file.format not in OWN_SCOPE:
                yield path, file, is_same

    def _scope(self, path: str) -> str:
        if self.kind is NameKind.TOPIC:
            return ""
        if self.kind in (NameKind.MACRO, NameKind.PROPERTY, NameKind.ARGUMENT):
            return self.index.scopes.xacro[path]
        return self.index.scopes.robots.get(path, "")


def place_of(path: str, file: FileNames, name: WrittenName) -> str:
    """Return the file and line of a written name."""
    return f"{path}:{Span(file.source, name.start, name.end).line}"
