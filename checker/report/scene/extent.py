"""Extent of the shown scene."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from checker.base.record import Record
from checker.model.geometry.transform import Transform, Vector
from checker.physics.mesh.surface import Surface
from checker.report.scene.scene import DisplayScene, Item, Layer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

_SHAPES = (Layer.VISUAL, Layer.COLLISION)
_LEAST = 0.01
"""Metres, of shapes without extent."""
_UNSEEN = 0.5
"""Metres: at least the size of a robot of which nothing is to see."""


class Sphere(Record):
    """A sphere around something, metres."""

    centre: Vector
    radius: float


def sphere_of(scene: DisplayScene) -> Sphere:
    """Return a sphere around the shapes of a robot where its motion begins, in the world."""
    hung = [(link.name, item) for link in scene.links for item in link.items]
    return sphere_around(hung, scene.poses())


def sphere_around(hung: Iterable[tuple[str, Item]], frames: Mapping[str, Transform]) -> Sphere:
    """Return a sphere around visuals and collisions; without any, around the links' frames.

    Args:
        hung: Items, each with the name of its link.
        frames: Poses of the links.
    """
    import numpy as np

    boxes: dict[int, Array] = {}
    least = _LEAST
    points = [
        _placed(corners, item, frames[link])
        for link, item in hung
        if item.layer in _SHAPES
        for corners in _corners(item.surfaces, boxes)
    ]
    if not points:
        least = _UNSEEN
        points = [np.array([frame.translation]) for frame in frames.values()]
    every = np.concatenate(points) if points else np.zeros((1, 3))
    low, high = every.min(axis=0), every.max(axis=0)
    x, y, z = ((low + high) / 2.0).tolist()
    return Sphere((x, y, z), max(math.dist(low, high) / 2.0, least))


def _corners(surfaces: Iterable[Surface], boxes: dict[int, Array]) -> Iterable[Array]:
    """Yield the corners of each surface's box; those of shared vertices are computed once."""
    import numpy as np

    for surface in surfaces:
        number = id(surface.vertices)
        if number not in boxes:
            ends = np.stack([surface.vertices.min(axis=0), surface.vertices.max(axis=0)])
            grid = np.meshgrid(*ends.T.astype(float), indexing="ij")
            boxes[number] = np.stack(grid, axis=-1).reshape(-1, 3)
        yield boxes[number]


def _placed(points: Array, item: Item, frame: Transform) -> Array:
    import numpy as np

    pose = frame @ item.pose
    placed: Array = (points * item.scale) @ np.array(pose.rotation).T + pose.translation
    return placed
