"""Kind of a package, and the packages to which changed files belong."""

from __future__ import annotations

import os
import re
from collections.abc import Collection, Iterable, Iterator, Sequence
from enum import StrEnum
from itertools import islice
from os.path import abspath
from pathlib import Path
from typing import TYPE_CHECKING

from checker.base.errors import UnreadableInput
from checker.package.formats import model_suffixes
from checker.package.inheritance import SPAWNER, SUBMISSION_NAME
from checker.package.mjcf_files import holds_mjcf, mjcf_files
from checker.package.model_file import own_model
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package


# What makes a folder a package, before anything in it is read.


MODEL_CONFIG = "model.config"
MODEL_MARKERS = frozenset({MODEL_CONFIG, "model.sdf"})
MARKERS = ("package.xml", *sorted(MODEL_MARKERS), SPAWNER)
IGNORED = frozenset({"COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE", ".catkin", ".built_by"})
"""Files that keep the build tools out of a folder, or mark what they built there."""
BUILT = frozenset({"build", "install", "log"})
"""Folders that colcon makes; one of them with a file of `IGNORED` is not part of a package."""
_INSTALLED = ("colcon-core/packages", "ament_index/resource_index")
"""Folders below `share/` in which colcon and ament register what they installed."""


def looks_like_package(folder: Path) -> bool:
    """Return whether a folder contains one of the files that only a package has."""
    return any(is_file(folder / marker) for marker in MARKERS)


def is_made_by_colcon(folder: Path, names: Collection[str]) -> bool:
    """Return whether a folder is what colcon built of a package, installed or logged.

    Args:
        folder: The folder.
        names: The names of the files and folders in it.
    """
    if folder.name == "log":
        return os.path.lexists(folder / "latest_build")
    if "colcon_build.rc" in names:
        return True
    may_be = "share" in names and "package.xml" not in names
    return may_be and any((folder / "share" / mark).is_dir() for mark in _INSTALLED)


def is_file(path: Path) -> bool:
    """Return whether a file is there; False if its folder may not be read."""
    try:
        return path.is_file()
    except OSError:
        return False


def is_launch_name(name: str) -> bool:
    """Return whether a file is a launch file of ROS 2 in Python, by its name."""
    return name.endswith((".launch.py", "_launch.py"))


def holds_loose_models(folder: Path) -> bool:
    """Return whether model files are in a folder, or in its `urdf/`, without a package around."""
    return any(
        name.lower().endswith(model_suffixes())
        for place in (folder, folder / "urdf")
        for name in _names(place)
    )


def enclosing_package(place: Path, levels: int = 3) -> Path | None:
    """Return the nearest package folder around (or at) a folder, at most `levels` up."""
    around = islice((place, *place.parents), levels)
    return next((folder for folder in around if looks_like_package(folder)), None)


def _names(folder: Path) -> list[str]:
    try:
        with os.scandir(folder) as items:
            return [item.name for item in islice(items, 5_000) if item.is_file()]
    except OSError:
        return []


_URDF = (".urdf", ".xacro")
_ADD_LIBRARY = re.compile(r"^[ \t]{0,80}add_library[ \t]{0,8}\(", re.MULTILINE | re.IGNORECASE)


class PackageKind(StrEnum):
    """Kind of a package.

    `ROBOT`: a submission with its own model (or that should have one). `CONFIGURATION`: a
    submission whose model is a sibling's. `PLUGIN`: libraries only. `BASE_MODEL`: a model that
    others build on, without a spawner. `URDF_DESCRIPTION`: URDF or xacro without an SDF model.
    `WORLD`: a single file with a world. `MUJOCO_MODEL`: MJCF without any other model.
    """

    ROBOT = "robot"
    CONFIGURATION = "configuration"
    PLUGIN = "plugin"
    BASE_MODEL = "base_model"
    URDF_DESCRIPTION = "urdf_description"
    SINGLE_FILE = "single_file"
    WORLD = "world"
    MUJOCO_MODEL = "mujoco_model"
    UNKNOWN = "unknown"


def kind_of(package: Package) -> PackageKind:
    """Tell a package's kind from the files it contains.

    A package that calls itself a submission, or bridges topics, is a robot even when its spawner
    was forgotten; otherwise the missing file would excuse itself.
    """
    if package.only:
        return _kind_of_file(package)
    if package.base is not None:
        return PackageKind.CONFIGURATION
    submission = SUBMISSION_NAME.search(package.name) is not None
    if submission or package.exists(SPAWNER) or package.exists("launch/vehicle_topics.launch"):
        return PackageKind.ROBOT
    model = own_model(package)
    described = bool(package.index.with_suffix(*_URDF))
    if model is not None and not (is_urdf(model) or (described and _loads_urdf(package))):
        return PackageKind.BASE_MODEL
    if described:
        return PackageKind.URDF_DESCRIPTION
    return _kind_without_robot(package)


