"""Which files of a package are its URDF descriptions."""

from __future__ import annotations

import posixpath
from collections.abc import Iterable, Iterator, Mapping

from msgspec import field

from checker.base.record import Record
from checker.expand.xacro.description_loads import Load
from checker.expand.xacro.paths import local_path
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

_SUFFIXES = (".urdf", ".xacro")
FOLDER_BESIDE_SDF = "urdf/"
CANDIDATES_LIMIT = 50


class Candidate(Record):
    """A file that ought to hold a robot.

    Attributes:
        path: As the package lists it.
        args: Arguments for xacro.
        loaded: Whether a launch file loads it.
        by_xacro: Whether xacro reads it, whatever it holds.
    """

    path: str
    args: Mapping[str, str] = field(default_factory=dict)
    loaded: bool = False
    by_xacro: bool = False


def may_hold_description(package: Package) -> bool:
    """Say whether a package holds a file that could be a URDF description."""
    return bool(_files(package))


def candidates(package: Package, loads: Iterable[Load]) -> list[Candidate]:
    """Return the files that launch files load; without any, those that stand for a robot.

    Args:
        package: To look into.
        loads: What its launch files load.
    """
    if package.only:
        return [Candidate(package.only)]
    chosen: dict[str, Candidate] = {}
    for load in loads:
        path = local_path(package, load.path)
        # What nobody has is a fault of the launch file; a sibling's is the sibling's own.
        if path is not None and not path.startswith("../") and package.exists(path):
            chosen.setdefault(path, Candidate(path, load.args, True, load.by_xacro))
    found = [*chosen.values()] or [Candidate(path) for path in _outermost(package)]
    return found[:CANDIDATES_LIMIT]


def _files(package: Package) -> list[str]:
    if package.only:
        return [package.only] if package.only.lower().endswith((*_SUFFIXES, ".xml")) else []
    paths = (file.path for file in package.index.with_suffix(*_SUFFIXES))
    if package.kind is PackageKind.URDF_DESCRIPTION:
        return [*paths]
    return [path for path in paths if path.startswith(FOLDER_BESIDE_SDF)]


def _outermost(package: Package) -> Iterator[str]:
    """Yield the files that call themselves a robot and that no other file includes."""
    paths = [path for path in _files(package) if not _is_empty(package, path)]
    documents = {path: package.xml(path) for path in paths}
    roots = {path: each.root for path, each in documents.items() if isinstance(each, XmlDocument)}
    included = {
        posixpath.basename(each.get("filename") or "")
        for path, root in roots.items()
        for each in root.descendants("xacro:include")
        if posixpath.basename(each.get("filename") or "") != posixpath.basename(path)
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
    """Say whether a file holds nothing; one that nobody loads is only a leftover."""
    source = package.read(path)
    return isinstance(source, SourceText) and not source.text.strip()
