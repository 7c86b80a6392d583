"""What the beams of rangefinders meet of the robot that carries them."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import Any

from checker.physics.compiled.parts import stated_line

_UP = 2
"""Column of a site's frame along which its rangefinder looks: z."""


def own_hits(spec: Any, model: Any, absent: Collection[str]) -> list[dict[str, Any]]:
    """Return the rangefinders whose beam meets a body that is welded to their own.

    Nothing between the two can move, so that they measure the same in each pose. MuJoCo leaves out
    the shapes of the site's own body.

    Args:
        spec: The model as it is stated.
        model: The model; its shapes of absent meshes become invisible.
        absent: Names of meshes and height fields whose files are absent.
    """
    import mujoco
    import numpy as np

    for geom in spec.geoms:
        if (geom.meshname or geom.hfieldname) in absent:
            model.geom_matid[geom.id], model.geom_rgba[geom.id] = -1, 0.0
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    found = []
    for sensor, site in _rangefinders(spec, model):
        body, geom = int(model.site_bodyid[site]), np.array([-1], np.int32)
        along = data.site_xmat[site].reshape(3, 3)[:, _UP].copy()
        start = data.site_xpos[site]
        distance = mujoco.mj_ray(model, data, start, along, None, 1, body, geom)
        hit = int(model.geom_bodyid[geom[0]]) if geom[0] >= 0 else 0
        if model.body_weldid[body] and model.body_weldid[hit] == model.body_weldid[body]:
            found.append(
                {
                    "line": stated_line(sensor.info),
                    "name": sensor.name,
                    "body": body,
                    "hit": hit,
                    "distance": float(distance),
                }
            )
    return found


def _rangefinders(spec: Any, model: Any) -> Iterator[tuple[Any, int]]:
    """Yield the rangefinders of sites, each with the number of its site."""
    import mujoco

    for sensor in spec.sensors:
        is_one = model.sensor_type[sensor.id] == mujoco.mjtSensor.mjSENS_RANGEFINDER
        if is_one and model.sensor_objtype[sensor.id] == mujoco.mjtObj.mjOBJ_SITE:
            yield sensor, int(model.sensor_objid[sensor.id])
