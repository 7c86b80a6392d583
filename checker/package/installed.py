"""Sources of the files that a build installs: tools look them up as they are installed."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterable, Iterator
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.cmake import AUTO_PACKAGE, CMakeFile, Install
from checker.source.setup_py import Pattern, SetupFile
from checker.source.text import SourceText

if TYPE_CHECKING:
    from checker.package.index import FileIndex
    from checker.package.package import Package

USUAL_FOLDERS = ("launch", "meshes", "materials", "urdf", "config", "worlds", "thumbnails")
"""Folders that a package installs, whether anything available names their files or not."""
MANIFEST = "package.xml"
"""It is installed by `ament_package()`."""
_SHARE = "share/"
_PATTERN_LIMIT = 200
_WORD = re.compile(r"[\w-]+")
GENERATES = re.compile(
    r"\b(?:add_custom_command|configure_file|xacro_\w{1,40}|file\s{0,8}\(\s{0,8}(?:GENERATE|DOWNLOAD)"
    r"|ExternalProject_Add|FetchContent_\w{1,40}|execute_process)\b",
    re.IGNORECASE,
)
"""Commands of CMake that make files while it builds."""
_PROGRAM = re.compile(r"[\w-]+\.(?:c|cc|cpp|cxx|h|hh|hpp)\b")
"""The source of a program."""
_MAY_INSTALL = re.compile(r"install|add_subdirectory|\binclude\b", re.IGNORECASE)
_PYTHON_MODULES = "ament_python_install_package"


def source_of(package: Package, path: str) -> str | None:
    """Return the path in the source of what is installed at a path; None if nothing is.

    Without a build file, the only file whose path ends so counts as that file.

    Args:
        package: The package that installs it.
        path: The path below the installed package's folder, such as `urdf/arm.urdf`.
    """
    if path.startswith(".."):
        return None
    for target, origin in package.installed:
        if target in (path, ".") or path.startswith(f"{target}/"):
            found = posixpath.normpath(posixpath.join(origin, posixpath.relpath(path, target)))
            if package.exists(found):
                return found
    return _only_one(package, path) if package.build is None and package.setup is None else None


def _only_one(package: Package, path: str) -> str | None:
    """Return the one file whose path ends so, where it is unknown how files are installed."""
    found = package.index.ending(path)
    return found[0] if len(found) == 1 else None


class LeftOut(Record):
    """A file of the source that its package does not install.

    Attributes:
        instead: Its actual place, as the end of a sentence.
        around: What is left out with it: a folder, or the file alone.
    """

    instead: str
    around: str


def left_out(package: Package, holder: Package, path: str) -> LeftOut | None:
    """Return a file that is there in the source, and that certainly nothing installs there.

    None for what is in one of the usual folders of the checked package if nothing of that is
    installed: it is reported as such, whichever file names it.

    Args:
        package: The package being checked.
        holder: The package that should install it.
        path: The path below the folder of the installed package.
    """
    if path == MANIFEST or not holder.exists(path) or source_of(holder, path) is not None:
        return None
    if not _tells_all(holder) or may_be_made(holder, path):
        return None
    folder = _left_out_folder(holder, path)
    if holder is package and folder in USUAL_FOLDERS:
        return None
    instead = f"folder {folder}/ exists only in the source"
    if not folder:
        target = installed_as(holder, path)
        instead = (
            f"the file {f'is installed as {target}' if target else 'exists only in the source'}"
        )
    return LeftOut(instead, f"{holder.name}/{folder or path}")


def resolve_listed(package: Package, path: str) -> tuple[Package, str]:
    """Return the package that a listed path is in, and its path there: `../arm/urdf/a.urdf`."""
    name, _, inside = path.removeprefix("../").partition("/")
    holder = package.workspace.package(name) if path.startswith("../") else None
    return (holder, inside) if holder is not None else (package, path)


def installed_as(package: Package, path: str) -> str:
    """Return where a file of the source is, below the installed package; empty if it is not."""
    for target, origin in package.installed:
        if path == origin or path.startswith(f"{origin}/") or origin == ".":
            return posixpath.normpath(posixpath.join(target, posixpath.relpath(path, origin)))
    return ""


def _left_out_folder(package: Package, path: str) -> str:
    """Return the outermost folder around a file of which nothing is installed; else nothing."""
    if installed_as(package, path):
        return ""
    origins = [origin for _, origin in package.installed]
    folder = ""
    for name in path.split("/")[:-1]:
        folder = posixpath.join(folder, name)
        if not any(origin == folder or origin.startswith(f"{folder}/") for origin in origins):
            return folder
    return ""


def _tells_all(package: Package) -> bool:
    """Return whether CMakeLists.txt or setup.py lists all that is installed as literals."""
    build = package.build
    if build is None:
        return package.setup is not None and package.setup.complete and bool(package.installed)
    for call in build.calls:
        if call.name in ("install", AUTO_PACKAGE):
            words = (word.value for word in call.arguments)
            if call.conditional or any("${" in word for word in words):
                return False
        elif _MAY_INSTALL.search(call.name) and call.name != _PYTHON_MODULES:
            return False
    return bool(package.installed) and not build.faults


def may_be_made(package: Package, path: str) -> bool:
    """Return whether the build may make a file: it names it, or makes files of unknown names.

    `urdf` in setup.py is the folder of the package, and does not name `rviz/urdf.rviz`. Nor does a
    source of a program, `src/arm.cpp`, name `rviz/arm.rviz`.
    """
    stem = posixpath.basename(path).partition(".")[0]
    is_folder = package.exists(stem)
    for file in ("CMakeLists.txt", "setup.py"):
        source = package.read(file)
        if not isinstance(source, SourceText):
            continue
        is_named = not is_folder and stem in _WORD.findall(_PROGRAM.sub("", source.text))
        if is_named or GENERATES.search(source.text):
            return True
    return False


def foreign_installs(package: Package) -> str:
    """Return `FILE:LINE` of what installs files of another place, unknown ones; else nothing."""
    for install in package.build.installs if package.build is not None else ():
        if install.kind != "TARGETS" and any("${" in item.value for item in install.items):
            return install.span.source.where(install.span.start)
    return ""


def installed_items(build: CMakeFile) -> Iterator[tuple[str, str]]:
    """Yield where files and folders go, below the installed package, and where they come from."""
    for install in build.installs:
        yield from items_of(install)


def items_of(install: Install) -> Iterator[tuple[str, str]]:
    """Yield the same of one `install()`."""
    if install.kind not in ("DIRECTORY", "FILES", "PROGRAMS") or not install.destination.startswith(
        _SHARE
    ):
        return
    below = install.destination.removeprefix(_SHARE).partition("/")[2]
    for item in install.items:
        origin = item.value
        name = "" if origin.endswith("/") else posixpath.basename(origin)
        yield posixpath.normpath(posixpath.join(below, name)), origin.rstrip("/") or "."


def data_file_items(setup: SetupFile, index: FileIndex) -> Iterator[tuple[str, str]]:
    """Yield the same for the `data_files` of a setup.py, which installs files and no folders."""
    files = [file.path for file in index.files]
    for entry in setup.data_files:
        if not entry.destination.startswith(_SHARE):
            continue
        below = entry.destination.removeprefix(_SHARE).partition("/")[2]
        matching = (path for pattern in entry.patterns for path in _matching(pattern, files))
        for origin in (*(file.value for file in entry.files), *matching):
            yield posixpath.normpath(posixpath.join(below, posixpath.basename(origin))), origin


def matched_folders(pattern: Pattern, index: FileIndex) -> Iterator[str]:
    """Yield the folders that `glob` finds; `data_files` takes none."""
    return _matching(pattern, (it.path for it in index.entries.values() if it.is_folder))


def _matching(pattern: Pattern, paths: Iterable[str]) -> Iterator[str]:
    """Yield the paths that `glob` finds: `*` stays within a folder, and so does a plain `**`."""
    if len(pattern.text) > _PATTERN_LIMIT:
        return
    wanted = posixpath.normpath(pattern.text).split("/")
    deep = pattern.recursive and wanted.count("**") == 1
    at = wanted.index("**") if deep else len(wanted)
    for path in paths:
        parts = path.split("/")
        between = len(parts) - len(wanted) + 1
        if not deep and between == 1:
            fitting = zip(parts, wanted, strict=True)
        elif deep and between >= 0:
            fitting = zip(
                [*parts[:at], *parts[at + between :]], wanted[:at] + wanted[at + 1 :], strict=True
            )
        else:
            continue
        if all(_fits(part, word) for part, word in fitting):
            yield path


def _fits(name: str, pattern: str) -> bool:
    """Return whether `glob` matches a name; a hidden one only if the pattern says so."""
    hidden = name.startswith(".") and not pattern.startswith(".")
    return not hidden and fnmatchcase(name, pattern)
