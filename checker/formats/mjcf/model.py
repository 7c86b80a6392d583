"""A model of MuJoCo: its elements with those that it includes, and the files that it names.

MuJoCo states no file for a fault, and no line in an included one. So includes are expanded here,
and MuJoCo gets one text in which each element begins on a line of its own.
"""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from functools import cached_property

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.package.package import Package
from checker.source.text import Located
from checker.source.xml import MAX_DEPTH, Element, XmlDocument
from checker.source.xml_positions import XmlFault

_FOLDER = {
    "mesh": "meshdir",
    "hfield": "meshdir",
    "skin": "meshdir",
    "flexcomp": "meshdir",
    "texture": "texturedir",
}
"""The attribute of `<compiler>` that names the folder of the files of an element."""
_FILE_ATTRIBUTES = (
    *("file", "fileright", "fileleft", "fileup", "filedown", "filefront", "fileback"),
)
_OF_PARTS = ("default", "config")
"""Elements in which `file` names nothing that the model loads."""


class NamedFile(Record, eq=False):
    """A file that an element of a model names.

    Attributes:
        element: The element.
        uri: What it states.
        base: The folder from which MuJoCo takes the path first, relative to the package.
        tried: The paths that it tries, in order.
        path: The first of these that is there; empty if none is.
    """

    element: Element
    uri: Located[str]
    base: str
    tried: tuple[str, ...]
    path: str

    @property
    def attribute(self) -> str:
        """Name of the attribute that states it; the name of an asset may be the same text."""
        stated = [it for it, value in self.element.attributes.items() if value == self.uri.value]
        return next((it for it in stated if it in _FILE_ATTRIBUTES), stated[0])


class MjcfModel(Record, eq=False, dict=True):
    """A model as MuJoCo reads it.

    Attributes:
        package: The package that contains it.
        document: The file that is given to MuJoCo.
        elements: All elements with those of included files, in the order in which MuJoCo reads
            them; `<include>` itself and the roots of included files are left out.
        parents: The parent of each element in this order, by its number; the root has none.
        included: The included files.
        broken: Included files that are not well-formed XML, and includes that nest too deeply.
        repeated: Includes of a file that was included before, which MuJoCo refuses.
        missing: Includes whose file is not there.
    """

    package: Package
    document: XmlDocument
    elements: tuple[Element, ...]
    parents: tuple[int, ...]
    included: tuple[str, ...] = ()
    broken: tuple[XmlFault, ...] = ()
    repeated: tuple[Element, ...] = ()
    missing: tuple[NamedFile, ...] = ()

    @property
    def file(self) -> str:
        """Path of the file that is given to MuJoCo."""
        return self.document.source.file

    @property
    def is_whole(self) -> bool:
        """True if all includes are there."""
        return not (self.missing or self.broken or self.repeated)

    @cached_property
    def compiler(self) -> dict[str, Located[str]]:
        """The attributes of `<compiler>`; of several such elements the last one counts."""
        return {
            name: value
            for element in self.tagged("compiler")
            for name in element.attributes
            if (value := element.attribute(name)) is not None
        }

    @property
    def in_radians(self) -> bool:
        """True if angles are given in radians."""
        angle = self.compiler.get("angle")
        return angle is not None and angle.value == "radian"

    def tagged(self, *tags: str) -> Iterator[Element]:
        """Yield the elements of some names."""
        return (element for element in self.elements if element.tag in tags)

    def is_class(self, number: int) -> bool:
        """Return whether an element is in `<default>`: values for others."""
        while (number := self.parents[number]) >= 0:
            if self.elements[number].tag == "default":
                return True
        return False

    @cached_property
    def files(self) -> tuple[NamedFile, ...]:
        """Meshes, textures and other files that the model names, in its order."""
        return tuple(
            self._named(element, uri)
            for number, element in enumerate(self.elements)
            if not self._is_part(number)
            for name in _FILE_ATTRIBUTES
            if (uri := element.attribute(name)) is not None and uri.value
        )

    def _is_part(self, number: int) -> bool:
        return self.elements[number].tag in _OF_PARTS or self.is_class(number)

    def _named(self, element: Element, uri: Located[str]) -> NamedFile:
        name = uri.value.replace("\\", "/")
        if self._compiled("strippath") == "true":
            name = posixpath.basename(name)
        own, including = map(posixpath.dirname, (self.file, element.source.file))
        bases = posixpath.join(own, self.folder_of(element)), including
        return named_file(self.package, element, uri, bases, name)

    def folder_of(self, element: Element) -> str:
        """Return the folder that `<compiler>` states for the files of an element."""
        kind = _FOLDER.get(element.tag, "assetdir")
        return self._compiled(kind) or self._compiled("assetdir")

    def _compiled(self, name: str) -> str:
        value = self.compiler.get(name)
        return value.value if value is not None else ""


def named_file(
    package: Package, element: Element, uri: Located[str], bases: tuple[str, ...], name: str
) -> NamedFile:
    """Return a file that an element names, with the first path at which it is.

    Args:
        package: The package that contains the model.
        element: The element that names it.
        uri: What it states.
        bases: The folders from which the path is taken, in order.
        name: The path that counts.
    """
    tried = (posixpath.join(base, name) for base in bases)
    paths = tuple(dict.fromkeys(map(posixpath.normpath, tried)))
    found = (path for path in paths if (at := package.resolve(path)) is not None and at.is_file)
    return NamedFile(element, uri, posixpath.normpath(bases[0]), paths, next(found, ""))


class _Reader:
    """Expands the includes of a model."""

    def __init__(self, package: Package, document: XmlDocument) -> None:
        self.package, self.folder = package, posixpath.dirname(document.source.file)
        self.elements: list[Element] = []
        self.parents: list[int] = []
        self.seen = {document.source.file}
        self.broken: list[XmlFault] = []
        self.repeated: list[Element] = []
        self.missing: list[NamedFile] = []

    def add(self, element: Element, parent: int, depth: int = 0) -> None:
        """Add an element and all below it."""
        if element.tag == "include":
            self._include(element, parent, depth)
            return
        number = len(self.elements)
        self.elements.append(element)
        self.parents.append(parent)
        for child in element.children:
            self.add(child, number, depth + 1)

    def _include(self, element: Element, parent: int, depth: int) -> None:
        uri = element.attribute("file")
        if uri is None:
            return
        if depth > MAX_DEPTH:
            self.broken.append(XmlFault(element.span, "elements nest too deeply"))
            return
        folders = (self.folder, posixpath.dirname(element.source.file))
        named = named_file(self.package, element, uri, folders, uri.value)
        if named.path in self.seen:
            self.repeated.append(element)
            return
        document = self.package.xml(named.path) if named.path else None
        if isinstance(document, XmlDocument):
            self.seen.add(named.path)
            for child in document.root.children:
                self.add(child, parent, depth)
        elif isinstance(document, XmlFault):
            self.broken.append(document)
        else:
            self.missing.append(named)


def read_model(package: Package, path: str) -> MjcfModel | XmlFault | NotReadable:
    """Read a model and what it includes.

    Args:
        package: The package that contains the file.
        path: The file that is given to MuJoCo.
    """
    document = package.xml(path)
    if not isinstance(document, XmlDocument):
        return document
    reader = _Reader(package, document)
    reader.add(document.root, -1)
    return MjcfModel(
        package,
        document,
        tuple(reader.elements),
        tuple(reader.parents),
        tuple(sorted(reader.seen - {document.source.file})),
        tuple(reader.broken),
        tuple(reader.repeated),
        tuple(reader.missing),
    )
