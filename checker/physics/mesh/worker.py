"""Reads mesh files in a child process: the module behind `checker.base.child_process`."""

from __future__ import annotations

import json
from functools import partial
from importlib import import_module
from time import monotonic

from checker.base.disk_file import NotReadable
from checker.base.forked_work import Ended, all_apart
from checker.base.sandbox.files import Files
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.physics.mesh.limits import LATE, SECONDS_FOR_ALL
from checker.physics.mesh.reader import load_libraries, read_mesh
from checker.physics.mesh.wire import to_json


def prepare() -> None:
    """Import what every file needs, before it is known which files there are."""
    import_module("scipy.spatial")


def answer(request: bytes, files: Files) -> bytes:
    """Read files.

    Args:
        request: JSON: `files`, pairs of the name under which a file was handed over and the one by
            which the model knows it (its ending says the format); and `seconds` of processor time
            each.
        files: The files.

    Returns:
        JSON: what each file holds, in the same order.
    """
    asked = json.loads(request)
    load_libraries(name for _, name in asked["files"])
    works = [partial(_as_bytes, files, at, name) for at, name in asked["files"]]
    read = all_apart(works, asked["seconds"], monotonic() + SECONDS_FOR_ALL, LATE)
    return b"[" + b",".join(map(_said, read)) + b"]"


def _said(read: bytes | Ended) -> bytes:
    if isinstance(read, Ended):
        return json.dumps(to_json(MeshFault(MeshTrouble.NOT_LOOKED_AT, read.reason))).encode()
    return read


def _as_bytes(files: Files, at: str, name: str) -> bytes:
    return json.dumps(to_json(_read(files, at, name))).encode()


def _read(files: Files, at: str, name: str) -> Mesh | MeshFault:
    data = files.read(at)
    if isinstance(data, NotReadable):
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, data.reason)
    return read_mesh(data, name)
