"""Request to the child process that draws: groups of shapes, shots, and camera poses."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from msgspec import to_builtins

from checker.base.record import Record
from checker.model.geometry.transform import Transform
from checker.physics.mesh.surface import Surface, surface_to_json
from checker.physics.trial.mjcf.names import is_finite_pose, quaternion
from checker.report.scene.scene import DisplayScene, Item, Layer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


# Where a camera stands so that a picture shows all of something and little else.


FIELD_OF_VIEW = 35.0
"""Degrees from the lower edge of a picture to the upper one: a portrait lens distorts little."""
_MARGIN = 1.12
"""Ratio of the size of the picture to that of the shown robot."""


class Camera(Record):
    """A camera as MuJoCo has it.

    Attributes:
        lookat: The middle of the picture, metres.
        distance: The distance from that point, metres.
        azimuth: The azimuth of the view direction, degrees about z from x.
        elevation: The elevation of that direction, degrees above the horizon.
    """

    lookat: tuple[float, float, float]
    distance: float
    azimuth: float
    elevation: float

    def as_json(self) -> dict[str, Any]:
        """Return its figures by name."""
        members: dict[str, Any] = to_builtins(self)
        return members


def camera_framing(points: Array, azimuth: float, elevation: float, aspect: float) -> Camera:
    """Return the nearest camera of a direction that sees all points.

    Args:
        points: Metres (n × 3), at least one.
        azimuth: Degrees; see `Camera`.
        elevation: Degrees.
        aspect: Width of the picture over its height.
    """
    import numpy as np

    turn, rise = math.radians(azimuth), math.radians(elevation)
    forward = np.array(
        [math.cos(rise) * math.cos(turn), math.cos(rise) * math.sin(turn), math.sin(rise)]
    )
    right = np.array([math.sin(turn), -math.cos(turn), 0.0])
    up = np.cross(right, forward)
    half_high = math.tan(math.radians(FIELD_OF_VIEW) / 2.0) / _MARGIN
    axes = np.array([forward, right, up]).T

    def seen_from(middle: Array) -> tuple[Array, float]:
        """Return how far ahead, right and up the points are, and the distance that sees all."""
        depth, across, high = seen = ((points - middle) @ axes).T
        needed = np.maximum(np.abs(across) / (half_high * aspect), np.abs(high) / half_high) - depth
        return seen, float(needed.max())

    middle = (points.min(axis=0) + points.max(axis=0)) / 2.0
    # Twice: the middle of what is seen is not that of the box, as near things look larger.
    for _ in range(2):
        (depth, across, high), distance = seen_from(middle)
        away = np.maximum(depth + distance, 1e-9)
        shift = _middle(across / away) * right + _middle(high / away) * up
        middle = middle + shift * distance
    _, distance = seen_from(middle)
    x, y, z = (float(number) for number in middle)
    return Camera((x, y, z), max(distance, 1e-3) * 1.02, azimuth, elevation)


def _middle(numbers: Array) -> float:
    return float(numbers.min() + numbers.max()) / 2.0


GROUPS = {Layer.VISUAL: 0, Layer.COLLISION: 1}
"""The layers that are drawn, and the numbers by which shots choose them."""
_FARTHEST = 1e5
"""Metres; what reaches farther is not drawn."""
_ITEMS = 2000
"""Greatest number of items of a robot in each layer."""
_TRIANGLES = 1_000_000
"""Likewise, each as often as it is shown: what draws them takes some 100 bytes for each, for which
no limit of address space can be set, since graphics cards need more of it than there is memory."""


class Shot(Record):
    """One picture.

    Attributes:
        caption: A sentence without its dot.
        layer: The visible layer.
        camera: The camera.
        tile: Length of the ground's tiles, metres.
        sample: The number of the sample of the tracks.
    """

    caption: str
    layer: Layer
    camera: Camera
    tile: float = 1.0
    sample: int = 0


@dataclass(eq=False)
class _Meshes:
    """Surfaces as they are used: one entry for each that is used at one scale."""

    known: dict[tuple[int, int, int, tuple[float, ...]], int] = field(default_factory=dict)
    written: list[dict[str, Any]] = field(default_factory=list)

    def number(self, surface: Surface, scale: tuple[float, float, float]) -> int:
        colours = surface.vertex_colours
        key = (id(surface.vertices), id(surface.faces), id(colours), scale)
        if key not in self.known:
            self.known[key] = len(self.written)
            self.written.append(surface_to_json(_scaled(surface, scale)))
        return self.known[key]


def request_of(
    scene: DisplayScene, shots: Sequence[Shot], ground: float, width: int, height: int
) -> dict[str, Any]:
    """Return what the worker needs to know.

    Args:
        scene: The scene of the robot.
        shots: Pictures of it.
        ground: Height of the ground, metres.
        width: The width of a picture, pixels.
        height: The height of a picture, pixels.
    """
    meshes = _Meshes()
    shown = list(drawn_items(scene))
    geoms = [
        {
            "mesh": meshes.number(surface, item.scale),
            "link": number,
            "group": GROUPS[item.layer],
            "pose": _seven(item.pose),
            "colour": surface.colour,
        }
        for number, item in shown
        for surface in item.surfaces
        if len(surface.faces)
    ]
    used = sorted({number for number, _ in shown})
    return {
        "width": width,
        "height": height,
        "ground": ground,
        "meshes": meshes.written,
        "links": used,
        "geoms": geoms,
        "shots": [_shot(scene, shot, used) for shot in shots],
    }


def drawn_items(scene: DisplayScene) -> Iterator[tuple[int, Item]]:
    """Yield what is drawn, each with the number of its link."""
    items, triangles = dict.fromkeys(GROUPS, _ITEMS), dict.fromkeys(GROUPS, _TRIANGLES)
    for number, link in enumerate(scene.links):
        for item in link.items:
            size = sum(len(surface.faces) for surface in item.surfaces)
            if items.get(item.layer, 0) and size <= triangles[item.layer] and _is_sound(item):
                items[item.layer] -= 1
                triangles[item.layer] -= size
                yield number, item


def _is_sound(item: Item) -> bool:
    import numpy as np

    corners = [surface.vertices for surface in item.surfaces if len(surface.vertices)]
    if not corners or not is_finite_pose(item.pose):
        return False
    largest = max(float(np.abs(corner).max()) for corner in corners) * max(map(abs, item.scale))
    return 0.0 < largest < _FARTHEST


def _scaled(surface: Surface, scale: tuple[float, float, float]) -> Surface:
    import numpy as np

    x, y, z = scale
    # Mirrored triangles are turned, so that their outer sides stay outside.
    faces = surface.faces[:, ::-1] if x * y * z < 0.0 else surface.faces
    vertices = surface.vertices * np.array(scale, np.float32)
    return Surface(vertices, faces, vertex_colours=surface.vertex_colours)


def _shot(scene: DisplayScene, shot: Shot, links: Sequence[int]) -> Mapping[str, Any]:
    poses = scene.poses(shot.sample)
    return {
        "group": GROUPS[shot.layer],
        "camera": shot.camera.as_json(),
        "tile": shot.tile,
        "see_through": shot.layer is Layer.COLLISION,
        "poses": [_seven(poses[scene.links[number].name]) for number in links],
    }


def _seven(pose: Transform) -> list[float]:
    return [*pose.translation, *quaternion(pose.rotation)]
