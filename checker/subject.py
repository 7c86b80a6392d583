"""The parts of one package, as rules ask for them; each is read once, when first asked for."""

from __future__ import annotations

import posixpath
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from checker.engine import NotAtHand
from checker.launching import launch_graph
from checker.model.launch.graph import LaunchGraph
from checker.model.robot import Plugin, Robot
from checker.model.sdf.document import SdfDocument
from checker.model.sdf.links import read_plugin
from checker.model.sdf.reader import read_sdf
from checker.model.specification.sheet import Specification, read_specification
from checker.model.urdf.reader import read_urdf
from checker.package.inheritance import SPAWNER, Found, Missing
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.package.reading import NotReadable
from checker.paperwork import Paperwork
from checker.source.positions import XmlFault
from checker.source.xml import XmlDocument
from checker.spawner.reader import Spawner, read_spawner
from checker.spawning import SpawnedXml, WorkspaceFiles, spawned_xml

_WITHOUT_ROBOT = {
    PackageKind.PLUGIN: "the package only carries a plugin",
    PackageKind.UNKNOWN: "the package holds no robot",
}


@dataclass(frozen=True, eq=False)
class Subject:
    """One package under review."""

    package: Package

    def part(self, kind: type) -> Sequence[object] | NotAtHand:
        """Return the part that is an instance of `kind`; a file may hold several robots.

        Raises:
            LookupError: A rule asks for something that is no part of a package.
        """
        provide = _PROVIDERS.get(kind)
        if provide is None:
            raise LookupError(f"{kind.__name__} is no part of a package")
        had = provide(self)
        if isinstance(had, NotAtHand):
            return had
        return had if isinstance(had, tuple) else (had,)

    @cached_property
    def model(self) -> XmlDocument | NotAtHand:
        """The model file."""
        without = _WITHOUT_ROBOT.get(self.package.kind)
        if without is not None:
            return NotAtHand(without, applicable=False)
        path = self.package.model_path
        if isinstance(path, Missing):
            return NotAtHand(path.reason)
        return self.document(path.path)

    def document(self, path: str) -> XmlDocument | NotAtHand:
        """Return a file as XML, or say why it cannot be had."""
        document = self.package.xml(path)
        if isinstance(document, XmlFault):
            return NotAtHand(f"{path} is not well-formed")
        if isinstance(document, NotReadable):
            return NotAtHand(f"{path} {document.reason}")
        return document

    @cached_property
    def sdf(self) -> SdfDocument | NotAtHand:
        """The model file as SDF."""
        if isinstance(self.model, NotAtHand):
            return self.model
        if self.model.root.tag == "robot":
            return NotAtHand("the model is a URDF file", applicable=False)
        return SdfDocument(self.model, (self.model.root.get("version") or "").strip())

    @cached_property
    def robots(self) -> tuple[Robot, ...] | NotAtHand:
        """The robots of the model file, with the plugins that the spawner adds to the first."""
        if isinstance(self.model, NotAtHand):
            return self.model
        if self.model.root.tag == "robot":
            return (read_urdf(self.model),)
        robots = read_sdf(self.model, self._included)
        if not robots:
            nothing_to_see = self.model.root.child("world") is not None
            reason = f"{self.model.source.file} holds no model"
            return NotAtHand(reason, applicable=not nothing_to_see)
        first = robots[0]
        return (replace(first, plugins=(*first.plugins, *self._spawned_plugins)), *robots[1:])

    def _included(self, uri: str) -> XmlDocument | str:
        """Return the model file behind an include's URI: a package at hand, or a folder of it."""
        name, _, rest = uri.removeprefix("model://").partition("/")
        if uri.startswith("model://"):
            holder = self.package.workspace.package(name)
            path = holder.model_path if holder is not None and not rest else None
            if not isinstance(path, Found):
                return f"{uri} is not at hand"
            found = f"../{name}/{path.path}" if name != self.package.name else path.path
        else:
            found = posixpath.join(uri, "model.sdf")
        document = self.document(found)
        return document.reason if isinstance(document, NotAtHand) else document

    @cached_property
    def _spawned_plugins(self) -> tuple[Plugin, ...]:
        if isinstance(self.spawned, NotAtHand):
            return ()
        return tuple(read_plugin(element) for element in self.spawned.plugins)

    @cached_property
    def spawner(self) -> Spawner | NotAtHand:
        """The spawner, read without running it."""
        if self.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAtHand("the package needs no spawner", applicable=False)
        source = self.package.read(SPAWNER)
        if isinstance(source, NotReadable):
            return NotAtHand(f"{SPAWNER} {source.reason}")
        files = WorkspaceFiles(self.package)
        return read_spawner(files, files.entry, source)

    @cached_property
    def spawned(self) -> SpawnedXml | NotAtHand:
        """What the spawner emits, as XML."""
        if isinstance(self.spawner, NotAtHand):
            return self.spawner
        return spawned_xml(self.spawner)

    @cached_property
    def launch(self) -> LaunchGraph | NotAtHand:
        """What the launch files start that the spawner calls for."""
        return launch_graph(self.package, self.spawned)

    @cached_property
    def specification(self) -> Specification | NotAtHand:
        """The specification sheet."""
        if self.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAtHand("the package needs no specifications.md", applicable=False)
        part = self.package.part("specifications.md")
        if isinstance(part, Missing):
            return NotAtHand(part.reason)
        source = self.package.read(part.path)
        if isinstance(source, NotReadable):
            return NotAtHand(f"{part.path} {source.reason}")
        return read_specification(source)


_Provider = Callable[[Subject], object]

_PROVIDERS: dict[type, _Provider] = {
    Package: lambda subject: subject.package,
    Paperwork: lambda subject: Paperwork(subject.package),
    SdfDocument: lambda subject: subject.sdf,
    Robot: lambda subject: subject.robots,
    Spawner: lambda subject: subject.spawner,
    SpawnedXml: lambda subject: subject.spawned,
    LaunchGraph: lambda subject: subject.launch,
    Specification: lambda subject: subject.specification,
}
