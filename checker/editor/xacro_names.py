"""Names that xacro files define: macros with their parameters, properties and arguments."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from checker.base.record import Record
from checker.formats.xacro.files import Gathered, path_of
from checker.formats.xacro.names import MacroParameter, parameters_of
from checker.package.package import Package
from checker.source.xml import Element, XmlDocument

PREFIX = "xacro:"
TAGS = (
    *("arg", "attribute", "call", "element", "if", "include", "insert_block", "macro"),
    *("property", "unless"),
)
"""xacro's own tags, without the prefix."""
_SUFFIXES = (".xacro", ".urdf", ".xml")


class Macro(Record, eq=False):
    """A macro and where it is defined."""

    name: str
    parameters: tuple[MacroParameter, ...]
    element: Element


class Property(Record, eq=False):
    """A property: its value as written, empty for a block of elements."""

    name: str
    value: str
    element: Element


class Argument(Record, eq=False):
    """An argument: its default as written, None without one."""

    name: str
    default: str | None
    element: Element


class XacroNames(Record, eq=False, dict=True):
    """Names that a file and those around it define; its own first, then those it includes.

    Attributes:
        documents: The files, the likeliest first.
    """

    documents: tuple[XmlDocument, ...]

    @cached_property
    def macros(self) -> Mapping[str, Macro]:
        """Macros by name, without the prefix."""
        macros: dict[str, Macro] = {}
        for element in self._all("macro"):
            name = (element.get("name") or "").removeprefix(PREFIX)
            macros.setdefault(
                name, Macro(name, parameters_of(element.get("params") or ""), element)
            )
        return macros

    @cached_property
    def properties(self) -> Mapping[str, Property]:
        """Properties by name; of two, the first."""
        found: dict[str, Property] = {}
        for element in self._all("property"):
            name = element.get("name") or ""
            value = element.get("value") or element.get("default") or ""
            found.setdefault(name, Property(name, value, element))
        return found

    @cached_property
    def arguments(self) -> Mapping[str, Argument]:
        """Arguments by name; of two, the first."""
        found: dict[str, Argument] = {}
        for element in self._all("arg"):
            name = element.get("name") or ""
            found.setdefault(name, Argument(name, element.get("default"), element))
        return found

    def _all(self, tag: str) -> Iterator[Element]:
        for document in self.documents:
            if PREFIX in document.source.text:
                yield from (it for it in document.elements if it.tag == PREFIX + tag)


def xacro_names(package: Package, path: str) -> XacroNames:
    """Return what a file can use.

    Args:
        package: The package of the file.
        path: The path of the file. What it includes counts, and all other xacro files of the
            package: one that includes this file may define what it uses.
    """
    gathered = Gathered(package)
    gathered.follow([path_of(package, path)])
    others = (entry.path for entry in package.index.with_suffix(*_SUFFIXES) if entry.is_file)
    gathered.follow([path_of(package, other) for other in others])
    return XacroNames(tuple(gathered.documents.values()))


def macro_around(element: Element) -> Macro | None:
    """Return the macro that an element is written in; None outside of all."""
    at: Element | None = element
    while at is not None and at.tag != f"{PREFIX}macro":
        at = at.parent
    return (
        None
        if at is None
        else Macro(at.get("name") or "", parameters_of(at.get("params") or ""), at)
    )
