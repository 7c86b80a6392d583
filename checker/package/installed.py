"""Where files that a build installs come from: tools look them up as they are installed."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from fnmatch import fnmatchcase
from typing import TYPE_CHECKING

from checker.source.cmake import CMakeFile, Install
from checker.source.setup_py import Pattern, SetupFile

if TYPE_CHECKING:
    from checker.package.index import FileIndex
    from checker.package.package import Package

_SHARE = "share/"
_PATTERN_LIMIT = 200


def source_of(package: Package, path: str) -> str | None:
    """Return the path in the source of what is installed at a path; None when nothing is.

    Without a build file, the only file whose path ends so is taken for it.

    Args:
        package: That installs it.
        path: Below the installed package's folder, such as `urdf/arm.urdf`.
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
    """Return the one file whose path ends so, where nothing tells how files are installed."""
    found = [file.path for file in package.index.files if file.path.endswith(f"/{path}")]
    return found[0] if len(found) == 1 else None


def installed_items(build: CMakeFile) -> Iterator[tuple[str, str]]:
    """Yield where files and folders go, below the installed package, and where they come from."""
    for install in build.installs:
        yield from _items(install)


def _items(install: Install) -> Iterator[tuple[str, str]]:
    if install.kind not in ("DIRECTORY", "FILES") or not install.destination.startswith(_SHARE):
        return
    below = install.destination.removeprefix(_SHARE).partition("/")[2]
    for item in install.items:
        origin = item.value
        name = "" if origin.endswith("/") else posixpath.basename(origin)
        yield posixpath.normpath(posixpath.join(below, name)), origin.rstrip("/") or "."


def data_file_items(setup: SetupFile, index: FileIndex) -> Iterator[tuple[str, str]]:
    """Yield the same for the `data_files` of a setup.py, which installs files and no folders."""
    for entry in setup.data_files:
        if not entry.destination.startswith(_SHARE):
            continue
        below = entry.destination.removeprefix(_SHARE).partition("/")[2]
        for item in entry.items:
            for origin in _matching(item, index) if isinstance(item, Pattern) else (item,):
                yield posixpath.normpath(posixpath.join(below, posixpath.basename(origin))), origin


def _matching(pattern: Pattern, index: FileIndex) -> Iterator[str]:
    """Yield the files that `glob` finds: `*` stays within a folder, and so does a plain `**`."""
    if len(pattern.text) > _PATTERN_LIMIT:
        return
    wanted = posixpath.normpath(pattern.text).split("/")
    deep = pattern.recursive and wanted.count("**") == 1
    at = wanted.index("**") if deep else len(wanted)
    for file in index.files:
        parts = file.path.split("/")
        between = len(parts) - len(wanted) + 1
        if not deep and between == 1:
            fitting = zip(parts, wanted, strict=True)
        elif deep and between >= 0:
            fitting = zip(
                [*parts[:at], *parts[at + between :]], wanted[:at] + wanted[at + 1 :], strict=True
            )
        else:
            continue
        if all(fnmatchcase(part, word) for part, word in fitting):
            yield file.path
