"""Hover text of the file that a URI names; of a mesh, its size and its triangles."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator

from checker.base.extras import PHYSICS
from checker.base.parts import NotAvailable
from checker.editor.card import card, code, escaped_words
from checker.editor.figures import number, numbers, size
from checker.engine.subject import Subject
from checker.model.mesh import Mesh, MeshFault
from checker.model.robot import Robot
from checker.package.index import FileEntry
from checker.package.uris import Unknown, path_behind
from checker.physics.mesh.package_meshes import PackageMeshes
from checker.physics.mesh.process import MeshServer
from checker.source.text import Located

MESHES = (".dae", ".stl", ".obj")
READ_AT_ONCE = 5_000_000
"""Bytes of a mesh that a hover reads by itself; a larger one takes seconds."""


def file_card(
    subject: Subject, uri: Located[str], scale: tuple[float, ...] = (1.0, 1.0, 1.0)
) -> str:
    """Return what is known of the file behind a URI, as Markdown.

    Args:
        subject: The package.
        uri: The URI as written, with its place: relative ones start there.
        scale: The scale of the shape that uses a mesh, along x, y, z.
    """
    path = path_behind(subject.package, Robot.folder_of(uri), uri.value)
    if isinstance(path, Unknown):
        return card(f"**file** {code(uri.value)}", [], f"It {escaped_words(path.reason)}.")
    entry = subject.package.resolve(path)
    if entry is None:
        return card(f"**file** {code(path)}", [], "It does not exist.")
    if entry.is_folder:
        return card(f"**folder** {code(path)}", [])
    if not path.lower().endswith(MESHES):
        return card(f"**file** {code(path)}", [("file", size(entry.size))])
    return _mesh_card(subject, uri, path, entry, scale)


def _mesh_card(
    subject: Subject, uri: Located[str], path: str, entry: FileEntry, scale: tuple[float, ...]
) -> str:
    found = _mesh(subject, uri, entry)
    rows = [*_figures(found, scale)] if isinstance(found, Mesh) else []
    rows.append(("file", size(entry.size)))
    note = f"Not read: {found}." if isinstance(found, str) else ""
    if isinstance(found, MeshFault):
        note = f"{code(posixpath.basename(path))} {escaped_words(found.reason)}."
    return card(f"**mesh** {code(path)}", rows, note)


def _mesh(subject: Subject, uri: Located[str], entry: FileEntry) -> Mesh | MeshFault | str:
    """Return the content of a mesh file, or in Markdown why it is not read in the short time."""
    robots = subject.all(Robot)
    for meshes in () if isinstance(robots, NotAvailable) else (it.meshes for it in robots):
        if isinstance(meshes, PackageMeshes) and _names(meshes, uri):
            known = meshes.load_known(uri)
            if known is not None:
                return known
    reader = subject.one(MeshServer)
    server = None if isinstance(reader, NotAvailable) else reader.server
    alone = PackageMeshes(subject.package, (uri,), subject.cache, subject.stages, server)
    if (known := alone.load_known(uri)) is not None:
        return known
    if not PHYSICS.is_installed:
        return code(PHYSICS.remedy)
    if entry.size > READ_AT_ONCE:
        return f"a file of {size(entry.size)} is read when the package is checked"
    return alone.load(uri)


def _names(meshes: PackageMeshes, uri: Located[str]) -> bool:
    address = Robot.folder_of(uri), uri.value
    return any((Robot.folder_of(it), it.value) == address for it in meshes.uris)


def _figures(mesh: Mesh, scale: tuple[float, ...]) -> Iterator[tuple[str, str]]:
    own = [high - low for low, high in zip(mesh.low, mesh.high, strict=True)]
    used = [abs(length * factor) for length, factor in zip(own, scale, strict=True)]
    text = f"{' × '.join(map(number, used))} m"
    yield "size", text + (f", scaled by {numbers(scale)}" if set(scale) != {1.0} else "")
    yield "triangles", f"{mesh.triangles}"
    if mesh.metres_per_unit != 1.0:
        yield "unit of the file", f"{number(mesh.metres_per_unit)} m"
    if mesh.volume is not None:
        yield "volume", f"{number(abs(mesh.volume * scale[0] * scale[1] * scale[2]))} m³"
    yield "surface", "watertight" if mesh.watertight else "not watertight"
    yield "textures", ", ".join(map(code, mesh.textures))
