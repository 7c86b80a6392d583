"""Where files that CMake installs come from: tools look them up as they are installed."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator
from functools import lru_cache
from typing import TYPE_CHECKING

from checker.source.cmake import Install, read_cmake
from checker.source.text import SourceText

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
    for target, origin in _installed(package):
        if target in (path, ".") or path.startswith(f"{target}/"):
            found = posixpath.normpath(posixpath.join(origin, posixpath.relpath(path, target)))
            if package.exists(found):
                return found
    return None


def _installed(package: Package) -> tuple[tuple[str, str], ...]:
    source = package.read("CMakeLists.txt")
    return _pairs(source) if isinstance(source, SourceText) else ()


@lru_cache(maxsize=16)
def _pairs(source: SourceText) -> tuple[tuple[str, str], ...]:
    installs = read_cmake(source).installs
    return tuple(pair for install in installs for pair in _of(install))


def _of(install: Install) -> Iterator[tuple[str, str]]:
    """Yield where the items of a call go, and where they come from."""
    if install.kind not in ("DIRECTORY", "FILES") or not install.destination.startswith(_SHARE):
        return
    below = install.destination.removeprefix(_SHARE).partition("/")[2]
    for item in install.items:
        origin = item.value
        name = "" if origin.endswith("/") else posixpath.basename(origin)
        yield posixpath.normpath(posixpath.join(below, name)), origin.rstrip("/") or "."
