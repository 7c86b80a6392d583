"""Files of a package that are its URDF descriptions, and files that may be and are not read."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from itertools import islice

from msgspec import field
from msgspec.structs import replace

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.formats.xacro.files import local_path
from checker.launch.ros1.launch_file import Load
from checker.package.kind import PackageKind, enclosing_package
from checker.package.package import Package
from checker.robots.leftovers import is_of_page
from checker.source.text import SourceText, without_comments
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

_SUFFIXES = (".urdf", ".xacro")
_OF_MOVEIT = (".srdf", ".srdf.xacro")
FOLDER_BESIDE_SDF = "urdf/"
CANDIDATES_LIMIT = 50
_MOVES = re.compile(r"""\btype\s{0,8}=\s{0,8}["'](?:continuous|prismatic|revolute)["']""")
_LEVELS = 6
"""Folders between a file and the package or model that it is in."""


class Candidate(Record):
    """A file that should contain a robot.

    Attributes:
        path: The path as the package lists it.
        args: Arguments for xacro.
        loaded: Whether a launch file loads it.
        by_xacro: Whether xacro reads it, whatever it contains.
        missing: Arguments that a launch file leaves to the user, and that launch file.
        choices: The values that it allows for these, where it names them.
        offered: The values that it allows for arguments to which it gives one of them.
        given: Arguments of each launch file that loads it, where all of them are known.
        spawned: Whether the launch file whose arguments these are spawns a robot.
        shown: As `given`, of launch files that spawn nothing beside those that spawn.
        misplaced: Whether a launch file names it by the path of another folder; others load robots.
        as_it_is: Whether all launch files that load it load its text, without xacro.
    """

    path: str
    args: Mapping[str, str] = field(default_factory=dict)
    loaded: bool = False
    by_xacro: bool = False
    missing: Mapping[str, str] = field(default_factory=dict)
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    offered: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    given: tuple[Mapping[str, str], ...] = ()
    spawned: bool = False
    shown: tuple[Mapping[str, str], ...] = ()
    misplaced: bool = False
    as_it_is: bool = False

    def assumed_values(self, number: int, given: Collection[str]) -> dict[str, str]:
        """Return the values of arguments that are not given.

        Args:
            number: The number of the choice, the first one being 0; of fewer choices the last one.
            given: Names of the arguments that are given.
        """
        return {
            name: values[min(number, len(values) - 1)]
            for name, values in self.choices.items()
            if name not in given
        }


class StartedLoad(Record):
    """File that a launch file loads; see `Candidate`.

    Attributes:
        counts: Whether the launch file can run: one of ROS 1 in a package of ROS 2 cannot.
        spawned: Whether the launch file spawns a robot in a simulator.
        misplaced: Whether the launch file names it by the path of another folder.
    """

    load: Load
    counts: bool = True
    missing: Mapping[str, str] = field(default_factory=dict)
    choices: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    offered: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    spawned: bool = False
    misplaced: bool = False


def may_hold_description(package: Package) -> bool:
    """Return whether a package contains a file that could be a URDF description."""
    return bool(_files(package))


def candidates(package: Package, loads: Iterable[StartedLoad]) -> list[Candidate]:
    """Return the files that launch files load, and those that represent a robot.

    Beside an SDF model these count only where no launch file loads any.

    Args:
        package: The package to look into.
        loads: What its launch files load.
    """
    if package.only:
        return [Candidate(package.only)]
    chosen: dict[str, Candidate] = {}
    for started in loads:
        load, missing = started.load, started.missing
        path = local_path(package, load.path)
        # A missing file is a fault of the launch file; a sibling's is the sibling's own.
        if path is not None and not path.startswith("../") and package.exists(path):
            allowed = started.choices, started.offered
            counts, by_xacro = started.counts, load.by_xacro
            given = (load.args,) if counts and not missing else ()
            candidate = Candidate(
                *(path, load.args, counts, by_xacro, missing, *allowed, given, started.spawned),
                misplaced=started.misplaced,
                as_it_is=load.as_it_is,
            )
            before = chosen.get(path, candidate)
            misplaced = before.misplaced and started.misplaced
            as_it_is = before.as_it_is and load.as_it_is
            if before.spawned and not started.spawned:
                shown = before.shown + given
                chosen[path] = replace(before, shown=shown, misplaced=misplaced, as_it_is=as_it_is)
                continue
            every = before.given if given and load.args in before.given else before.given + given
            # Of several ways to start it, one that is known counts before one that is not.
            known = before.missing and not missing
            runs = candidate.loaded and not before.loaded
            taken = candidate if known or runs else before
            loaded = before.loaded or candidate.loaded
            chosen[path] = replace(
                taken, loaded=loaded, given=every, misplaced=misplaced, as_it_is=as_it_is
            )
    chosen = _with_rightly_named(chosen)
    if not chosen or package.kind is PackageKind.URDF_DESCRIPTION:
        others = [path for path in _outermost(package) if path not in chosen]
        own = [path for path in others if not _is_of_package_within(package, path)]
        # A package all of whose files are those of models within shows these.
        chosen |= {path: Candidate(path) for path in own or ([] if chosen else others)}
    if not chosen and package.kind is PackageKind.URDF_DESCRIPTION:
        chosen = {path: Candidate(path) for path in _made_of(package)}
    return [*chosen.values()]


def _with_rightly_named(chosen: dict[str, Candidate]) -> dict[str, Candidate]:
    """Return candidates; misplaced ones are not loaded beside one that is where it is named."""
    if not any(it.loaded and not it.misplaced for it in chosen.values()):
        return {path: replace(it, misplaced=False) for path, it in chosen.items()}
    return {path: replace(it, loaded=it.loaded and not it.misplaced) for path, it in chosen.items()}


def most_likely(
    package: Package, found: list[Candidate]
) -> tuple[list[Candidate], list[Candidate]]:
    """Return the files to read, at most `CANDIDATES_LIMIT`, and the others.

    Of more files those that are loaded come first, then those with joints that move: a folder of
    objects may lie beside a robot.
    """
    if len(found) <= CANDIDATES_LIMIT:
        return found, []
    ranked = sorted(
        found, key=lambda it: (not it.loaded, not _MOVES.search(_text(package, it.path)))
    )
    kept = {it.path for it in ranked[:CANDIDATES_LIMIT]}
    return (
        [it for it in found if it.path in kept],
        [it for it in found if it.path not in kept],
    )


def _files(package: Package) -> list[str]:
    if package.only:
        named = package.only.lower().endswith((*_SUFFIXES, ".xml"))
        return [package.only] if named or _root_tag(package, package.only) == "robot" else []
    files = (it for it in package.index.with_suffix(*_SUFFIXES) if not it.is_broken_for_tests)
    paths = (file.path for file in files if not file.path.lower().endswith(_OF_MOVEIT))
    if package.is_loose:
        return [path for path in paths if not package.lies_in_unit(path)]
    if package.kind is PackageKind.URDF_DESCRIPTION:
        return [path for path in paths if not is_of_page(package, path)]
    return [path for path in paths if path.startswith(FOLDER_BESIDE_SDF)]


def _root_tag(package: Package, path: str) -> str:
    document = package.xml(path)
    return document.root.tag if isinstance(document, XmlDocument) else ""


def _is_of_package_within(package: Package, path: str) -> bool:
    """Return whether a package or model within, all in URDF, has the file: it is judged there."""
    if not package.lies_in_unit(path):
        return False
    folder = enclosing_package((package.root / path).parent, _LEVELS)
    if folder is None or folder == package.root:
        return False
    return package.workspace.at(folder).kind is PackageKind.URDF_DESCRIPTION


def _outermost(package: Package) -> Iterator[str]:
    """Yield the files that call themselves a robot and that no other file includes."""
    paths = [path for path in _files(package) if not _is_empty(package, path)]
    documents = {path: package.xml(path) for path in paths}
    roots = {
        path: document.root
        for path, document in documents.items()
        if isinstance(document, XmlDocument)
    }
    included = {
        posixpath.basename(descendant.get("filename") or "")
        for path, root in roots.items()
        for descendant in root.descendants("xacro:include")
        if posixpath.basename(descendant.get("filename") or "") != posixpath.basename(path)
    }
    outermost = [path for path in paths if posixpath.basename(path) not in included]
    # Files that include one another in a circle leave none.
    for path in outermost or paths:
        document, root = documents[path], roots.get(path)
        named = root is not None and root.tag == "robot" and root.get("name")
        alone = len(paths) == 1 and (root is None or root.tag == "robot")
        if named or (alone and isinstance(document, XmlDocument | XmlFault)):
            yield path


def _is_empty(package: Package, path: str) -> bool:
    """Return whether a file contains nothing; one that is never loaded is only a leftover."""
    source = package.read(path)
    return isinstance(source, SourceText) and not source.text.strip()


_INCLUDING_LIMIT = 400
"""Xacro files of other packages that are searched for includes."""
_INCLUDED = re.compile(r"""filename\s{0,8}=\s{0,8}["'][^"'<>\n]{0,300}?([\w.-]{1,100})["']""")
_PARTS = ("link", "joint", "xacro:macro")


def unreadable_models(package: Package, seen: frozenset[str]) -> Iterator[str]:
    """Yield why files cannot be read, each the end of a sentence.

    Args:
        package: The package to look into.
        seen: Files that were read, or are parts of what was.
    """
    for path in _files(package):
        if path not in seen and isinstance(source := package.read(path), NotReadable):
            yield f"{path} {source.reason}"


def misnamed_models(package: Package) -> Iterator[str]:
    """Yield why files named as URDF are not read, each the end of a sentence: they are SDF."""
    for path in _files(package) if not package.only else ():
        if path.lower().endswith(".urdf") and _root_tag(package, path) == "sdf":
            yield f"{path} is SDF by its root element, and is not read: name it .sdf"


def unused_parts(package: Package, seen: frozenset[str]) -> Iterator[str]:
    """Yield the files that contain links, joints or macros and are part of no robot.

    Args:
        package: The package to look into.
        seen: Files that were read, or are parts of what was.
    """
    left = [
        path
        for path in _files(package)
        if path not in seen
        and _holds_parts(package, path)
        and not _is_of_package_within(package, path)
    ]
    if not left:
        return
    elsewhere = _with_their_parts(package, left, set(_included_elsewhere(package)))
    yield from (path for path in left if posixpath.basename(path) not in elsewhere)


def _made_of(package: Package) -> Iterator[str]:
    """Yield the robots of sibling packages that include files of a package of macros alone."""
    own = {posixpath.basename(path) for path in _files(package) if _holds_parts(package, path)}
    for other, path in _xacro_elsewhere(package) if own else ():
        text = _text(other, path)
        if package.root.name in text and not own.isdisjoint(_INCLUDED.findall(text)):
            document = other.xml(path)
            root = document.root if isinstance(document, XmlDocument) else None
            if root is not None and root.tag == "robot" and root.get("name"):
                yield f"../{other.name}/{path}"


def is_included(package: Package, path: str) -> bool:
    """Return whether a file of this or another package includes a file, by any kind of name."""
    return any(including(package, path))


def is_named_by_include(package: Package, path: str) -> bool:
    """Return the same, where comments and whole names of other files do not count."""
    name = posixpath.basename(path)
    others = {posixpath.basename(other) for other in _files(package)} - {name}
    texts = (without_comments(it.file, it.text) for it in including(package, path))
    names = (it for text in texts for it in _INCLUDED.findall(text) if name.endswith(it))
    return any(it not in others for it in names)


def including(package: Package, path: str) -> Iterator[SourceText]:
    """Yield the files of this and other packages that include a file, by any kind of name."""
    name = posixpath.basename(path)
    own = ((package, other) for other in _files(package) if other != path)
    for holder, other in (*own, *_xacro_elsewhere(package)):
        source = holder.read(other)
        # Of a computed name, such as `${kind}_arm.xacro`, the end is what was found.
        if isinstance(source, SourceText) and any(
            map(name.endswith, _INCLUDED.findall(source.text))
        ):
            yield source


def _holds_parts(package: Package, path: str) -> bool:
    document = package.xml(path)
    if not isinstance(document, XmlDocument) or document.root.tag != "robot":
        return False
    return any(next(document.root.descendants(tag), None) is not None for tag in _PARTS)


def _with_their_parts(package: Package, paths: list[str], names: set[str]) -> set[str]:
    """Return names of files with those that such files of the package include, and so on."""
    included = {path: _INCLUDED.findall(_text(package, path)) for path in paths}
    for _ in paths:
        found = {
            name
            for path, parts in included.items()
            if posixpath.basename(path) in names
            for name in parts
        }
        if found <= names:
            break
        names |= found
    return names


def _text(package: Package, path: str) -> str:
    source = package.read(path)
    return source.text if isinstance(source, SourceText) else ""


def _included_elsewhere(package: Package) -> Iterator[str]:
    """Yield the names of the files that the xacro files of other packages include."""
    for other, path in _xacro_elsewhere(package):
        yield from _INCLUDED.findall(_text(other, path))


def _xacro_elsewhere(package: Package) -> Iterator[tuple[Package, str]]:
    files = (
        (other, file.path)
        for other in package.workspace.packages.values()
        if other is not package
        for file in other.index.with_suffix(".xacro")
    )
    return islice(files, _INCLUDING_LIMIT)
