"""Reach of the shapes of a scene."""

from __future__ import annotations

import math
from typing import Any


def lowest_point(model: Any, data: Any) -> float:
    """Return the height of the lowest point of all shapes but planes, metres; inf without any."""
    return min((_lowest(model, data, geom) for geom in range(model.ngeom)), default=math.inf)


def _lowest(model: Any, data: Any, geom: int) -> float:
    import mujoco
    import numpy as np

    kinds = mujoco.mjtGeom
    kind, size = model.geom_type[geom], model.geom_size[geom]
    # The vertical in the frame of the shape.
    up = data.geom_xmat[geom][6:9]
    if kind == kinds.mjGEOM_PLANE:
        return math.inf
    if kind == kinds.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first, count = model.mesh_vertadr[mesh], model.mesh_vertnum[mesh]
        reach = -float((model.mesh_vert[first : first + count] @ up).min())
    elif kind == kinds.mjGEOM_BOX:
        reach = float(np.abs(up) @ size)
    elif kind == kinds.mjGEOM_CYLINDER:
        reach = abs(up[2]) * size[1] + math.hypot(up[0], up[1]) * size[0]
    elif kind == kinds.mjGEOM_CAPSULE:
        reach = abs(up[2]) * size[1] + size[0]
    elif kind == kinds.mjGEOM_ELLIPSOID:
        reach = float(np.linalg.norm(up * size))
    else:
        reach = float(size[0])
    return float(data.geom_xpos[geom][2]) - reach
