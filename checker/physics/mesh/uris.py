"""Where the URI of a mesh leads within the workspace."""

from __future__ import annotations

import posixpath
import re
from pathlib import Path

from checker.base.record import Record
from checker.model.mesh import MeshFault, MeshTrouble
from checker.package.fuel import is_on_fuel, path_from_fuel
from checker.package.package import Package

_SCHEME = re.compile(r"(?:model|package)://([^/]+)/(.*)", re.DOTALL)
_ELSEWHERE = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:|/")


class MeshFile(Record):
    """A file within the workspace.

    Attributes:
        path: Relative to the package, with `/`.
        location: Where it lies on disk, links resolved.
    """

    path: str
    location: Path


def file_behind(package: Package, folder: str, uri: str) -> MeshFile | MeshFault:
    """Return the file that a URI leads to.

    Args:
        package: Whose robot names it.
        folder: Of the file that states it, relative to the package.
        uri: As written.
    """
    if named := _SCHEME.match(uri):
        other, path = named.groups()
        # Models on Fuel bear the package's name in upper case.
        if other.casefold() != package.name.casefold():
            sibling = package.workspace.package(other)
            if sibling is None:
                return _beyond(f"is in {other}, which is not available")
            path = f"../{sibling.name}/{path}"
    elif is_on_fuel(uri):
        on_fuel = path_from_fuel(package, uri)
        if on_fuel is None:
            return _beyond("is on Fuel, in a model that is not available")
        path = on_fuel
    elif _ELSEWHERE.match(uri):
        return _beyond("is outside the workspace")
    else:
        path = posixpath.join(folder, uri)
    path = posixpath.normpath(path)
    entry = package.resolve(path)
    if entry is not None and entry.is_file:
        return MeshFile(path, entry.location)
    other = path.split("/")[1] if path.startswith("../") else ""
    if other and other != package.root.name and package.workspace.package(other) is None:
        return _beyond(f"is in {other}, which is not available")
    return MeshFault(MeshTrouble.MISSING, "does not exist")


def _beyond(reason: str) -> MeshFault:
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, reason)
