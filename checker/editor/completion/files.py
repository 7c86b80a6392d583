"""Files and folders, where XML names one: packages, then the content of the folder."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator

from checker.base.record import Record
from checker.editor.completion.expressions import packages
from checker.editor.completion.item import Completion, CompletionKind, Request
from checker.editor.figures import size
from checker.editor.xml_context import Where
from checker.package.index import FileEntry
from checker.package.package import Package

_MESHES = (".dae", ".stl", ".obj", ".glb", ".gltf", ".fbx")
_PICTURES = (".png", ".jpg", ".jpeg", ".tga", ".dds")
_SCHEMES = ("package://", "model://", "file://")
_FIND = re.compile(r"(?:file://)?\$\(find\s+([\w.-]+)\s*\)(/.*)?\Z", re.DOTALL)
_NAMED = re.compile(r"(?:package|model)://([^/]*)(/.*)?\Z", re.DOTALL)
_MAPS = ("albedo_map", "normal_map", "roughness_map", "metalness_map", "ambient_occlusion_map")
_LIMIT = 500
"""Files and folders that are offered."""


class _Wanted(Record):
    """Kind of file that a place names; folders are on the way to all of them."""

    suffixes: tuple[str, ...]
    is_model: bool = False


def files(request: Request) -> Iterator[Completion]:
    """Yield packages, folders and files that may continue the path at the caret."""
    wanted = _wanted_kind(request)
    if wanted is None:
        return
    typed = request.xml.typed
    if (match := _FIND.match(typed) or _NAMED.match(typed)) is not None:
        if match[2] is None:
            yield from _packages(request, typed)
        elif (holder := _package(request, match[1])) is not None:
            yield from _entries(request, holder, match[2].lstrip("/"), wanted)
        return
    relative = typed.removeprefix("file://")
    if ":" not in relative and not relative.startswith("/"):
        below = posixpath.join(posixpath.dirname(request.path), relative)
        if ".." not in below.split("/"):
            yield from _entries(request, request.subject.package, below, wanted)
    if "/" not in typed:
        yield from _starts(request, wanted)


def _wanted_kind(request: Request) -> _Wanted | None:
    """Return what kind of file the caret's place names; None if it names none."""
    xml = request.xml
    if xml.where is Where.VALUE and xml.attribute == "filename":
        named = {"mesh": _MESHES, "texture": _PICTURES, "xacro:include": (".xacro", ".urdf")}
        return _Wanted(named[xml.tag]) if xml.tag in named else None
    if xml.where is not Where.TEXT or not xml.tags:
        return None
    if xml.tags[-1] in _MAPS:
        return _Wanted(_PICTURES)
    if xml.tags[-1] != "uri":
        return None
    if xml.tags[-2:-1] == ("include",):
        return _Wanted((".sdf", ".urdf"), is_model=True)
    in_material = xml.tags[-2:-1] == ("script",)
    return _Wanted((".material", *_PICTURES) if in_material else _MESHES)


def _starts(request: Request, wanted: _Wanted) -> Iterator[Completion]:
    """Yield how a URI may begin, and whole URIs of the package's own files."""
    package = request.subject.package
    is_urdf = request.enclosing_place.language == "urdf" or request.enclosing_place.is_extension
    if request.xml.tag == "xacro:include":
        start = f"$(find {package.declared_name})/"
    else:
        start = f"package://{package.declared_name}/" if is_urdf else ""
        for scheme in _SCHEMES:
            rank = 3 if scheme.startswith("package") == is_urdf else 6
            yield request.item(scheme, CompletionKind.FOLDER, rank=rank)
    entries = package.index.with_suffix(*wanted.suffixes)[:_LIMIT]
    folder = posixpath.dirname(request.path)
    for entry in entries:
        path = start + entry.path if start else posixpath.relpath(entry.path, folder or ".")
        if entry.path != request.path:
            yield request.item(path, CompletionKind.FILE, detail=size(entry.size), rank=2)


def _packages(request: Request, typed: str) -> Iterator[Completion]:
    """Yield the packages of the workspace, in place of the name written so far."""
    if typed.startswith(("$", "file")):
        return
    start = request.xml.start + typed.index("://") + len("://")
    for rank, name in enumerate(packages(request)[:_LIMIT]):
        at = 0 if rank == 0 else 5
        yield request.item(name, CompletionKind.PACKAGE, insert=f"{name}/", rank=at, start=start)


def _package(request: Request, name: str) -> Package | None:
    own = request.subject.package
    is_own = name in (own.declared_name, own.name, own.root.name)
    return own if is_own else own.workspace.package(name)


def _entries(
    request: Request, package: Package, written: str, wanted: _Wanted
) -> Iterator[Completion]:
    """Yield what is in the folder written so far, in place of the last name."""
    folder, _, last = written.rpartition("/")
    start = request.offset - len(last)
    prefix = f"{posixpath.normpath(folder)}/" if folder else ""
    seen = 0
    for entry in package.index.entries.values():
        name = entry.path.removeprefix(prefix)
        if "/" in name or not entry.path.startswith(prefix) or name.startswith("."):
            continue
        if (item := _entry(request, package, entry, name, wanted, start)) is not None:
            seen += 1
            yield item
        if seen >= _LIMIT:
            return


def _entry(
    request: Request, package: Package, entry: FileEntry, name: str, wanted: _Wanted, start: int
) -> Completion | None:
    if entry.is_folder:
        has_some = _holds(package, entry.path, wanted)
        is_model = wanted.is_model and package.exists(f"{entry.path}/model.config")
        insert = name if is_model else f"{name}/"
        rank = 0 if has_some or is_model else 4
        return request.item(name, CompletionKind.FOLDER, insert=insert, rank=rank, start=start)
    if not entry.is_file or entry.path == request.path:
        return None
    rank = 1 if name.lower().endswith(wanted.suffixes) else 8
    detail = size(entry.size)
    return request.item(name, CompletionKind.FILE, detail=detail, rank=rank, start=start)


def _holds(package: Package, folder: str, wanted: _Wanted) -> bool:
    found = package.index.with_suffix(*wanted.suffixes)
    return any(entry.path.startswith(f"{folder}/") for entry in found)
