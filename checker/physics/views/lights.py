"""Shares of a light's cone that one mesh blocks nearby, by rays from the light."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from checker.physics.views.obstacles import first_hits
from checker.physics.views.rays import Grid, Steps

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    Array = NDArray[float64]

_ENDLESS = 1e9
_AROUND = Grid(Steps(-math.pi, math.pi, 36), Steps(-math.pi / 2, math.pi / 2, 18), 0.0, _ENDLESS)
_ACROSS = 12
"""Rays across a beam, and up."""


def covered_shares(corners: Array, light: Mapping[str, Any]) -> tuple[float, float]:
    """Return the share of all directions in which a light meets triangles, and of its beam.

    Both sides of a triangle count: shadows fall from each.

    Args:
        corners: The corners of triangles (n × 3 × 3), metres, in the robot's frame.
        light: Its position (`at`), and the axis (`along`) and half the angle (`half`) of its beam,
            if it does not shine all around.
    """
    import numpy as np

    turned = _frame(np.array(light.get("along", (1.0, 0.0, 0.0))))
    own = (corners - np.array(light["at"])) @ turned
    elevation = np.arcsin(_AROUND.directions[:, 2])
    around = _share(own, _AROUND, np.cos(elevation))
    if "half" not in light:
        return around, around
    half = min(light["half"], math.pi / 2)
    steps = Steps(-half, half, _ACROSS)
    beam = Grid(steps, steps, 0.0, _ENDLESS)
    return around, _share(own, beam, beam.directions[:, 0] >= math.cos(half))


def _share(corners: Array, grid: Grid, weights: Any) -> float:
    import numpy as np

    outside, _ = first_hits(corners, grid)
    inside, _ = first_hits(corners[:, ::-1], grid)
    hit = np.isfinite(np.minimum(outside, inside))
    return float((weights * hit).sum() / weights.sum())


def _frame(along: Array) -> Array:
    """Return axes, as columns, of which the first is a direction of length 1."""
    import numpy as np

    other = np.eye(3)[np.abs(along).argmin()]
    y = np.cross(along, other)
    y /= np.linalg.norm(y)
    return np.stack([along, y, np.cross(along, y)], axis=1)
