"""The paperwork of a package: package.xml, model.config, CMakeLists.txt, each where it is there."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cached_property

from checker.base.files import NotReadable
from checker.base.parts import part
from checker.base.record import Record
from checker.package.package import Package
from checker.source.cmake import CMakeFile
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument
from checker.source.xml_positions import XmlFault

# package.xml and model.config: what a package says of itself, every value with its place.


DEPENDENCY_TAGS = (
    *("depend", "build_depend", "build_export_depend", "buildtool_depend"),
    *("buildtool_export_depend", "exec_depend", "run_depend", "test_depend", "doc_depend"),
)


class Person(Record, eq=False):
    """A maintainer or author; missing values are empty and placed at the person's tag."""

    name: Located[str]
    email: Located[str]
    span: Span


class Dependency(Record, eq=False):
    """A dependency.

    Attributes:
        kind: Name of its tag: `exec_depend`.
        package: What is needed: a package, or a key of rosdep.
        is_conditional: Whether it counts only under a condition, such as a ROS version.
    """

    kind: str
    package: Located[str]
    is_conditional: bool = False

    @property
    def at_run_time(self) -> bool:
        """True if the package is available when the robot runs."""
        return self.kind in {"depend", "exec_depend", "run_depend"}


class PackageManifest(Record, eq=False):
    """A package.xml. A text whose tag is missing is empty, not stated, and placed at the root.

    Attributes:
        format: `format` of the root: 1 when it is absent; None if it is not a number.
        name: Name of the package.
        version: Version.
        description: Text of the description, tags within it left out.
        maintainers: Maintainers.
        authors: Authors.
        licenses: Licenses.
        dependencies: All dependencies, in order.
        build_type: `export/build_type`; empty, thus catkin, when absent.
        urls: Links to pages about the package.
        span: The root's start tag.
    """

    format: Located[int | None]
    name: Located[str]
    version: Located[str]
    description: Located[str]
    maintainers: tuple[Person, ...]
    authors: tuple[Person, ...]
    licenses: tuple[Located[str], ...]
    dependencies: tuple[Dependency, ...]
    build_type: Located[str]
    urls: tuple[Located[str], ...]
    span: Span

    def depends_on(self, package: str) -> bool:
        """Return whether any dependency names the package."""
        return any(dependency.package.value == package for dependency in self.dependencies)


class SdfEntry(Record, eq=False):
    """An `<sdf>` of model.config: the file, and the SDF version it is said to have.

    `version` is not stated when the attribute is missing.
    """

    file: Located[str]
    version: Located[str]


class ModelConfig(Record, eq=False):
    """A model.config. A text whose tag is missing is empty, not stated, and placed at the root.

    Attributes:
        name: Name of the model.
        version: Version of the model.
        sdf: The model files, in order.
        authors: Authors.
        description: Description.
        depends: URIs of the models that it needs.
        span: The root's start tag.
    """

    name: Located[str]
    version: Located[str]
    sdf: tuple[SdfEntry, ...]
    authors: tuple[Person, ...]
    description: Located[str]
    depends: tuple[Located[str], ...]
    span: Span


def read_package_xml(document: XmlDocument) -> PackageManifest:
    """Read a package.xml."""
    root = document.root
    return PackageManifest(
        format=_format(root),
        name=_text(root, "name"),
        version=_text(root, "version"),
        description=_description(root),
        maintainers=tuple(_person(maintainer) for maintainer in root.all("maintainer")),
        authors=tuple(_person(author) for author in root.all("author")),
        licenses=tuple(entry.text for entry in root.all("license")),
        dependencies=tuple(
            Dependency(child.tag, child.text, child.get("condition") is not None)
            for child in root.children
            if child.tag in DEPENDENCY_TAGS
        ),
        build_type=_text(root.child("export") or root, "build_type"),
        urls=tuple(entry.text for entry in root.all("url")),
        span=root.span,
    )


def read_model_config(document: XmlDocument) -> ModelConfig:
    """Read a model.config."""
    root = document.root
    return ModelConfig(
        name=_text(root, "name"),
        version=_text(root, "version"),
        sdf=tuple(SdfEntry(entry.text, _attribute(entry, "version")) for entry in root.all("sdf")),
        authors=tuple(
            Person(_text(author, "name"), _text(author, "email"), author.span)
            for author in root.all("author")
        ),
        description=_text(root, "description"),
        depends=tuple(
            uri.text
            for depend in root.all("depend")
            for model in depend.all("model")
            for uri in model.all("uri")
        ),
        span=root.span,
    )


def _text(parent: Element, tag: str) -> Located[str]:
    """Return the text of a child; of a missing child, an empty one at the parent."""
    child = parent.child(tag)
    return Located("", parent.span, stated=False) if child is None else child.text


def _attribute(element: Element, name: str) -> Located[str]:
    return element.attribute(name) or Located("", element.span, stated=False)


def _person(element: Element) -> Person:
    return Person(element.text, _attribute(element, "email"), element.span)


def _format(root: Element) -> Located[int | None]:
    written = root.attribute("format")
    if written is None:
        return Located(1, root.span, stated=False)
    number = written.value.strip()
    return Located(int(number) if number in {"1", "2", "3"} else None, written.span)


def _description(root: Element) -> Located[str]:
    """Return the description with the text of its tags: it may contain XHTML."""
    child = root.child("description")
    if child is None:
        return Located("", root.span, stated=False)
    words = " ".join("".join(str(part) for part in child.node.itertext()).split())
    if not words:
        return Located("", child.span, stated=False)
    start, end = child.position.start_end, child.position.end_start
    raw = child.source.text[start:end]
    start += len(raw) - len(raw.lstrip())
    return Located(words, Span(child.source, start, start + len(raw.strip()), child))


class Paperwork(Record, eq=False, dict=True):
    """Content of a package's own paperwork, without inherited parts."""

    package: Package

    def unread(self, path: str) -> str:
        """Return why a paper that is there cannot be read; empty if it can, or is missing."""
        if self.package.index.find(path) is None:
            return ""
        document = self.package.xml(path)
        if isinstance(document, NotReadable):
            return f"{path} {document.reason}"
        return f"{path} is not well-formed" if isinstance(document, XmlFault) else ""

    @cached_property
    def manifest(self) -> PackageManifest | None:
        """package.xml; None if it is missing or not well-formed."""
        document = self.package.xml("package.xml")
        return read_package_xml(document) if isinstance(document, XmlDocument) else None

    def undeclared(self, names: Iterable[str]) -> frozenset[str]:
        """Return the packages that package.xml does not declare; none if it cannot be read."""
        manifest = self.manifest
        return frozenset(it for it in names if manifest is not None and not manifest.depends_on(it))

    @cached_property
    def config(self) -> ModelConfig | None:
        """model.config; None if it is missing or not well-formed."""
        document = self.package.xml("model.config")
        return read_model_config(document) if isinstance(document, XmlDocument) else None

    @property
    def build(self) -> CMakeFile | None:
        """CMakeLists.txt; None if it is missing or no text."""
        return self.package.build


@part
def paperwork(package: Package) -> Paperwork:
    """Return the content of the package's own paperwork."""
    return Paperwork(package)
