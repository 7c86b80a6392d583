"""Package, model or world to which an open file belongs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from pathlib import Path

from checker.base.errors import UnreadableInput
from checker.base.record import Record
from checker.package.formats import model_suffixes
from checker.package.inputs import Opened, open_input
from checker.package.kind import changed_packages
from checker.package.package import Package

"""Suffixes of models outside of packages; XML may be anything."""


class Unit(Record, eq=False):
    """Smallest thing that is checked alone, as it is on disk.

    Attributes:
        path: The folder that is open in the editor, or else the package or file.
        package: The package with its siblings, read from disk.
    """

    path: Path
    package: Package

    @property
    def key(self) -> tuple[Path, str]:
        """The key of the unit."""
        return self.package.root, self.package.only


class Units:
    """Finds the units of files; folders are searched once, until they change."""

    def __init__(self, folders: Sequence[Path] = ()) -> None:
        """Look at nothing yet.

        Args:
            folders: The folders of the editor, links resolved.
        """
        self.folders = tuple(folders)
        self._opened: dict[Path, Opened | None] = {}
        self._found: dict[Path, Unit | None] = {}

    def forget(self) -> None:
        """Look again at what is on disk the next time."""
        self._opened.clear()
        self._found.clear()

    def unit_of(self, file: Path) -> Unit | None:
        """Return the unit that a file belongs to; None outside of packages.

        A model or world in a package is a separate unit if it is one for the command.
        """
        if file not in self._found:
            self._found[file] = self._look_for(file)
        return self._found[file]

    def _look_for(self, file: Path) -> Unit | None:
        for path in self._candidates(file):
            opened = self._open(path)
            holding = [each for each in opened.packages if _holds(each, file)] if opened else []
            if holding:
                return Unit(path, max(holding, key=lambda each: (len(each.root.parts), each.only)))
        return None

    def _candidates(self, file: Path) -> Iterable[Path]:
        """Yield what may be opened to find a file, what the user has opened first."""
        yield from (folder for folder in self.folders if file.is_relative_to(folder))
        try:
            yield from (file.parent / each for each in changed_packages([file], file.parent))
        except UnreadableInput:  # a folder
            return
        if file.name.lower().endswith(model_suffixes()):
            yield file

    def _open(self, path: Path) -> Opened | None:
        if path not in self._opened:
            try:
                with open_input(path) as opened:
                    self._opened[path] = opened
            except UnreadableInput:
                self._opened[path] = None
        return self._opened[path]


def _holds(package: Package, file: Path) -> bool:
    if package.only:
        return file == package.root / package.only
    return file.is_relative_to(package.root)
