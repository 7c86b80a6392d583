"""Pictures of a robot and its trial, for readers without a 3D viewer and for print."""

from __future__ import annotations

import base64
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Any

from checker.base.background import Background, Work, work_key
from checker.base.cache import NO_CACHE, Cache
from checker.base.child_process import Child
from checker.base.parts import WorkerFailed
from checker.model.geometry.transform import Transform
from checker.physics.mesh.surface import Surface
from checker.report.report import Picture
from checker.report.scene.drawing.request import (
    Camera,
    Shot,
    camera_framing,
    drawn_items,
    request_of,
)
from checker.report.scene.processes import (
    DRAWING_LIMITS,
    PLATFORMS,
    drawing_module,
    drawing_process,
)
from checker.report.scene.scene import DisplayScene, Layer

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


# Which pictures are taken of a robot: of its shapes, and of moments of its trial.


MOMENTS = 3
"""Number of moments of the trial."""
_FROM_FRONT_LEFT, _FROM_SIDE = (212.0, -22.0), (262.0, -25.0)
"""Azimuth and elevation of the camera's direction, degrees: of the robot, of its path."""
_TILES = 8.0
"""Tiles of the ground from the camera to what it looks at, or up to two and a half times more."""
_ALONG_PATH = 12
"""Samples that a camera must see to see the whole path."""
_LEAST_MOTION = 0.02
"""Metres that parts move on average between two moments worth a picture each."""


def shots_of(scene: DisplayScene, aspect: float) -> Iterator[Shot]:
    """Yield the shots of a robot.

    Args:
        scene: The scene.
        aspect: Width of a picture over its height.
    """
    captions = {
        Layer.VISUAL: "The robot, from its front left",
        Layer.COLLISION: "Its collision shapes, from its front left",
    }
    for layer, caption in captions.items():
        if shot := shot_of(scene, layer, _FROM_FRONT_LEFT, aspect, caption):
            yield shot
    yield from _moments(scene, aspect)


def shot_of(
    scene: DisplayScene, layer: Layer, direction: tuple[float, float], aspect: float, caption: str
) -> Shot | None:
    """Return a shot of a robot at rest; None if nothing of a layer can be shown.

    Args:
        scene: The scene of the robot.
        layer: What is seen.
        direction: Azimuth and elevation of the line of sight, degrees.
        aspect: Width of the picture over its height.
        caption: A sentence without its dot.
    """
    boxes = _boxes(scene, layer)
    if not boxes:
        return None
    camera = camera_framing(_points(scene, boxes, 0), *direction, aspect)
    return Shot(caption, layer, camera, _tile(camera))


def _moments(scene: DisplayScene, aspect: float) -> Iterator[Shot]:
    """Yield the moments of a trial that differ most, from one place that sees all of it."""
    import numpy as np

    chosen = _distinct(scene)
    if scene.tracks is None or len(chosen) < 2:
        return
    layer = Layer.VISUAL if _boxes(scene, Layer.VISUAL) else Layer.COLLISION
    boxes = _boxes(scene, layer)
    if not boxes:
        return
    along = {*np.linspace(0, len(scene.tracks.time) - 1, _ALONG_PATH).astype(int), *chosen}
    points = np.concatenate([_points(scene, boxes, int(sample)) for sample in along])
    camera = camera_framing(points, *_FROM_SIDE, aspect)
    for sample in chosen:
        seconds, tile = float(scene.tracks.time[sample]), _tile(camera)
        caption = f"The trial after {seconds:.1f} s; tiles are {tile:g} m long"
        yield Shot(caption, layer, camera, tile, sample)


def _distinct(scene: DisplayScene) -> list[int]:
    """Return samples of the tracks, in order: the first, and those that differ most from others."""
    import numpy as np

    if scene.tracks is None or not scene.tracks.poses or not len(scene.tracks.time):
        return []
    places = np.stack([poses[:, :3] for poses in scene.tracks.poses.values()], axis=1)
    chosen = [0]
    while len(chosen) < MOMENTS:
        away = np.linalg.norm(places[:, None] - places[None, chosen], axis=3).mean(axis=2)
        nearest = away.min(axis=1)
        if not nearest.max() > _LEAST_MOTION:
            break
        chosen.append(int(nearest.argmax()))
    return sorted(chosen)


def _tile(camera: Camera) -> float:
    """Return the length of the ground's tiles, metres: 1, 2 or 5 times a power of ten."""
    whole = math.floor(math.log10(camera.distance / _TILES))
    steps = (step * 10.0**whole for step in (5, 2, 1))
    return next((step for step in steps if step <= camera.distance / _TILES), 10.0**whole)