def is_urdf(path: str) -> bool:
    """Return whether a model file is URDF, by its name."""
    return path.lower().endswith((".urdf", ".urdf.xacro"))


def _loads_urdf(package: Package) -> bool:
    """Return whether launch files of ROS load URDF: a model beside it is an object or a stage."""
    texts = package.launch_texts.values() if package.exists("package.xml") else ()
    return any(suffix in text for text in texts for suffix in _URDF)


def _kind_without_robot(package: Package) -> PackageKind:
    if mjcf_files(package):
        return PackageKind.MUJOCO_MODEL
    return PackageKind.PLUGIN if _carries_library(package) else PackageKind.UNKNOWN


def _kind_of_file(package: Package) -> PackageKind:
    if mjcf_files(package):
        return PackageKind.MUJOCO_MODEL
    document = package.xml(package.only)
    holds_world = isinstance(document, XmlDocument) and document.root.child("world") is not None
    return PackageKind.WORLD if holds_world else PackageKind.SINGLE_FILE


def _carries_library(package: Package) -> bool:
    if package.index.with_suffix(".so"):
        return True
    build = package.read("CMakeLists.txt")
    return isinstance(build, SourceText) and _ADD_LIBRARY.search(build.text) is not None


# The packages that changed files belong to: hooks get files, and packages are checked.


def changed_packages(files: Iterable[Path], here: Path) -> list[Path]:
    """Return the packages of changed files, each once, in the order of the files.

    A file belongs to the outermost package around it within its repository: the nested model
    `parts/guard/model.sdf` is a part of the robot, not a package. Without a package around, it
    belongs to the outermost folder of loose model or launch files; other files are passed over.
    Those that are gone count for the package that they were in.

    Args:
        files: Relative to `here`, or absolute.
        here: The folder in which the command runs, links resolved.

    Returns:
        Folders, relative to `here` where they are below it.

    Raises:
        UnreadableInput: A file is a folder, or a link to a package.
    """
    by_folder: dict[Path, Path | None] = {}
    for file in files:
        _refuse_folder(file, here)
        # A changed link is a file as well: it is not followed.
        folder = Path(abspath(here / file)).parent  # noqa: PTH100
        if folder not in by_folder:
            by_folder[folder] = _outermost(folder)
    paths = dict.fromkeys(package for package in by_folder.values() if package is not None)
    return [path.relative_to(here) if path.is_relative_to(here) else path for path in paths]


def _refuse_folder(file: Path, here: Path) -> None:
    """Refuse links that would check packages by their folders; other links count as files."""
    place = here / file
    try:
        is_folder = place.is_dir() and (not place.is_symlink() or looks_like_package(place))
    except (OSError, ValueError):
        return
    if is_folder:
        raise UnreadableInput(file, "is a folder", "leave out --files to check folders")


def _outermost(folder: Path) -> Path | None:
    around = [*_within_repository(folder)]
    packages = [place for place in around if looks_like_package(place)]
    if packages or not _holds_repository(around[-1]):
        return packages[-1] if packages else None
    loose = [it for it in around if holds_loose_models(it) or holds_loose_files(it, _names(it))]
    return loose[-1] if loose else None


def holds_loose_files(folder: Path, names: Sequence[str]) -> bool:
    """Return whether some files of a folder are models of MuJoCo, or launch files."""
    return holds_mjcf(folder, names) or any(map(is_launch_name, names))


def _within_repository(folder: Path) -> Iterator[Path]:
    """Yield a folder and those above it, up to the root of the repository if there is one."""
    for place in (folder, *folder.parents):
        yield place
        if _holds_repository(place):
            return


def _holds_repository(folder: Path) -> bool:
    try:
        return (folder / ".git").exists()
    except OSError:
        return False


def is_environment(names: Iterable[str]) -> bool:
    """Return whether the names in a folder are those of a virtual environment of Python.

    A workspace or package around which someone made one is none: its own content counts.
    """
    found = {"pyvenv.cfg", "package.xml", "src"}.intersection(names)
    return found == {"pyvenv.cfg"}
