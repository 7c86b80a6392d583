"""A thing gets another name in all files of its package, or in none."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

from checker.editor.names.expressions import (
    EXPRESSION,
    is_composed,
    is_computed,
    literal_pieces,
    may_come_to,
)
from checker.editor.names.mention import FileNames, Mention, NameKind, Role, WrittenName
from checker.editor.names.new_names import invalid
from checker.editor.names.topics import DERIVED, info_topic, own_part
from checker.finding import Edit
from checker.source.text import Span

if TYPE_CHECKING:
    from checker.editor.names.index import NameIndex

_PARTS = frozenset({NameKind.LINK, NameKind.JOINT, NameKind.FRAME, NameKind.MODEL})
"""Kinds of which SDFormat gives no two parts of one model the same name."""


def renamed(index: NameIndex, mention: Mention, new: str) -> tuple[Edit, ...] | str:
    """Return the edits that give a thing another name, or why it cannot have it.

    Args:
        index: Of the package.
        mention: Any of the thing.
        new: The new name, without the models around the thing; of a topic, without the model's
            name and without a leading slash.
    """
    return Renaming(index, mention, new).edits()


class Renaming:
    """A thing, and the name that it is to have."""

    def __init__(self, index: NameIndex, mention: Mention, new: str) -> None:
        """Look at all mentions of the thing."""
        self._index = index
        self._mention = mention
        self._new = new
        self._same = index.same(mention)
        self._old = self._text(mention)

    def edits(self) -> tuple[Edit, ...] | str:
        """Return the edits, file by file, or why there are none."""
        if self._new == self._old:
            return ()
        reasons = (
            self._invalid,
            self._undefined,
            self._elsewhere,
            self._ambiguous,
            self._composed,
            self._taken,
            self._unread,
            self._inherited,
        )
        refused = next(filter(None, (reason() for reason in reasons)), "")
        return refused or tuple(self._edits())

    def _edits(self) -> Iterator[Edit]:
        places = {(it.path, it.start, it.end) for it in self._same}
        for path, start, end in sorted(places):
            yield Span(self._index.files[path].source, start, end).replaced_by(self._new)

    def _shown(self, mention: Mention) -> str:
        span = Span(self._index.files[mention.path].source, mention.start, mention.end)
        return f"{mention.path}:{span.line}"

    def _text(self, mention: Mention) -> str:
        return self._index.files[mention.path].source.text[mention.start : mention.end]

    def _invalid(self) -> str:
        if is_computed(self._old):
            return f"{self._old!r} is computed where the thing is made; change it there"
        return invalid(self._mention.kind, self._old, self._new)

    def _undefined(self) -> str:
        if any(it.is_definition for it in self._same):
            return ""
        kind = self._mention.kind
        composed = next(iter(self._index.definitions(self._mention)), None)
        if composed is not None:
            return (
                f"the name of {kind} {self._old!r} is composed by an expression at "
                f"{self._shown(composed)}: {composed.name!r}; change it there"
            )
        return f"{kind} {self._old!r} is not defined in this package"

    def _elsewhere(self) -> str:
        """Say that the thing belongs to another package, or stands where it cannot be edited."""
        for it in self._same:
            if it.path.startswith("../"):
                kind = self._mention.kind
                what = "defined" if it.is_definition else "named"
                return f"{kind} {self._old!r} is {what} in another package, {self._shown(it)}"
        for it in self._same:
            if self._text(it) != self._old:
                return f"{self._shown(it)} composes {self._old!r} in a way that cannot be changed"
        return ""

    def _ambiguous(self) -> str:
        """Say that a text may name the thing, or another one."""
        own = {(it.kind, it.scope, it.name) for it in self._same}
        for it in self._same:
            for other in self._index.beside(it):
                if (other.kind, other.scope, other.name) not in own:
                    return (
                        f"{self._shown(it)} may name the {it.kind} or the {other.kind} "
                        f"{self._old!r}; give one of them another name there first"
                    )
        return ""

    def _composed(self) -> str:
        """Say that a name is composed, and may be that of the thing, or come from it."""
        kind, name = self._mention.kind, self._mention.name
        if is_composed(self._old):
            made = next(iter(self._index.made(self._mention)), None)
            if made is not None:
                return (
                    f"{self._shown(made)} names {self._text(made)!r}, which {self._old!r} "
                    "may come to; it cannot be changed along"
                )
        written = {it.name for it in self._same}
        last = name if kind is NameKind.TOPIC else self._old
        scopes = {it.scope for it in self._same}
        for path, file in self._index.files.items():
            if file.format in _OWN_SCOPE and self._scope(kind, path) not in scopes:
                continue
            values = self._index.scopes.values.get(self._index.scopes.xacro[path])
            for it in file.names:
                if kind not in it.kinds or it.name in written or not is_composed(it.name):
                    continue
                mine = is_composed(self._old) and self._own_composed(kind, path, it.name)
                if mine or is_computed(it.name) or path.startswith("../"):
                    continue
                text = it.name.rpartition("::")[2] if "::" in it.name else it.name
                if _may_meet(text, last, values or frozenset()):
                    span = Span(file.source, it.start, it.end)
                    return (
                        f"{path}:{span.line} composes a name that may be {self._old!r}: "
                        f"{it.name!r}; it cannot be changed along"
                    )
        return ""

    def _own_composed(self, kind: NameKind, path: str, name: str) -> bool:
        """Whether a composed name is that of a thing of its own."""
        scope = self._index.scopes.robots.get(path, "")
        definitions = (it.mention for it in self._index.composed(kind))
        return any(it.scope == scope and it.name == name for it in definitions)

    def _taken(self) -> str:
        """Say that the new name means something already."""
        kind = self._mention.kind
        scopes = {it.scope for it in self._same}
        for path, file in self._index.files.items():
            is_same = self._scope(kind, path) in scopes
            if kind is NameKind.PROPERTY and is_same and self._new in file.parameters:
                return f"{self._new!r} is already a parameter of a macro in {path}"
            if is_same or file.format not in _OWN_SCOPE:
                used = next(self._uses(path, file), None)
                if used is not None:
                    span = Span(file.source, used.start, used.end)
                    return f"{self._new!r} is already used at {path}:{span.line}"
        for definition in self._index.composed(kind):
            if definition.mention.scope in scopes and any(map(definition.may_be, self._wanted)):
                shown = self._shown(definition.mention)
                return f"{self._new!r} may already be a {kind} that is composed at {shown}"
        return ""

    def _uses(self, path: str, file: FileNames) -> Iterator[WrittenName]:
        """Yield what a file already calls by the new name."""
        kind = self._mention.kind
        kinds = _PARTS if kind in _PARTS else {kind}
        is_topic = kind is NameKind.TOPIC
        is_own = not path.startswith("../")
        below = tuple(f"{name}/" for name in self._wanted)
        for it in file.names:
            if not kinds.intersection(it.kinds) or not (is_own or it.role is Role.DEFINES):
                continue
            is_open = it.role is Role.MAY_NAME and it.name == self._new
            if is_open or it.name in self._wanted or (is_topic and it.name.startswith(below)):
                yield it

    def _scope(self, kind: NameKind, path: str) -> str:
        scopes = self._index.scopes
        if kind is NameKind.TOPIC:
            return ""
        if kind in (NameKind.MACRO, NameKind.PROPERTY, NameKind.ARGUMENT):
            return scopes.xacro[path]
        return scopes.robots.get(path, "")

    @cached_property
    def _wanted(self) -> frozenset[str]:
        """The full names that mean the thing once it has its new name."""
        names = set()
        for name in {it.name for it in self._same}:
            if self._mention.kind is NameKind.TOPIC:
                names.add(name.removesuffix(own_part(name)) + self._new)
            elif is_composed(self._old):
                names.add(self._new)
            else:
                names.add("".join([*name.rpartition("::")[:2], self._new]))
        return frozenset(names)

    def _unread(self) -> str:
        """Say that a file which holds the name cannot be read."""
        literal = max(literal_pieces(self._old), key=len)
        for path, file in self._index.files.items():
            if file.fault and literal in file.source.text:
                return f"{path} may name {self._old!r} and cannot be read: {file.fault}"
        return ""

    def _inherited(self) -> str:
        """Say that something takes its own name from that of the thing."""
        if self._mention.kind is NameKind.TOPIC:
            return self._beside_topic()
        if self._mention.kind is NameKind.ARGUMENT:
            return self._passed_on()
        return ""

    def _beside_topic(self) -> str:
        """Say that the camera_info beside a topic is bridged, and would move."""
        for name in {it.name for it in self._same}:
            old = info_topic(name)
            new = info_topic(name.removesuffix(own_part(name)) + self._new)
            is_stated = any(
                it.is_definition and it.kind is NameKind.TOPIC and it.name == old
                for it in self._index.mentions
            )
            if old == new or own_part(name) == DERIVED or is_stated:
                continue
            for path, file in self._index.files.items():
                for it in file.names:
                    if NameKind.TOPIC in it.kinds and it.name == old:
                        shown = f"{path}:{Span(file.source, it.start, it.end).line}"
                        return f"{shown} names {old!r}, which moves along with the topic"
        return ""

    def _passed_on(self) -> str:
        """Say that a launch file hands the argument on to another one without a word."""
        kind, name = self._mention.kind, self._old
        for it in self._same:
            if not it.is_definition or self._index.files[it.path].format not in _LAUNCH:
                continue
            text = self._index.files[it.path].source.text
            if it.path.endswith(".launch") and "pass_all_args" not in text:
                continue
            for other in self._defining(kind, name):
                named = posixpath.basename(other.path) in text
                passed = any(
                    mention.path == it.path and mention.scope == other.scope
                    for mention in self._index.same(other)
                )
                if other.scope != it.scope and named and not passed:
                    return (
                        f"{it.path} includes {other.path}, which also declares {name!r} and "
                        "takes its value from there"
                    )
        return ""

    def _defining(self, kind: NameKind, name: str) -> Iterator[Mention]:
        for it in self._index.mentions:
            is_launch = self._index.files[it.path].format in _LAUNCH
            if it.is_definition and it.kind is kind and it.name == name and is_launch:
                yield it


_LAUNCH = ("launch", "python", "yaml")
_OWN_SCOPE = ("sdf", "robot", "launch")
"""Formats whose names mean things of their own file, or of those that include it."""


def _may_meet(composed: str, name: str, values: frozenset[str]) -> bool:
    """Whether a composed name may come to another one, which may be composed itself."""
    if not is_composed(name):
        return may_come_to(composed, name, values)
    # Expressions of the other may come to anything: only what is written out has to fit.
    return may_come_to(composed, EXPRESSION.sub("\ufffd", name), None)