def _boxes(scene: DisplayScene, layer: Layer) -> dict[int, Array]:
    """Return corners of boxes around what a layer shows, in the frames of the links (n × 3)."""
    import numpy as np

    by_number: dict[int, list[Array]] = {}
    for number, item in drawn_items(scene):
        if item.layer is layer:
            corners = _box(item.surfaces) * np.array(item.scale)
            by_number.setdefault(number, []).append(_moved(corners, item.pose))
    return {number: np.concatenate(corners) for number, corners in by_number.items()}


def _points(scene: DisplayScene, boxes: Mapping[int, Array], sample: int) -> Array:
    """Return the corners of boxes in the world, metres (n × 3)."""
    import numpy as np

    poses = scene.poses(sample)
    return np.concatenate(
        [_moved(corners, poses[scene.links[number].name]) for number, corners in boxes.items()]
    )


def _moved(points: Array, pose: Transform) -> Array:
    import numpy as np

    moved: Array = points @ np.array(pose.rotation).T + np.array(pose.translation)
    return moved


def _box(surfaces: Sequence[Surface]) -> Array:
    import numpy as np

    vertices = [surface.vertices for surface in surfaces if len(surface.vertices)]
    low = np.min([vertex.min(axis=0) for vertex in vertices], axis=0)
    high = np.max([vertex.max(axis=0) for vertex in vertices], axis=0)
    return np.array([*product(*zip(low, high, strict=True))], np.float64)


def ground_of(scene: DisplayScene) -> float:
    """Return the height of the ground: 0 in a trial's world, else below the robot."""
    import numpy as np

    if scene.tracks is not None:
        return 0.0
    boxes = (_boxes(scene, layer) for layer in (Layer.VISUAL, Layer.COLLISION))
    points = np.concatenate([_points(scene, box, 0) for box in boxes if box])
    return float(points[:, 2].min())


WIDTH, HEIGHT = 640, 480
"""Pixels."""
ASPECT = WIDTH / HEIGHT


@dataclass(eq=False)
class Drawing:
    """Pictures in the making, by a child process that may be there before its scene is.

    Attributes:
        cache: The cache of pictures.
        child: The process that draws, or waits for a scene.
    """

    cache: Cache = NO_CACHE
    child: Child | None = None
    _shots: tuple[Shot, ...] = ()
    _drawn: tuple[Background[list[bytes]], ...] = ()

    def begin(self) -> None:
        """Load what draws, while it is not known yet what."""
        if self.child is None:
            self.child = drawing_process()

    def stop(self) -> None:
        """Stop the process if it still runs."""
        for answer in self._drawn:
            answer.stop()
        if self.child is not None:
            self.child.stop()

    def give(self, scene: DisplayScene, shots: Sequence[Shot], form: str = "JPEG") -> None:
        """Report what to draw; it is drawn while the caller does something else.

        Args:
            scene: The scene of a robot.
            shots: Pictures of it.
            form: Of the files: JPEG, or PNG.
        """
        self._shots = tuple(shots)
        if self._shots:
            item = request_of(scene, self._shots, ground_of(scene), WIDTH, HEIGHT)
            item["form"] = form
            key = work_key([json.dumps(item)], ["report/scene/drawing"], ["mujoco"])
            self._drawn = tuple(self._background(key, item, platform) for platform in PLATFORMS)
            self._drawn[0].begin()

    @property
    def files(self) -> list[bytes] | WorkerFailed:
        """The files in the order of the shots, or why nothing can draw without a window."""
        files: list[bytes] | WorkerFailed = []
        for answer in self._drawn:
            files = answer.result()
            if not isinstance(files, WorkerFailed):
                break
        return files

    @property
    def pictures(self) -> tuple[Picture, ...]:
        """The files of JPEG as pictures; none if nothing can draw without a window."""
        files = self.files
        if isinstance(files, WorkerFailed):
            return ()
        return tuple(
            Picture(shot.caption, jpeg, WIDTH, HEIGHT)
            for shot, jpeg in zip(self._shots, files, strict=True)
        )

    def _background(
        self, key: str, item: Mapping[str, Any], platform: str
    ) -> Background[list[bytes]]:
        def decoded(answer: Any) -> list[bytes]:
            files = [base64.b64decode(file) for file in answer]
            if len(files) != len(self._shots):
                raise ValueError("another number of pictures")
            return files

        module = drawing_module(platform)
        work = Work("pictures", module, DRAWING_LIMITS, {key: item}, decoded)
        waiting = self.child if platform == PLATFORMS[0] else None
        return Background(work, self.cache, waiting)
