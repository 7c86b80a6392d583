"""Files as xacro sees them: below a made-up folder, `<ROOT>/<package>/<path>`.

The texts that it needs to expand files, their includes, are found without running it.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from checker.base.files import NotReadable
from checker.package.installed import source_of
from checker.source.text import SourceText
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

if TYPE_CHECKING:
    from checker.package.package import Package

ROOT = "/subt-check-packages"
_FOUND = re.compile(rf"{ROOT}/([\w.-]{{1,200}})")


def path_of(package: Package, path: str) -> str:
    """Return how xacro sees a file of a package.

    Args:
        package: The package being checked.
        path: The path as it lists the file; `../other/…` is a sibling's.
    """
    return posixpath.normpath(f"{ROOT}/{package.root.name}/{path}")


def package_in(path: str) -> str:
    """Return the name of the package in a path that xacro sees; empty outside all of them."""
    if not path.startswith(f"{ROOT}/"):
        return ""
    return posixpath.normpath(path).removeprefix(f"{ROOT}/").partition("/")[0]


def as_written(text: str) -> str:
    """Return a text for people, with `$(find p)` for the folder that xacro sees."""
    return _FOUND.sub(r"$(find \1)", text) if ROOT in text else text


def local_path(package: Package, path: str) -> str | None:
    """Return a path that xacro sees as the package lists it; None if no package has it.

    Where the source has no such file, it is the one that CMake installs there.
    """
    name = package_in(path)
    rest = posixpath.normpath(path).removeprefix(f"{ROOT}/{name}").lstrip("/")
    if not name:
        return None
    holder = package.named(name)
    if holder is None:
        # A launch file outside of packages takes files by its own path: `../urdf/arm.urdf`.
        beside = f"../{name}/{rest}"
        return beside if package.is_loose and package.exists(beside) else None
    if not holder.exists(rest):
        rest = source_of(holder, rest) or rest
    return rest if holder is package else f"../{holder.name}/{rest}"


FILES_LIMIT = 400
SIZE_LIMIT = 20_000_000
"""Characters of all texts together."""
_SUFFIXES = (".xacro", ".urdf", ".xml", ".yaml", ".yml")
_FIND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)")
_YAML = re.compile(r"""load_yaml\(\s{0,8}(?:'([^'"]{1,500})'|"([^'"]{1,500})"|([^)]{0,500}))""")
_COMPUTED = re.compile(r"\$[{(]|[*?\[]")


def named_path(folder: str, name: str) -> str | None:
    """Return how xacro sees a file that another one names; None if its name is computed.

    Args:
        folder: The folder of the other file, as xacro sees it.
        name: The name as it is written.
    """
    spelled = _FIND.sub(lambda match: f"{ROOT}/{match[1]}", name)
    if _COMPUTED.search(spelled) or "." not in spelled:
        return None
    return posixpath.normpath(posixpath.join(folder, spelled))


@dataclass(eq=False)
class Gathered:
    """Texts by the paths under which xacro sees them; it grows while they are followed.

    Attributes:
        package: The package being checked.
        sources: The texts.
        documents: The documents that are XML.
        faults: The faults of those that are not well-formed XML.
        absent: Paths at which there is no file.
        beyond: Names of packages that are not available.
    """

    package: Package
    sources: dict[str, SourceText] = field(default_factory=dict)
    documents: dict[str, XmlDocument] = field(default_factory=dict)
    faults: dict[str, XmlFault] = field(default_factory=dict)
    absent: set[str] = field(default_factory=set)
    beyond: set[str] = field(default_factory=set)
    _size: int = 0

    @property
    def request(self) -> dict[str, Any]:
        """Description of the files for the child process."""
        texts = {
            path: source.text for path, source in self.sources.items() if path not in self.faults
        }
        faulty = {path: fault.message for path, fault in self.faults.items()}
        others = {"absent": sorted(self.absent), "beyond": sorted(self.beyond)}
        return {"texts": texts, "faulty": faulty, **others}

    def follow(self, paths: Iterable[str]) -> None:
        """Take up files, and all that they include by a name that is no expression."""
        waiting = [*paths]
        while waiting and len(self.sources) < FILES_LIMIT and self._size < SIZE_LIMIT:
            path = posixpath.normpath(waiting.pop())
            if path not in self.sources and path not in self.absent:
                waiting += self._take(path)

    def _take(self, path: str) -> Iterator[str]:
        """Read one file; yield what it includes."""
        local = local_path(self.package, path)
        source = self.package.read(local) if local is not None else None
        if local is None or source is None or isinstance(source, NotReadable):
            self._miss(path)
            return
        self.sources[path] = source
        self._size += len(source.text)
        if posixpath.splitext(path)[1].lower() in (".yaml", ".yml"):
            return
        document = self.package.xml(local)
        if isinstance(document, XmlDocument):
            if document.tolerated:
                self.faults[path] = document.tolerated[0]
                return
            self.documents[path] = document
            yield from self._named_in(path, document)
        elif isinstance(document, XmlFault):
            self.faults[path] = document

    def _miss(self, path: str) -> None:
        name = package_in(path)
        if name in ("", self.package.root.name) or self.package.workspace.package(name):
            self.absent.add(path)
        else:
            self.beyond.add(name)

    def _named_in(self, path: str, document: XmlDocument) -> Iterator[str]:
        folder = posixpath.dirname(path)
        if "load_yaml" not in document.source.text and "include" not in document.source.text:
            return
        yaml = ("".join(filter(None, groups)) for groups in _YAML.findall(document.source.text))
        included = (
            element.get("filename") or ""
            for element in document.elements
            if element.tag == "xacro:include"
        )
        for name in (*yaml, *included):
            named = named_path(folder, name)
            yield from self._all_candidates() if named is None else (named,)

    def _all_candidates(self) -> Iterator[str]:
        """Yield every file of the package that could be meant, also by `$(find)` of its name."""
        folders = dict.fromkeys((self.package.root.name, self.package.declared_name))
        for file in self.package.index.with_suffix(*_SUFFIXES):
            if file.is_file:
                yield from (f"{ROOT}/{folder}/{file.path}" for folder in folders)
