"""Content of a folder that can be checked: packages, model folders and single model files."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from itertools import islice
from pathlib import Path

from checker.base.record import Record
from checker.package.formats import is_checked_by_itself, model_suffixes
from checker.package.inheritance import SPAWNER
from checker.package.kind import (
    BUILT,
    IGNORED,
    MODEL_CONFIG,
    MODEL_MARKERS,
    holds_loose_files,
    is_environment,
    is_file,
    is_made_by_colcon,
    looks_like_package,
)

MAX_FOLDERS = 5_000
MAX_DEPTH = 60
_ITEMS = 5_000
"""Greatest number of items of one folder that are read."""
_MANIFEST = "package.xml"
_SOURCE_SPACE = "src"
"""Of a workspace, which may itself look like a package: the build tools may start below it."""
_URDF_FOLDER = "urdf"


class Unit(Record):
    """Smallest thing that is checked alone.

    Attributes:
        folder: The folder of a package or model, or of a single file; links resolved.
        only: Name of the single file; empty for a folder.
    """

    folder: Path
    only: str = ""

    @property
    def home(self) -> Path:
        """The folder in which its siblings lie."""
        return self.folder if self.only else self.folder.parent


class Units(Record):
    """All that a folder contains.

    Attributes:
        units: The units by path, packages before what is in them.
        complete: Whether all folders were read.
        ignored: Files that keep the build tools, and this search, out of their folders.
        built: Folders `build`, `install` and `log` that colcon made, or those that it made in them.
        nested: ROS packages in others, each with the package around it: no build tool finds them.
    """

    units: tuple[Unit, ...]
    complete: bool = True
    ignored: tuple[Path, ...] = ()
    built: tuple[Path, ...] = ()
    nested: tuple[tuple[Path, Path], ...] = ()


def units_below(folder: Path) -> Units:
    """Find packages, model folders, loose model and launch files in a folder, however deep.

    What is in a model folder or a submission is a part of it; models with a model.config in a model
    folder without a model of its own are separate units. A ROS package may contain models and
    worlds; these are separate units. A ROS package in another one is none: neither colcon nor
    catkin looks for packages below a package (colcon/colcon-cargo#63). What colcon built is left
    out. Links are not followed.

    Args:
        folder: Links resolved; itself a unit if it is a package or model. It is also read
            where the build tools would ignore it: an explicit path overrides that.
    """
    search = _Search(folder)
    found = tuple(search.at(folder, inside=False, depth=0))
    built = tuple(dict.fromkeys(search.built))
    return Units(found, search.complete, tuple(search.ignored), built, tuple(search.nested))


def homes_of(units: Iterable[Unit], near: Path) -> tuple[Path, ...]:
    """Return the folders that contain units, those nearest to a place first.

    Args:
        units: Loose files are no siblings of anything.
        near: The folders in which siblings are looked up; the nearest one of a name counts.
    """
    homes = dict.fromkeys(unit.home for unit in units if not unit.only)
    return tuple(sorted(homes, key=lambda home: -len(_common(home, near).parts)))


def _common(one: Path, other: Path) -> Path:
    return Path(os.path.commonpath((one, other)))


class _Search:
    def __init__(self, top: Path) -> None:
        self.top = top
        self.folders = 0
        self.complete = True
        self.ignored: list[Path] = []
        self.built: list[Path] = []
        self.nested: list[tuple[Path, Path]] = []

    def at(
        self,
        folder: Path,
        *,
        inside: bool,
        depth: int,
        below_loose: bool = False,
        around: Path | None = None,
    ) -> Iterator[Unit]:
        """Yield a folder if it is a unit, and what it contains.

        Args:
            folder: The folder to look into.
            inside: Whether it is in a ROS package.
            depth: Folders above it that were searched.
            below_loose: Whether it is in a loose folder of URDF, MuJoCo or launch files, to which
                its own then belong.
            around: The ROS package that it is in, if it is in one.
        """
        self.folders += 1
        if self.folders > MAX_FOLDERS or depth > MAX_DEPTH:
            self.complete = False
            return
        files, folders = _content(folder)
        if depth and self._is_left_out(folder, files, folders):
            return
        is_debian = folder.name == "debian" and "control" in files  # below it is what was installed
        if is_debian or self._is_nested(folder, files, around):
            return
        is_package = looks_like_package(folder)
        if is_package:
            yield Unit(folder)
            if is_file(folder / SPAWNER):
                return
            if not MODEL_MARKERS.isdisjoint(files):
                yield from self._below_config(folder, files, folders, depth)
                return
        inside = inside or is_package
        around = folder if is_package else around
        # Loose launch files and model files of URDF and MuJoCo belong to the package around.
        loose = [] if below_loose else files
        holds_urdf = not inside and _holds_urdf(folder, loose, folders)
        is_loose = holds_urdf or (not inside and holds_loose_files(folder, loose))
        if is_loose:
            yield Unit(folder)
        yield from (Unit(folder, name) for name in files if is_checked_by_itself(name))
        for name in folders:
            is_part = holds_urdf and name == _URDF_FOLDER
            yield from self.at(
                folder / name,
                inside=inside or is_part,
                depth=depth + 1,
                below_loose=below_loose or is_loose,
                around=around if name != _SOURCE_SPACE else None,
            )

    def _is_left_out(self, folder: Path, files: list[str], folders: list[str]) -> bool:
        """Return whether the build tools keep out of a folder, or made what is in it."""
        names = (*files, *folders)
        if is_environment(names):
            return True
        is_built = is_made_by_colcon(folder, names)
        if is_built and self.top.name in BUILT:
            return False  # the user names what colcon made
        if is_built or (folder.name in BUILT and "COLCON_IGNORE" in files):
            self.built.append(folder.parent if folder.parent.name in BUILT else folder)
        if marks := IGNORED.intersection(files):
            self.ignored.append(folder / min(marks))
        return bool(is_built or marks)

    def _is_nested(self, folder: Path, files: list[str], around: Path | None) -> bool:
        """Return whether a folder is a ROS package in another, and no model."""
        if around is None or _MANIFEST not in files or not MODEL_MARKERS.isdisjoint(files):
            return False
        self.nested.append((folder, around))
        return True

    def _below_config(
        self, folder: Path, files: list[str], folders: list[str], depth: int
    ) -> Iterator[Unit]:
        """Yield the models in a folder whose own model.config names no model beside it."""
        if any(name.lower().endswith(model_suffixes()) for name in files):
            return
        for name in folders:
            if (folder / name / MODEL_CONFIG).is_file():
                yield from self.at(folder / name, inside=True, depth=depth + 1)


def _holds_urdf(folder: Path, files: list[str], folders: list[str]) -> bool:
    below = _content(folder / _URDF_FOLDER)[0] if _URDF_FOLDER in folders else []
    return any(
        name.lower().endswith(model_suffixes()) and not is_checked_by_itself(name)
        for name in (*files, *below)
    )


def _content(folder: Path) -> tuple[list[str], list[str]]:
    """Return the names of the files and of the folders in a folder, links and hidden ones aside."""
    files, folders = [], []
    try:
        with os.scandir(folder) as items:
            for item in islice(items, _ITEMS):
                if item.is_file(follow_symlinks=False):
                    files.append(item.name)
                elif item.is_dir(follow_symlinks=False) and not _is_hidden(item.name):
                    folders.append(item.name)
    except OSError:
        return [], []
    return sorted(files), sorted(folders)


_OF_TOOLS = ("__MACOSX", "node_modules", "PackageCache")
"""Folders that archivers, npm and Unity make."""


def _is_hidden(name: str) -> bool:
    return name.startswith(".") or name in _OF_TOOLS
