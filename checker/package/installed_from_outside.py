"""Files that CMake installs from outside of the package: `${TOP}/launch`, or `../../launch`."""

from __future__ import annotations

import os
import posixpath
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from checker.package.installed import items_of
from checker.package.walk import entry_at

if TYPE_CHECKING:
    from checker.package.package import Package
    from checker.source.cmake import CMakeFile

_WHOLE, _ABOVE = ("ABSOLUTE", "REALPATH"), ("DIRECTORY", "PATH")
"""Parts of a path that `get_filename_component` takes: all of it, or the folder around it."""


def is_from_outside(package: Package, path: str) -> bool:
    """Return whether a file outside of a package, which the user gave as well, is installed there.

    Args:
        package: The package that installs it.
        path: The path below the folder of the installed package.
    """
    return any(_is_there(package, source) for _, source in _sources(package, path))


def may_be_from_outside(package: Package, path: str) -> str:
    """Return what may install a path from a place that is not known, as a clause; else nothing."""
    for place, source in _sources(package, path):
        if _is_there(package, source) is None:
            return f"{place} of {package.declared_name} installs what is outside of the package"
    return ""


def _sources(package: Package, path: str) -> Iterator[tuple[str, str]]:
    """Yield `FILE:LINE` of what installs a path from outside, and where that comes from."""
    build = package.build
    places = _places(build) if build is not None else {}
    for install in build.installs if build is not None else ():
        for target, origin in items_of(install):
            known = posixpath.normpath(target.partition("$")[0])
            rest = path if known == "." else posixpath.relpath(path, known)
            source = origin
            for name, value in places.items():
                source = source.replace(f"${{{name}}}", value)
            if not rest.startswith("..") and ("$" in source or source.startswith("..")):
                yield install.span.source.where(install.span.start), posixpath.join(source, rest)


def _places(build: CMakeFile) -> dict[str, str]:
    """Return the variables that `get_filename_component` sets, with paths from the package."""
    found = {}
    for call in build.calls_of("get_filename_component"):
        match [word.value for word in call.arguments]:
            case [name, path, mode] if mode in _WHOLE and not call.conditional:
                found[name] = posixpath.normpath(path)
            case [name, path, mode] if mode in _ABOVE and not call.conditional:
                found[name] = posixpath.normpath(posixpath.join(path, ".."))
    return found


def _is_there(package: Package, source: str) -> bool | None:
    """Return whether a file is at a path from a package; None for what the user did not give."""
    given = package.workspace.given
    location = Path(os.path.normpath(package.root / source))
    if "$" in source or given is None or not location.is_relative_to(given):
        return None
    return entry_at(location, source, given, package.workspace.holds) is not None
