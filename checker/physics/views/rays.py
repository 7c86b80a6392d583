"""Rays that represent the view of a sensor: a grid of equal steps in azimuth and elevation."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Sensor
from checker.model.sensing.camera import Camera
from checker.model.sensing.lidar import Lidar, Scan

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

_CAMERA = (24, 18)
_LIDAR = (72, 8)
"""Rays across and up: a share of the view is then right to a few hundredths."""
_WIDEST = 2.8
"""Radians; wider pictures are no pinhole's, and all rays weigh alike."""
_LEAST_STEP = 1e-9
_ENDLESS = 1e9


class Steps(Record):
    """Angles in the middle of equal steps, radians."""

    lower: float
    upper: float
    number: int

    @property
    def middle(self) -> float:
        """Half way between the first and the last."""
        return (self.lower + self.upper) / 2.0

    @property
    def reach(self) -> float:
        """The angle farthest from 0, either way."""
        return max(abs(self.lower), abs(self.upper))

    @property
    def step(self) -> float:
        """The step from one angle to the next; never 0."""
        return max((self.upper - self.lower) / self.number, _LEAST_STEP)

    @property
    def first(self) -> float:
        """The first angle."""
        return self.middle - (self.number - 1) / 2.0 * self.step


class Grid(Record, dict=True):
    """Rays from a sensor, in its own frame: x ahead, y to the left, z up.

    Attributes:
        across: Azimuths, to the left.
        up: Elevations.
        near: Metres at which it begins to see: along x for a camera, along the ray for a lidar.
        far: Metres along the ray at which it ends.
        picture: Tangents of half the width and height of a camera's picture; none for a lidar.
    """

    across: Steps
    up: Steps
    near: float
    far: float
    picture: tuple[float, float] | None = None

    @cached_property
    def directions(self) -> NDArray[float64]:
        """Unit vectors (n × 3), row by row from below."""
        import numpy as np

        azimuth, elevation = self._angles
        flat = np.cos(elevation)
        return np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)], axis=1)

    @property
    def azimuths(self) -> NDArray[float64]:
        """The azimuth of each ray, radians."""
        return self._angles[0]

    @cached_property
    def weights(self) -> NDArray[float64]:
        """Share of the view that each ray represents; 0 for those beyond the picture's edge."""
        import numpy as np

        azimuth, elevation = self._angles
        if self.picture is None:
            weights = np.ones(len(azimuth))
        else:
            x, y, z = self.directions.T
            inside = (np.abs(y) <= self.picture[0] * x) & (np.abs(z) <= self.picture[1] * x)
            # Pixels that a step in azimuth and elevation takes up: d(y/x, z/x).
            weights = np.where(inside, 1.0 / (np.cos(azimuth) ** 3 * np.cos(elevation) ** 2), 0.0)
        total = weights.sum()
        return np.asarray(weights / total if total > 0.0 else weights)

    @cached_property
    def near_along(self) -> NDArray[float64]:
        """Metres along each ray at which the sensor begins to see."""
        import numpy as np

        if self.picture is None:
            return np.full(len(self.directions), self.near)
        return np.asarray(self.near / np.maximum(self.directions[:, 0], _LEAST_STEP))

    @cached_property
    def _angles(self) -> tuple[NDArray[float64], NDArray[float64]]:
        import numpy as np

        across, up = (
            steps.first + steps.step * np.arange(steps.number) for steps in (self.across, self.up)
        )
        return np.tile(across, self.up.number), np.repeat(up, self.across.number)


def grid_of(sensor: Sensor) -> Grid | None:
    """Return the rays of a camera or lidar; None for others, and for views that are none."""
    grid = None
    if sensor.camera is not None and sensor.kind.takes_pictures:
        grid = _of_camera(sensor.camera)
    elif sensor.lidar is not None and sensor.kind.is_lidar:
        grid = _of_lidar(sensor.lidar)
    return grid


def _of_camera(camera: Camera) -> Grid | None:
    width, angle = camera.width.value, camera.horizontal_fov.value
    aspect = camera.height.value / width if width > 0.0 else 0.0
    near, far = camera.clip.near.value, camera.clip.far.value
    if not (0.0 < angle <= 2 * math.pi and 0.0 < aspect < math.inf) or not _is_range(near, far):
        return None
    if angle > _WIDEST:
        half = min(angle * aspect, math.pi) / 2.0
        return Grid(_steps(angle / 2, _CAMERA[0]), _steps(half, _CAMERA[1]), near, far)
    wide = math.tan(angle / 2.0)
    high = wide * aspect
    up = _steps(math.atan(high), _CAMERA[1])
    return Grid(_steps(angle / 2.0, _CAMERA[0]), up, near, far, (wide, high))


def _of_lidar(lidar: Lidar) -> Grid | None:
    near, far = lidar.range_min.value, lidar.range_max.value
    # One row gets as many rays as eight: thin posts are in it.
    rows = int(min(max(lidar.vertical.samples.value, 1.0), _LIDAR[1]))
    across = _scanned(lidar.horizontal, _LIDAR[0] * _LIDAR[1] // rows)
    up = _scanned(lidar.vertical, _LIDAR[1])
    if across is None or up is None or not _is_range(near, far):
        return None
    return Grid(across, up, near, far)


def _steps(half: float, number: int) -> Steps:
    return Steps(-half, half, number)


def _scanned(scan: Scan, most: int) -> Steps | None:
    angles: Sequence[float] = sorted((scan.lower.value, scan.upper.value))
    samples = scan.samples.value
    if not all(abs(angle) <= 2 * math.pi for angle in angles) or not samples >= 1.0:
        return None
    return Steps(angles[0], angles[1], int(min(samples, most)))


def _is_range(near: float, far: float) -> bool:
    return 0.0 <= near < min(far, _ENDLESS)
