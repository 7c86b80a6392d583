"""Meshes as JSON: between the processes, and on disk."""

from __future__ import annotations

from typing import Any

from msgspec import to_builtins

from checker.model.mesh import Mesh, MeshFault, MeshTrouble

_LISTS = ("textures", "materials", "defects", "parts")
_POINTS = ("low", "high")


def to_json(read: Mesh | MeshFault) -> dict[str, Any]:
    """Return what JSON can express; see `from_json`."""
    return {"fault" if isinstance(read, MeshFault) else "mesh": to_builtins(read)}


def from_json(data: Any) -> Mesh | MeshFault:
    """Return what `to_json` was given.

    Raises:
        ValueError: It is something else.
    """
    try:
        if "fault" in data:
            return MeshFault(MeshTrouble(data["fault"]["trouble"]), data["fault"]["reason"])
        fields = dict(data["mesh"])
        for name in (*_LISTS, *_POINTS):
            fields[name] = tuple(fields[name])
        fields["hull"] = tuple((x, y, z) for x, y, z in fields["hull"])
        return Mesh(**fields)
    except (TypeError, KeyError, AttributeError) as error:
        raise ValueError(f"no mesh: {error}") from error
