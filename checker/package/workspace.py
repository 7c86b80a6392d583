"""The packages that lie side by side, looked up by name."""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from functools import cached_property
from itertools import islice
from pathlib import Path
from typing import Any

from lxml import etree
from msgspec import field

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.package.kind import IGNORED, enclosing_package, is_file, looks_like_package
from checker.package.mentions import has_file
from checker.package.overlay import Overlay
from checker.package.package import Package
from checker.package.references import PROVIDED
from checker.package.walk import build_index
from checker.source.text import without_comments

MAX_FOLDERS = 5_000
MANIFEST_LIMIT = 1_000_000
LEVELS_ABOVE = 2
"""Folders above a workspace in which packages of the challenge are looked for."""
THUMBNAILS = "thumbnails"
SHARED_FOLDERS = ("config", "launch", "meshes", "urdf", "worlds")
"""Folders that packages of ROS install into their share folder."""
_BUILDS = (*IGNORED, "CMakeLists.txt", "package.xml", "pyproject.toml", "setup.cfg", "setup.py")
"""Files that keep the build out of a folder, or by which colcon may build it as it is."""
_LEVELS = 6
"""Folders above another in which a package is looked for."""
_WORD = re.compile(r"\w+")
_NAME = re.compile(r"[A-Za-z][\w-]{0,199}")
_GAZEBO = frozenset({"gazebo", "gazebo_ros", "gz", "gzserver", "ros_gz_sim", "ros_ign_gazebo"})
"""Words of launch files that start Gazebo or spawn into it."""


