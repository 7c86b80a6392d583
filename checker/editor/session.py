"""All that the language server knows: open files, and the last check of each of their packages."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path

from msgspec.structs import replace

from checker.base.cache import cache_folder
from checker.base.errors import CheckerError
from checker.base.record import Record
from checker.editor.check import Checked
from checker.editor.documents import Document, overlay_of
from checker.editor.measured import Measured
from checker.editor.memory_cache import MemoryCache
from checker.editor.names.index import NameIndex, names_of
from checker.editor.units import Unit, Units
from checker.engine.subject import Subject
from checker.finding import Place
from checker.fix.rounds import FindingsOf
from checker.formats.xacro.expansion import xacro_server
from checker.package.inputs import with_package_path
from checker.package.overlay import Overlay, OverlayText
from checker.package.package import Package
from checker.physics.mesh.process import mesh_server
from checker.pipeline import Task
from checker.report.report import ReportedFinding
from checker.report.scene.processes import StartedProcesses
from checker.settings import Settings
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

Key = tuple[Path, str]
"""The key of a unit: its folder, and its file where that is checked alone."""
_SERVER_BYTES = 50_000_000
"""Bytes of requests after which a process is replaced."""


class Problem(Record):
    """Reason why a package is not checked.

    Attributes:
        message: A sentence.
        path: The path of the settings that are at fault; None for other reasons.
    """

    message: str
    path: Path | None = None


class State(Record, eq=False, dict=True):
    """State of a unit.

    Attributes:
        unit: The unit as it is on disk.
        checked: The last check; None if there was none.
        problem: The reason why it is not checked; None if it is.
        measured: The last check with weights and trial; None if there was none.
    """

    unit: Unit
    checked: Checked | None = None
    problem: Problem | None = None
    measured: Measured | None = None

    @cached_property
    def findings(self) -> tuple[ReportedFinding, ...]:
        """The findings, with those of the last check that measured."""
        if self.checked is None:
            return ()
        measured = self.measured.findings_in(self.checked.package) if self.measured else ()
        return (*self.checked.findings, *measured)

    def is_of(self, document: Document) -> bool:
        """Return whether the text of an open file was checked, or cannot be checked."""
        if self.checked is None:
            return True
        text = self.checked.package.workspace.overlay.texts.get(document.path)
        return text is not None and text.text == document.text


class Session:
    """The open files and their packages. All but `documents` belongs to one thread.

    Attributes:
        documents: The documents by their URIs.
        units: Finds the packages of files.
    """

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        """Begin with no open file.

        Args:
            folders: The folders of the editor, links resolved.
        """
        self.documents: dict[str, Document] = {}
        self.units = Units(folders)
        self.cache = MemoryCache(cache_folder())
        self._processes = StartedProcesses(meshes=mesh_server(), xacro=xacro_server())
        self._states: dict[Key, State] = {}
        self._settings: dict[Key, Settings | Problem] = {}
        self._good: dict[Path, OverlayText] = {}
        self._legible: tuple[Checked, Subject] | None = None
        self._names: dict[Key, NameIndex] = {}

    def close(self) -> None:
        """End the processes."""
        self._processes.stop()

    def forget(self) -> None:
        """Read again what is on disk the next time."""
        self.units.forget()
        self._settings.clear()
        self._states = {key: replace(it, checked=None) for key, it in self._states.items()}

    @property
    def states(self) -> tuple[State, ...]:
        """States of all units with open files."""
        return tuple(self._states.values())

    def check_all(self) -> None:
        """Check the units of open files, and forget the others; what has not changed stays."""
        found = (self.units.unit_of(each.path) for each in list(self.documents.values()))
        units = {unit.key: unit for unit in found if unit is not None}
        self._states = {key: state for key, state in self._states.items() if key in units}
        self._names = {key: names for key, names in self._names.items() if key in units}
        opened = {each.path for each in list(self.documents.values())}
        self._good = {path: text for path, text in self._good.items() if path in opened}
        for unit in units.values():
            self.check(unit)

    def check(self, unit: Unit) -> State:
        """Check a unit with the texts of the editor, and remember the result."""
        before = self._states.get(unit.key, State(unit))
        settings = self._settings_of(unit)
        if isinstance(settings, Problem):
            state = replace(before, unit=unit, checked=None, problem=settings)
        else:
            state = self._checked(before, unit, settings)
        self._states[unit.key] = state
        self._renew_processes()
        return state

    def _checked(self, before: State, unit: Unit, settings: Settings) -> State:
        try:
            package = self._package(before, unit, settings)
            if before.checked is not None and package is before.checked.package:
                return before
            checked = Checked(package, settings, self.cache, self._processes)
        except CheckerError as error:
            return replace(before, unit=unit, checked=None, problem=Problem(str(error)))
        self._note_good_texts(package)
        return replace(before, unit=unit, checked=checked, problem=None)

    def judge(self, state: State) -> FindingsOf:
        """Return what finds out how a package is judged after some fixes."""
        settings = self._settings_of(state.unit)

        def findings(package: Package) -> tuple[ReportedFinding, ...]:
            if isinstance(settings, Problem):
                return ()
            return Checked(package, settings, self.cache, self._processes).findings

        return findings

    def _package(self, before: State, unit: Unit, settings: Settings) -> Package:
        """Return a package with the texts of the editor; what has not changed is not read again."""
        overlay = overlay_of(dict(self.documents))
        if before.checked is not None and before.unit.package is unit.package:
            package = before.checked.package
        else:
            package = with_package_path(unit.package, settings.package_path)
        if not package.workspace.overlay.changed_paths(overlay):
            return package
        return package.in_workspace(package.workspace.with_overlay(overlay))

    def _settings_of(self, unit: Unit) -> Settings | Problem:
        if unit.key not in self._settings:
            try:
                task = Task(unit.path, package=unit.package)
                self._settings[unit.key] = task.settings_for(unit.package)
            except CheckerError as error:
                self._settings[unit.key] = Problem(str(error), getattr(error, "path", None))
        return self._settings[unit.key]

    def state_of(self, file: Path) -> State | None:
        """Return what is known of the package of a file; it is checked if it has not been."""
        unit = self.units.unit_of(file)
        if unit is None:
            return None
        state = self._states.get(unit.key)
        if state is None or (state.checked is None and state.problem is None):
            return self.check(unit)
        return state

    def note_measured(self, key: Key, measured: Measured) -> None:
        """Remember a check with weights and trial, unless all files of its unit are closed."""
        if (state := self._states.get(key)) is not None:
            self._states[key] = replace(state, measured=measured)

    def legible(self, checked: Checked) -> Subject:
        """Return a package in which files that are no XML just now have their last good text."""
        if self._legible is None or self._legible[0] is not checked:
            self._legible = checked, self._with_good_texts(checked)
        return self._legible[1]

    def _with_good_texts(self, checked: Checked) -> Subject:
        package = checked.package
        bad = {
            document.path: self._good[document.path]
            for path, document in self._xml_in(package)
            if document.path in self._good and isinstance(package.xml(path), XmlFault)
        }
        if not bad:
            return checked.subject
        overlay = Overlay({**package.workspace.overlay.texts, **bad})
        good = package.in_workspace(package.workspace.with_overlay(overlay))
        return checked.subject.with_package(good)

    def names(self, state: State) -> NameIndex | None:
        """Return the names of a package; of files that have not changed they are kept."""
        if state.checked is None:
            return None
        package, known = self.legible(state.checked).package, self._names.get(state.unit.key)
        if known is None or known.package is not package:
            self._names[state.unit.key] = known = names_of(package, known)
        return known

    def _note_good_texts(self, package: Package) -> None:
        for path, document in self._xml_in(package):
            # Not the text of the document: that may be newer.
            xml = package.xml(path)
            if isinstance(xml, XmlDocument):
                self._good[document.path] = OverlayText(xml.source.text, document.encoding)

    def _xml_in(self, package: Package) -> Iterator[tuple[str, Document]]:
        """Yield the open XML files of a package, by their paths in it."""
        for document in list(self.documents.values()):
            if document.is_xml and document.path.is_relative_to(package.root):
                path = document.path.relative_to(package.root).as_posix()
                if package.exists(path):
                    yield path, document

    def _renew_processes(self) -> None:
        """Stop a process with many requests: they stay on disk until then."""
        for server in (self._processes.meshes, self._processes.xacro):
            if server is not None and server.bytes_given > _SERVER_BYTES:
                server.stop()


def path_in(package: Package, file: Path) -> str:
    """Return the path of a file as a package lists it; a sibling's begins with `../`."""
    if file.is_relative_to(package.root):
        return file.relative_to(package.root).as_posix()
    for other in package.other_packages:
        if file.is_relative_to(other.root):
            return f"../{other.root.name}/{file.relative_to(other.root).as_posix()}"
    return ""


def location_of(package: Package, place: Place) -> Path | None:
    """Return where the file of a place is on disk; None for the package as a whole."""
    entry = package.resolve(place.file) if place.file else None
    return entry.location if entry is not None and entry.is_file else None
