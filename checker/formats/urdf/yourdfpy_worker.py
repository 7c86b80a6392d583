"""Reads URDF with yourdfpy in a child process: the module behind `checker.base.child_process`."""

from __future__ import annotations

import json
import logging
from io import BytesIO
from typing import Any

from checker.base.sandbox.files import NO_FILES, Files


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Read robots.

    Args:
        request: JSON; `items` with the `urdf` of each.

    Returns:
        JSON; of each robot the masses of its links (kg; null for none), their poses (three
        rows of four, in the frame of the robot, metres, joints at zero), and the names of its
        joints; or its `error`.
    """
    logging.disable()
    return json.dumps([_read(item["urdf"]) for item in json.loads(request)["items"]]).encode()


def _read(text: str) -> dict[str, Any]:
    import yourdfpy

    try:
        robot = yourdfpy.URDF.load(BytesIO(text.encode()), load_meshes=False)
        links = {
            name: {
                "mass": None if link.inertial is None else link.inertial.mass,
                "pose": robot.get_transform(name)[:3].tolist(),
            }
            for name, link in robot.link_map.items()
        }
    except Exception as error:  # noqa: BLE001 - whatever the library raises, it cannot read the file
        return {"error": f"{type(error).__name__}: {error}"[:300]}
    return {"links": links, "joints": list(robot.joint_map)}