class Workspace(Record, eq=False, dict=True):
    """Folders whose direct subfolders are packages.

    Nothing above them is ever read, except the challenge's own packages: in its repository
    they are next to the folder of all submissions.

    Attributes:
        directories: Links resolved. The first is where the checked packages lie; further ones
            come from the user, to find siblings in.
        within: The folder that an archive was unpacked into, which nothing leaves; else None.
        overlay: Texts that replace the content of files.
        given: The folder that the user gave, above the packages; else None. Of the folders up to
            it, only the README, container, CI and build files at their top are read.
        built: Folders in it that colcon made, by the folder of the package that reports them.
    """

    directories: tuple[Path, ...]
    within: Path | None = None
    overlay: Overlay = field(default_factory=Overlay)
    given: Path | None = None
    built: Mapping[Path, tuple[Path, ...]] = field(default_factory=dict)
    _packages: dict[Path, Package] = field(default_factory=dict)
    _found: dict[str, Package | None] = field(default_factory=dict)

    def __reduce__(self) -> tuple[Any, ...]:
        """Send a workspace to another process without its packages."""
        return Workspace, (self.directories, self.within, self.overlay, self.given, self.built)

    def again(self, root: Path, only: str) -> Package:
        """Return a package that came from another process, by its folder and its only file."""
        return Package(root, self, only) if only else self.at(root)

    def with_overlay(self, overlay: Overlay) -> Workspace:
        """Return the workspace as if files held other texts; what stays is not read again."""
        changed = self.overlay.changed_paths(overlay)
        other = Workspace(self.directories, self.within, overlay, self.given, self.built)
        for root, package in self._packages.items():
            other._packages[root] = package.kept(other, changed)
        return other

    def package(self, name: str) -> Package | None:
        """Return the package of a folder name, else of a `package.xml` name, else None."""
        if name not in self._found:
            self._found[name] = self._look_for(name)
        return self._found[name]

    def ignores(self, name: str) -> bool:
        """Return whether a file such as COLCON_IGNORE keeps the build out of a package's folder."""
        marks = (folder / name / mark for folder in self.directories for mark in IGNORED)
        try:
            return any(mark.exists() for mark in marks)
        except OSError:  # a name that no folder can have
            return False

    def without_manifest(self, name: str) -> Path | None:
        """Return the folder that would be the package of a name if it had a package.xml.

        It has folders that packages share, and nothing by which a build tool finds it.
        """
        if self.package(name) is not None or not _NAME.fullmatch(name):
            return None
        places = (home / name for home in self.directories)
        return next((folder for folder in places if _lacks_manifest(folder)), None)

    def _look_for(self, name: str) -> Package | None:
        if not name or name.startswith(".") or "/" in name or "\\" in name or "\0" in name:
            return None
        if self.ignores(name):
            return None
        for directory in self.directories:
            if found := self._package_at(directory / name):
                return found
        if name in PROVIDED:
            return self._package_above(name)
        folders = self.folders_by_declared_name.get(name)
        return self.at(folders[0]) if folders else None

    def at(self, folder: Path) -> Package:
        """Return the one `Package` of a folder, links resolved."""
        return self._packages.setdefault(folder, Package(folder, self))

    @cached_property
    def packages(self) -> dict[str, Package]:
        """Every available package by its folder's name; the first one when a name comes twice."""
        packages: dict[str, Package] = {}
        for directory in self.directories:
            for folder in _subfolders(directory):
                if looks_like_package(folder):
                    packages.setdefault(folder.name, self.at(folder))
        return packages

    @cached_property
    def thumbnails_by_size(self) -> dict[int, list[tuple[Package, str]]]:
        """Every thumbnail of every available package, by its size in bytes."""
        by_size: dict[int, list[tuple[Package, str]]] = {}
        for package in self.packages.values():
            folder = package.root / THUMBNAILS
            if folder.is_symlink() or not folder.is_dir():
                continue
            for file in build_index(folder, self.holds).files:
                if file.size:
                    by_size.setdefault(file.size, []).append((package, f"{THUMBNAILS}/{file.path}"))
        return by_size

    @cached_property
    def launch_texts(self) -> dict[str, str]:
        """The launch files of all available packages, comments included, by package and path."""
        return {
            f"{package.name}/{path}": text
            for package in self.packages.values()
            for path, text in package.launch_texts.items()
        }

    def launches_with(self, name: str) -> list[str]:
        """Return the texts of the launch files that contain a word or a part of one."""
        return [text for text in self.launch_texts.values() if name in text]

    def launches_file(self, name: str) -> bool:
        """Return whether a launch file contains the whole name of a file."""
        return any(has_file(text, name) for text in self.launch_texts.values())

    @cached_property
    def launch_words(self) -> frozenset[str]:
        """Every word of the launch files of all available packages, comments included."""
        return frozenset(
            word for text in self.launch_texts.values() for word in _WORD.findall(text)
        )

    @cached_property
    def started_words(self) -> frozenset[str]:
        """Every word of the launch files of all available packages, without their comments."""
        texts = (without_comments(*each) for each in self.launch_texts.items())
        return frozenset(word for text in texts for word in _WORD.findall(text))

    @property
    def may_start_gazebo(self) -> bool:
        """True if a launch file of an available package names Gazebo, or if there is none."""
        return not self.launch_words or not self.launch_words.isdisjoint(_GAZEBO)

    def holds(self, real: Path) -> bool:
        """Return whether a real path is within a package of the workspace."""
        for directory in self.directories:
            if real.is_relative_to(directory) and real != directory:
                first = real.relative_to(directory).parts[0]
                if looks_like_package(directory / first):
                    return True
        return False

    def _package_at(self, folder: Path) -> Package | None:
        try:
            real = folder.resolve(strict=True)
            is_package = looks_like_package(real)
        except (OSError, RuntimeError):
            return None
        return self.at(real) if is_package and self.holds(real) else None

    def _package_above(self, name: str) -> Package | None:
        """Return a package that is up to `LEVELS_ABOVE` folders above; links are not followed."""
        for directory in self.directories:
            for above in islice(directory.parents, LEVELS_ABOVE):
                folder = above / name
                inside = self.within is None or above.is_relative_to(self.within)
                if inside and not folder.is_symlink() and _is_package(folder):
                    return self.at(folder)
        return None

    @cached_property
    def folders_by_declared_name(self) -> dict[str, list[Path]]:
        """The folders of packages by the names that their package.xml declare."""
        names: dict[str, list[Path]] = {}
        for directory in self.directories:
            for folder in _subfolders(directory):
                if name := self._declared_name(folder):
                    names.setdefault(name, []).append(folder)
        return names

    def _declared_name(self, folder: Path) -> str:
        """Return the `<name>` of a folder's package.xml, or nothing."""
        manifest = folder / "package.xml"
        if manifest.is_symlink() or not manifest.is_file():
            return ""
        source = self.overlay.read(manifest, "package.xml", MANIFEST_LIMIT)
        if isinstance(source, NotReadable):
            return ""
        # Without places, which take ten times as long: a workspace may have hundreds of packages.
        parser = etree.XMLParser(
            encoding="utf-8", resolve_entities=False, no_network=True, load_dtd=False, recover=True
        )
        try:
            tree = etree.fromstring(source.text.encode(), parser)
        except etree.XMLSyntaxError:  # there is nothing at all in it
            return ""
        return str(tree.xpath("string(name)")).strip() if tree is not None else ""


def _lacks_manifest(folder: Path) -> bool:
    try:
        if folder.is_symlink() or not any((folder / each).is_dir() for each in SHARED_FOLDERS):
            return False
        inside = (folder, *_subfolders(folder))
        known = any(is_file(folder / each) for each in _BUILDS)
    except OSError:
        return False
    return not (
        known or any(map(looks_like_package, inside)) or enclosing_package(folder.parent, _LEVELS)
    )


def _is_package(folder: Path) -> bool:
    try:
        return looks_like_package(folder)
    except OSError:
        return False


def _subfolders(directory: Path) -> list[Path]:
    try:
        with os.scandir(directory) as items:
            folders = [
                Path(item.path)
                for item in islice(items, MAX_FOLDERS)
                if item.is_dir(follow_symlinks=False)
            ]
    except OSError:
        return []
    return sorted(folders)
