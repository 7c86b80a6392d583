"""The made-up folder under which xacro sees packages: `<ROOT>/<package>/<path>`."""

from __future__ import annotations

import posixpath
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from checker.package.package import Package

ROOT = "/subt-check-packages"


def path_of(package: Package, path: str) -> str:
    """Return how xacro sees a file of a package.

    Args:
        package: That is checked.
        path: As it lists the file; `../other/…` is a sibling's.
    """
    return posixpath.normpath(f"{ROOT}/{package.root.name}/{path}")


def package_in(path: str) -> str:
    """Return the name of the package in a path that xacro sees; empty outside all of them."""
    if not path.startswith(f"{ROOT}/"):
        return ""
    return posixpath.normpath(path).removeprefix(f"{ROOT}/").partition("/")[0]


def local_path(package: Package, path: str) -> str | None:
    """Return a path that xacro sees as the package lists it; None if no package at hand has it."""
    name = package_in(path)
    rest = posixpath.normpath(path).removeprefix(f"{ROOT}/{name}").lstrip("/")
    if not name:
        return None
    if name == package.root.name:
        return rest
    found = package.workspace.package(name)
    if found is None:
        return None
    return rest if found is package else f"../{found.name}/{rest}"
