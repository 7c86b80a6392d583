"""Properties that two included files set to different values: xacro has one for all files."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.formats.xacro.files import local_path, named_path, path_of
from checker.formats.xacro.names import EXPRESSION, names_in, parameters_of
from checker.package.package import Package
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument

_STEPS = 20_000
"""Elements of which one robot's files are followed."""
_DEEPEST = 30
_CONDITIONS = ("xacro:if", "xacro:unless")


class Setting(Record, eq=False):
    """A `<xacro:property>` at the top of a file.

    Attributes:
        value: The value as it is written.
        file: The file as xacro sees it.
    """

    value: Located[str]
    file: str


class SharedProperty(Record, eq=False):
    """A property that a macro reads with the value that another file sets.

    Attributes:
        name: The name of the property.
        own: The value that the macro's file sets.
        other: The value that counts when it is called.
        macro: Name of the macro.
    """

    name: str
    own: Setting
    other: Setting
    macro: str


class _Macro(Record, eq=False):
    element: Element
    file: str


class _Walk:
    """Follows a file and its includes in the order in which xacro expands them."""

    def __init__(self, package: Package) -> None:
        self._package = package
        self._current: dict[str, Setting] = {}
        self._own: dict[tuple[str, str], Setting] = {}
        self._unsure: set[str] = set()
        self._macros: dict[str, _Macro] = {}
        self._around: dict[str, set[str]] = {}
        self._documents: dict[str, XmlDocument] = {}
        self._left = _STEPS

    def file(self, path: str, around: Sequence[str], *, sure: bool) -> Iterator[SharedProperty]:
        """Follow a file.

        Args:
            path: The path as xacro sees it.
            around: The files that include it, from the outermost one.
            sure: Whether it is included for certain.
        """
        local = local_path(self._package, path)
        document = self._package.xml(local) if local is not None else None
        if not isinstance(document, XmlDocument) or path in around or len(around) > _DEEPEST:
            return
        self._documents[path] = document
        self._around.setdefault(path, set()).update(around)
        yield from self._elements(document.root.children, (*around, path), sure=sure)

    def _elements(
        self, elements: Sequence[Element], files: Sequence[str], *, sure: bool
    ) -> Iterator[SharedProperty]:
        for element in elements:
            self._left -= 1
            if self._left < 0:
                return
            name = (element.get("name") or "").strip()
            if element.tag == "xacro:property":
                self._set(name, element, files[-1], sure=sure)
            elif element.tag == "xacro:macro":
                self._macros[name.removeprefix("xacro:")] = _Macro(element, files[-1])
            elif element.tag == "xacro:include":
                named = named_path(posixpath.dirname(files[-1]), element.get("filename") or "")
                if named is not None and element.get("ns") is None:
                    yield from self.file(named, files, sure=sure)
            elif element.tag in _CONDITIONS:
                yield from self._elements(element.children, files, sure=False)
            elif element.tag.startswith("xacro:"):
                yield from self._called(element.tag.removeprefix("xacro:"), set())

    def _set(self, name: str, element: Element, file: str, *, sure: bool) -> None:
        value = element.attribute("value")
        if value is None or not sure or element.get("scope") is not None:
            self._unsure.add(name)
            return
        self._current[name] = self._own[file, name] = Setting(value, file)

    def _called(self, name: str, met: set[str]) -> Iterator[SharedProperty]:
        """Yield what a macro, and those that it calls, reads of other files."""
        macro = self._macros.get(name)
        if macro is None or name in met or self._left < 0:
            return
        met.add(name)
        inside = [*macro.element.descendants()]
        self._left -= len(inside)
        local = {it.get("name") or "" for it in inside if it.tag == "xacro:property"}
        local.update(it.name for it in parameters_of(macro.element.get("params") or ""))
        for read in _names(inside) - local:
            own, other = self._own.get((macro.file, read)), self._current.get(read)
            if own is not None and other is not None and self._clash(read, own, other):
                yield SharedProperty(read, own, other, name)
        for element in inside:
            if element.tag.startswith("xacro:"):
                yield from self._called(element.tag.removeprefix("xacro:"), met)

    def _clash(self, name: str, own: Setting, other: Setting) -> bool:
        """Return whether a value differs from that of another file, and both need their own."""
        related = other.file in self._around[own.file] or own.file in self._around[other.file]
        written = "$" not in own.value.value + other.value.value
        differ = own.value.value.strip() != other.value.value.strip()
        if related or name in self._unsure or not (written and differ) or own.file == other.file:
            return False
        return name in _names(self._documents[other.file].elements)


def _names(elements: Sequence[Element]) -> set[str]:
    """Return the names in the expressions of some elements."""
    texts = (text for it in elements for text in (*it.attributes.values(), it.value))
    expressions = (it for text in texts for it in EXPRESSION.findall(text))
    return {name for expression in expressions for name in names_in(expression)}


def shared_properties(package: Package, file: str) -> Iterator[SharedProperty]:
    """Yield the properties of included files that other included files change, each once.

    Args:
        package: The package being checked.
        file: The file that makes the robot, as the package lists it.
    """
    met: set[tuple[str, str]] = set()
    for shared in _Walk(package).file(path_of(package, file), (), sure=True):
        if (shared.name, shared.macro) not in met:
            met.add((shared.name, shared.macro))
            yield shared
