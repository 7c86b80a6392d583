"""The names of a package: definitions and mentions."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Mapping
from functools import cached_property

from checker.base.record import Record
from checker.editor.names.included_files import Scopes, included_path, scopes_of
from checker.editor.names.mention import FileNames, Mention, NameKind
from checker.editor.names.readers.expressions import is_composed, may_come_to
from checker.editor.names.readers.file_names import file_names, holds_names
from checker.editor.names.rename.edits import rename_edits
from checker.editor.names.resolved import ComposedDefinition, Key, Lookup, key_of
from checker.finding import Edit
from checker.package.inheritance import Found
from checker.package.package import Package
from checker.source.text import SourceText

INHERITED = ("launch/description.launch", "launch/vehicle_topics.launch")
"""Files that a package may have from a sibling, besides the model."""
SIBLING_FILES = 100
"""Files of siblings that are read because the package includes them."""


class NameIndex(Record, eq=False, dict=True):
    """The names of a package.

    Attributes:
        package: The package that was read.
        files: Names of each file, those of siblings that the package includes among them.
        links: The paths of the files that each file includes, by its path; None if one is not
            known.
        scopes: What the things of each file belong to.
    """

    package: Package
    files: Mapping[str, FileNames]
    links: Mapping[str, tuple[str | None, ...]]
    scopes: Scopes

    @cached_property
    def _lookup(self) -> Lookup:
        return Lookup(self.files, self.links, self.scopes)

    @cached_property
    def _groups(self) -> Mapping[Key, list[Mention]]:
        groups: dict[Key, list[Mention]] = defaultdict(list)
        for mention in self._lookup.mentions:
            groups[key_of(mention)].append(mention)
        return groups

    @cached_property
    def _by_place(self) -> Mapping[str, Mapping[tuple[int, int], list[Mention]]]:
        places: dict[str, dict[tuple[int, int], list[Mention]]] = defaultdict(dict)
        for mention in self._lookup.mentions:
            places[mention.path].setdefault((mention.start, mention.end), []).append(mention)
        return places

    @property
    def mentions(self) -> tuple[Mention, ...]:
        """All mentions in the files of the package, and the definitions in siblings."""
        return tuple(self._lookup.mentions)

    def composed_definitions(self, kind: NameKind) -> tuple[ComposedDefinition, ...]:
        """Return the definitions of a kind whose names are composed."""
        return tuple(self._lookup.composed.get(kind, ()))

    def at(self, path: str, offset: int) -> Mention | None:
        """Return the mention at a place, the shortest where there are several; None for none."""
        places = self._by_place.get(path, {})
        around = [place for place in places if place[0] <= offset <= place[1]]
        if not around:
            return None
        return places[min(around, key=lambda place: (place[1] - place[0], -place[0]))][0]

    def possible_mentions(self, mention: Mention) -> tuple[Mention, ...]:
        """Return all that the name at the place of a mention may mean, the mention included."""
        place = (mention.start, mention.end)
        return tuple(self._by_place.get(mention.path, {}).get(place, ()))

    def mentions_of_same(self, mention: Mention) -> tuple[Mention, ...]:
        """Return all mentions of one thing.

        Robots that have a part of one name are distinguished, unless a text names it without a
        robot, such as the joint of a controller: then it is one thing for all of them.
        """
        keys = {key_of(mention): None}
        waiting = [*keys]
        while waiting:
            for other in self._groups.get(waiting.pop(), ()):
                for twin in self.possible_mentions(other):
                    if twin.kind is mention.kind and key_of(twin) not in keys:
                        keys[key_of(twin)] = None
                        waiting.append(key_of(twin))
        return tuple(it for key in keys for it in self._groups.get(key, ()))

    def definitions(self, mention: Mention) -> tuple[Mention, ...]:
        """Return where the thing of a mention is made; also by a name that is composed."""
        written = tuple(it for it in self.mentions_of_same(mention) if it.is_definition)
        return written or tuple(self._composing(mention))

    def _composing(self, mention: Mention) -> Iterator[Mention]:
        for definition in self.composed_definitions(mention.kind):
            if definition.mention.scope == mention.scope and definition.may_be(mention.name):
                yield definition.mention

    def references(self, mention: Mention) -> tuple[Mention, ...]:
        """Return all mentions of the thing, its definitions among them, by file and place."""
        found = [*self.mentions_of_same(mention)]
        if not any(it.is_definition for it in found):
            found += self._composing(mention)
        elif is_composed(mention.name):
            found += self.mentions_from_composed(mention)
        return tuple(sorted(set(found), key=lambda it: (it.path, it.start, it.end)))

    def rename(self, mention: Mention, new: str) -> tuple[Edit, ...] | str:
        """Return the edits that give a thing another name, or why it cannot have it.

        Args:
            mention: Any of the thing.
            new: The new name of what is at the mention, which is that of the thing without
                the models around it; of a topic, without the model's name in front.
        """
        edits = rename_edits(self, mention, new)
        if isinstance(edits, str) or not edits:
            return edits
        named = next(self._in_siblings(mention), None)
        if named is None:
            return edits
        path, line = named
        return f"{path}:{line} in another package names the {mention.kind}, and would not change"

    def _in_siblings(self, mention: Mention) -> Iterator[tuple[str, int]]:
        """Yield where siblings that include the files of this package mention its thing."""
        own = {
            (it.kind, it.name, it.path) for it in self.mentions_of_same(mention) if it.is_definition
        }
        folder = f"../{self.package.root.name}/"
        for sibling in self.package.other_packages:
            if not _names_package(sibling, self.package):
                continue
            index = names_of(sibling)
            for it in index.mentions:
                path = it.path.removeprefix(folder)
                if path == it.path or (it.kind, it.name, path) not in own:
                    continue
                for other in index.mentions_of_same(it):
                    if not other.path.startswith("../"):
                        source = index.files[other.path].source
                        shown = f"../{sibling.root.name}/{other.path}"
                        yield shown, source.position(other.start)[0]

    def mentions_from_composed(self, mention: Mention) -> Iterator[Mention]:
        """Yield mentions by the names that are possible values of a composed one."""
        kind = mention.kind
        values = self.scopes.values.get(self.scopes.xacro.get(mention.path, ""), frozenset())
        for (other, scope, name), mentions in self._groups.items():
            if other is not kind or scope != mention.scope or is_composed(name):
                continue
            if any(it.is_definition for it in mentions):
                continue
            if may_come_to(mention.name, name, values):
                yield from mentions


def _names_package(sibling: Package, package: Package) -> bool:
    """Return whether any file of a package with names contains the name of another package."""
    wanted = {package.root.name, package.declared_name}
    files = [it.path for it in sibling.index.files if holds_names(it.path, it.size)]
    texts = (sibling.read(path) for path in files)
    return any(
        name in text.text for text in texts if isinstance(text, SourceText) for name in wanted
    )


def names_of(package: Package, known: NameIndex | None = None) -> NameIndex:
    """Return the names of a package.

    Args:
        package: The package to read.
        known: An earlier index; what it contains of a text is not read again.
    """
    earlier = known.files if known is not None else {}
    files: dict[str, FileNames] = {}
    for entry in package.index.files:
        if holds_names(entry.path, entry.size):
            _take(package, entry.path, earlier, files)
    for part in (package.model_path, *(package.part(path) for path in INHERITED)):
        if isinstance(part, Found) and part.is_inherited:
            _take(package, part.path, earlier, files)
    links = _follow(package, earlier, files)
    return NameIndex(package, files, links, scopes_of(package, files, links))


def _take(
    package: Package, path: str, earlier: Mapping[str, FileNames], files: dict[str, FileNames]
) -> None:
    source = package.read(path)
    if not isinstance(source, SourceText):
        return
    before = earlier.get(path)
    is_same = before is not None and before.source is source
    found = before if is_same else file_names(package, path, source)
    if found is not None and found.format != "other":
        files[path] = found


def _follow(
    package: Package, earlier: Mapping[str, FileNames], files: dict[str, FileNames]
) -> dict[str, tuple[str | None, ...]]:
    """Read the files of siblings that files include, and return what each file includes."""
    links: dict[str, tuple[str | None, ...]] = {}
    waiting = [*files]
    siblings = 0
    while waiting:
        path = waiting.pop()
        links[path] = tuple(included_path(package, path, it) for it in files[path].included)
        for target in links[path]:
            if target is None or target in files or not target.startswith("../"):
                continue
            siblings += 1
            if siblings <= SIBLING_FILES:
                _take(package, target, earlier, files)
                waiting += [target] if target in files else []
    return links
