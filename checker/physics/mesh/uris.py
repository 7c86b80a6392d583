"""Target of the URI of a mesh within the workspace."""

from __future__ import annotations

from pathlib import Path

from checker.base.record import Record
from checker.model.mesh import MeshFault, MeshTrouble
from checker.package.package import Package
from checker.package.uris import Unknown, path_behind


class MeshFile(Record):
    """A file within the workspace.

    Attributes:
        path: The path relative to the package, with `/`.
        location: The place on disk, links resolved.
    """

    path: str
    location: Path


def file_behind(package: Package, folder: str, uri: str) -> MeshFile | MeshFault:
    """Return the file that a URI leads to.

    Args:
        package: The package whose robot names it.
        folder: The folder of the file that states it, relative to the package.
        uri: The URI as written.
    """
    path = path_behind(package, folder, uri)
    if isinstance(path, Unknown):
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, path.reason)
    entry = package.resolve(path)
    if entry is not None and entry.is_file:
        return MeshFile(path, entry.location)
    return MeshFault(MeshTrouble.MISSING, "does not exist")
