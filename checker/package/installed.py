"""Where files that CMake installs come from: tools look them up as they are installed."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from typing import TYPE_CHECKING

from checker.source.cmake import CMakeFile, Install

if TYPE_CHECKING:
    from checker.package.package import Package

_SHARE = "share/"


def source_of(package: Package, path: str) -> str | None:
    """Return the path in the source of what is installed at a path; None when nothing is.

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
    return None


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
