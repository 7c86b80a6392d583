"""A request that has everything drawn once that other requests have drawn, as small as can be."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from checker.display.drawing.camera import Camera
from checker.display.files.wire import surface_to_json
from checker.display.surface import Surface

_GROUPS = (0, 1)
_AT_ORIGIN = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]


def rehearsal() -> Mapping[str, Any]:
    """Return what `request_of` would: of a plain, a coloured and a half transparent tetrahedron."""
    import numpy as np

    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], np.float32)
    faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], np.uint32)
    plain = Surface(corners, faces)
    coloured = Surface(corners, faces, vertex_colours=np.full((4, 4), 200, np.uint8))
    geoms = [
        {"mesh": mesh, "link": 0, "group": group, "pose": _AT_ORIGIN, "colour": [0.7, 0.7, 0.7, a]}
        for mesh, group, a in ((0, 0, 1.0), (1, 0, 1.0), (0, 1, 0.5))
    ]
    camera = Camera((0.0, 0.0, 0.0), 3.0, -45.0, -20.0).as_json()
    poses = [_AT_ORIGIN]
    return {
        "width": 64,
        "height": 48,
        "ground": 0.0,
        "meshes": [surface_to_json(plain), surface_to_json(coloured)],
        "links": [0],
        "geoms": geoms,
        "shots": [
            {"group": each, "camera": camera, "tile": 1.0, "see_through": each == 1, "poses": poses}
            for each in _GROUPS
        ],
    }
