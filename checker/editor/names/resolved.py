"""Things that the names of all files mention; each is looked up in the scopes of its file."""

from __future__ import annotations

import posixpath
from collections import defaultdict
from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.editor.names.included_files import Scopes
from checker.editor.names.mention import (
    FRAMES,
    FileNames,
    Mention,
    NameKind,
    Role,
    WrittenName,
)
from checker.editor.names.readers.expressions import is_composed, is_computed, may_come_to
from checker.editor.names.readers.topics import topics_below
from checker.editor.names.readers.values import ELSEWHERE

Key = tuple[NameKind, str, str]
"""Kind, scope and full name of a thing."""
Links = Mapping[str, tuple[str | None, ...]]

_DEPTH = 8
"""Models in models that a name is followed through."""
_DESCRIBING = ("sdf", "robot")


def key_of(mention: Mention) -> Key:
    """Return what mentions of one thing have in common."""
    return mention.kind, mention.scope, mention.name


class ComposedDefinition(Record):
    """A thing whose name is composed, and the possible values of its expressions."""

    mention: Mention
    values: frozenset[str]

    def may_be(self, name: str) -> bool:
        """Return whether the thing may have a name."""
        return may_come_to(self.mention.name, name, self.values)


class Lookup:
    """Finds the things that names mention.

    Attributes:
        mentions: The mentions of the package's own files, and the definitions in siblings.
        composed: Definitions whose names are composed, by kind.
    """

    def __init__(self, files: Mapping[str, FileNames], links: Links, scopes: Scopes) -> None:
        """Look up all names of the files.

        Args:
            files: The files by path.
            links: The paths of the files that each file includes, by its path.
            scopes: What the things of each file belong to.
        """
        self._files, self._links, self._scopes = files, links, scopes
        self._defined: set[Key] = set()
        self._scopes_of: dict[tuple[NameKind, str], list[str]] = defaultdict(list)
        self._sensors: dict[str, list[Key]] = defaultdict(list)
        self.composed: dict[NameKind, list[ComposedDefinition]] = defaultdict(list)
        self.mentions: list[Mention] = []
        for path, name in self._written():
            if name.role is Role.DEFINES:
                self._define(path, name)
        for path, name in self._written():
            self.mentions += self._mentions(path, name)

    def _written(self) -> Iterator[tuple[str, WrittenName]]:
        for path, file in self._files.items():
            # Launch files of siblings are there because the package starts them.
            is_own = not path.startswith("../") or file.format not in _DESCRIBING
            for name in file.names:
                if is_own or name.role is Role.DEFINES:
                    yield path, name

    def _scope(self, kind: NameKind, path: str) -> str:
        """Return what a thing that a file makes belongs to."""
        if kind is NameKind.TOPIC:
            return ""
        if kind in (NameKind.MACRO, NameKind.PROPERTY, NameKind.ARGUMENT):
            return self._scopes.xacro[path]
        return self._scopes.robots.get(path, "")

    def _define(self, path: str, name: WrittenName) -> None:
        kind = name.kinds[0]
        scope = self._scope(kind, path)
        if is_composed(name.name):
            mention = Mention(kind, name.name, scope, path, name.start, name.end, True)
            values = self._scopes.values.get(self._scopes.xacro[path], frozenset())
            self.composed[kind].append(ComposedDefinition(mention, values))
        key = (kind, scope, name.name)
        if key in self._defined:
            return
        self._defined.add(key)
        self._scopes_of[kind, name.name].append(scope)
        if kind is NameKind.SENSOR:
            self._sensors[name.name.rpartition("::")[2]].append(key)

    def _mentions(self, path: str, name: WrittenName) -> Iterator[Mention]:
        """Yield what a written name mentions; more than one thing where that is open."""
        defines = name.role is Role.DEFINES
        if defines:
            keys = [(name.kinds[0], self._scope(name.kinds[0], path), name.name)]
        elif name.kinds == (NameKind.TOPIC,):
            yield from self._topics(path, name)
            return
        else:
            keys = list(dict.fromkeys(self._keys(path, name)))
            if not keys and name.role is Role.STATES:
                last = name.name.rpartition("::")[2]
                keys, defines = [(NameKind.FRAME, "", last)], True
            elif not keys:
                keys = self._open(path, name)
        for kind, scope, full in keys:
            yield Mention(kind, full, scope, path, name.start, name.end, defines)

    def _keys(self, path: str, name: WrittenName) -> Iterator[Key]:
        describes = self._files[path].format in _DESCRIBING
        if name.kinds == (NameKind.ARGUMENT,):
            yield from self._arguments(path, name)
        elif describes:
            found = [*self._in_file(path, name.name, name.kinds, name.role)]
            rest = name.name
            while not found and name.role is Role.MAY_NAME and "::" in rest:
                rest = rest.partition("::")[2]  # without the name of the robot in front
                found = [*self._in_file(path, rest, name.kinds, name.role)]
            yield from found
        else:
            yield from self._anywhere(name)

    def _in_file(
        self, path: str, name: str, kinds: tuple[NameKind, ...], role: Role, depth: int = 0
    ) -> Iterator[Key]:
        """Yield what a name means in a file, or in the models that it includes."""
        found = [*self._named_things(path, name, kinds)]
        if found:
            yield from found if role is Role.MAY_NAME else found[:1]
        elif depth < _DEPTH:
            for target, rest, model in self._models(path, name):
                if not rest:
                    yield NameKind.MODEL, self._scope(NameKind.MODEL, target), model
                elif target != path:
                    yield from self._in_file(target, rest, kinds, role, depth + 1)

    def _named_things(self, path: str, name: str, kinds: tuple[NameKind, ...]) -> Iterator[Key]:
        """Yield the things of a file that have a name."""
        for kind in kinds:
            scope = self._scope(kind, path)
            if (kind, scope, name) in self._defined:
                yield kind, scope, name
            elif kind is NameKind.SENSOR:
                yield from (it for it in self._sensors.get(name, ()) if it[1] == scope)

    def _models(self, path: str, name: str) -> Iterator[tuple[str, str, str]]:
        """Yield the files of included models that a name leads to, with what is left of it.

        Nothing is left of the name of a model that only its own file names.
        """
        file = self._files[path]
        for included, target in zip(file.included, self._links[path], strict=True):
            if target is None or target not in self._files or included.by_xacro:
                continue
            model = self._files[target].model
            named = included.name[-2:] not in ("", "::")
            inside = included.name if named or included.merged else included.name + model
            if name == inside and not named and not included.merged:
                yield target, "", model
            prefix = inside if included.merged else f"{inside}::"
            if name.startswith(prefix) and name != prefix:
                yield target, name.removeprefix(prefix), model

    def _anywhere(self, name: WrittenName) -> Iterator[Key]:
        """Yield what a name without a robot means: a thing of any robot of the package."""
        parts = name.name.split("::")
        for start in range(min(len(parts), _DEPTH)):
            full = "::".join(parts[start:])
            found = [
                (kind, scope, full)
                for kind in name.kinds
                for scope in self._scopes_of.get((kind, full), ())
            ]
            if NameKind.SENSOR in name.kinds:
                found += self._sensors.get(full, ())
            if found:
                yield from found
                return

    def _arguments(self, path: str, name: WrittenName) -> Iterator[Key]:
        """Yield the arguments of launch and xacro files that a name means."""
        kind = NameKind.ARGUMENT
        scopes = self._scopes_of.get((kind, name.name), [])
        own = self._scopes.xacro[path]
        if name.role is Role.NAMES:
            chosen = [own] if own in scopes else scopes if len(scopes) == 1 else []
        elif name.files == ELSEWHERE:
            others = [scope for scope in scopes if scope != own]
            chosen = others if len(others) == 1 else []
        elif name.files:
            named = {
                self._scopes.xacro[it] for it in self._files if posixpath.basename(it) in name.files
            }
            chosen = [scope for scope in scopes if scope in named]
        elif self._files[path].format in ("launch", "robot", "sdf"):
            chosen = [own] if own in scopes else []
        else:
            chosen = scopes
        yield from ((kind, scope, name.name) for scope in chosen)

    def _topics(self, path: str, name: WrittenName) -> Iterator[Mention]:
        """Yield the topic of a name, or the one that it is published below: `scan/points`."""
        key, end = name.name, name.end
        above, _, last = key.rpartition("/")
        if (NameKind.TOPIC, "", key) not in self._defined and last in topics_below():
            key, end = above, name.end - len(last) - 1
        if (NameKind.TOPIC, "", key) in self._defined and end > name.start:
            yield Mention(NameKind.TOPIC, key, "", path, name.start, end)

    def _open(self, path: str, name: WrittenName) -> list[Key]:
        """Return what a name means of which no definition is written out."""
        kind = name.kinds[0]
        describes = self._files[path].format in _DESCRIBING
        own = self._scope(kind, path)
        if name.role is not Role.MAY_NAME:
            return [(kind, own if describes else "", name.name)]
        for kind in name.kinds:
            for definition in self.composed.get(kind, ()):
                scope = definition.mention.scope
                if (not describes or scope == own) and definition.may_be(name.name):
                    return [(kind, scope, name.name)]
        if is_composed(name.name) and not is_computed(name.name):
            return [(name.kinds[0], own, name.name)] if describes else []
        if name.kinds == FRAMES and not describes:
            return [(NameKind.FRAME, "", name.name)]
        return []
