"""Reads mesh files in a child process: the module behind `checker.physics.mesh.process`.

A request has `items` and the `wanted` results: facts or the appearance of files, or what sensors
see of them. Each file is read in a fork, so that one which takes its reader down costs only itself.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from typing import Any

from msgspec import to_builtins

from checker.base.files import NotReadable
from checker.base.forked_work import ForkRunner, as_entry, forks_time, run_all_in_forks
from checker.base.parts import WorkerFailed
from checker.base.sandbox.files import Files
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.physics.mesh.appearance import appearances
from checker.physics.mesh.reader import load_libraries, read_mesh
from checker.physics.views.visibility import sensors_of, unread_mesh, views_of, visibility_of_mesh


def prepare() -> None:
    """Import what every file needs, before it is known which files there are."""
    import_module("scipy.spatial")


def answer(request: bytes, files: Files) -> bytes:
    """Read files.

    Args:
        request: JSON: `wanted`, one of `facts`, `appearance` and `views`; `items`, of the form that
            this needs; `seconds` of processor time for a file, and `seconds_for_all`.
        files: The files.

    Returns:
        JSON: what is wanted of each item.
    """
    data = json.loads(request)
    late = f"had no time left: the others took {data['seconds_for_all']} s of processor time"
    until = forks_time() + data["seconds_for_all"]
    run_in_forks = partial(run_all_in_forks, seconds=data["seconds"], until=until, late=late)
    load_libraries(files.names)
    return b"[" + b",".join(_WANTED[data["wanted"]](data["items"], files, run_in_forks)) + b"]"


def _facts(
    items: Sequence[Mapping[str, Any]], files: Files, run_in_forks: ForkRunner
) -> list[bytes]:
    """Return the content of files.

    Each item has a `file`, the `name` that the model knows, and the parts `picked`.
    """
    read = run_in_forks([partial(_fact, item, files) for item in items])
    return [*map(as_entry, read)]


def _fact(item: Mapping[str, Any], files: Files) -> bytes:
    data = files.read(item["file"])
    if isinstance(data, NotReadable):
        return _as_json(MeshFault(MeshTrouble.NOT_LOOKED_AT, data.reason))
    return _as_json(read_mesh(data, item["name"], item.get("picked", ())))


def _given_up(failed: WorkerFailed) -> MeshFault:
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, failed.reason)


def _as_json(read: Mesh | MeshFault) -> bytes:
    kind = "fault" if isinstance(read, MeshFault) else "mesh"
    return json.dumps({kind: to_builtins(read)}).encode()


def _views(
    items: Sequence[Mapping[str, Any]], files: Files, run_in_forks: ForkRunner
) -> list[bytes]:
    """Return what sensors see; see `views_of`."""
    return [as_entry(_view(item, files, run_in_forks)) for item in items]


def _view(item: Mapping[str, Any], files: Files, run_in_forks: ForkRunner) -> bytes | WorkerFailed:
    sensors = sensors_of(item)

    def seen(mesh: Mapping[str, Any]) -> bytes:
        data = files.read(mesh["file"])
        return json.dumps(visibility_of_mesh(sensors, mesh, data, item.get("lights", ()))).encode()

    results = run_in_forks([partial(seen, mesh) for mesh in item["meshes"]])
    for result in results:
        if isinstance(result, WorkerFailed) and result.momentary:
            return result
    read = [
        unread_mesh(_given_up(result)) if isinstance(result, WorkerFailed) else json.loads(result)
        for result in results
    ]
    (views,) = run_in_forks([lambda: json.dumps(views_of(item, sensors, read)).encode()])
    return views


_WANTED: dict[str, Callable[[Sequence[Any], Files, ForkRunner], list[bytes]]] = {
    "facts": _facts,
    "appearance": appearances,
    "views": _views,
}
