"""Draws pictures with MuJoCo: common code of the modules behind `checker.base.child_process`.

Each link is a body that is placed for each shot; nothing is simulated.
"""

from __future__ import annotations

import base64
import io
import json
import os
from collections.abc import Mapping
from functools import cache as once
from importlib import import_module
from typing import Any

from checker.base.sandbox.files import NO_FILES, Files
from checker.physics.mesh.surface import Surface, surface_to_json
from checker.report.scene.drawing.request import Camera
from checker.report.scene.drawing.studio import (
    GROUND_GROUP,
    drawn_size,
    model_of,
    set_stage,
)

# A minimal request that draws once everything that other requests draw.


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
        "form": "JPEG",
        "ground": 0.0,
        "meshes": [surface_to_json(plain), surface_to_json(coloured)],
        "links": [0],
        "geoms": geoms,
        "shots": [
            {
                "group": number,
                "camera": camera,
                "tile": 1.0,
                "see_through": number == 1,
                "poses": poses,
            }
            for number in _GROUPS
        ],
    }


LARGEST = 60_000
"""Bytes of a JPEG file."""
_QUALITIES = (80, 70, 60, 45, 30)
_THREADS = "2"
_BESIDES = 10
"""Things in a scene that are no part of the robot."""


def load(platform: str) -> None:
    """Import MuJoCo with the means to draw without a window.

    Args:
        platform: `egl` or `osmesa`; where it is missing this raises whatever it raises.
    """
    os.environ["MUJOCO_GL"] = os.environ["PYOPENGL_PLATFORM"] = platform
    # Mesa takes as many as there are processors, each with address space of its own.
    os.environ["LP_NUM_THREADS"] = _THREADS
    import_module("mujoco")
    import_module("PIL.JpegImagePlugin")
    import_module("PIL.PngImagePlugin")
    # Mesa compiles what it draws with when it is first drawn: that is half of what a picture takes.
    _pictures(rehearsal())


def answer(request: bytes, _files: Files = NO_FILES) -> bytes:
    """Draw pictures.

    Args:
        request: JSON; `items` of the form that `checker.report.scene.drawing.request` has.

    Returns:
        JSON: of each the files in the order of the shots, as base64.
    """
    return json.dumps([_encoded(item) for item in json.loads(request)["items"]]).encode()


def _encoded(item: Mapping[str, Any]) -> list[str]:
    return [base64.b64encode(picture).decode() for picture in _pictures(item)]


def _pictures(item: Mapping[str, Any]) -> list[bytes]:
    easel = _Easel(item)
    return [_file(easel.drawn(shot), item) for shot in item["shots"]]


class _Easel:
    """Draws shots of one model, into memory."""

    def __init__(self, item: Mapping[str, Any]) -> None:
        """Make the model, and what OpenGL needs to draw it."""
        import mujoco

        self._model = model_of(item)
        self._data = mujoco.MjData(self._model)
        self._size = drawn_size(item)
        self._window = _window()
        self._scene = mujoco.MjvScene(self._model, len(item["geoms"]) + _BESIDES)
        self._context = mujoco.MjrContext(self._model, mujoco.mjtFontScale.mjFONTSCALE_50)
        mujoco.mjr_setBuffer(mujoco.mjtFramebuffer.mjFB_OFFSCREEN, self._context)

    def drawn(self, shot: Mapping[str, Any]) -> Any:
        """Return a shot: rows from the top, red, green and blue of each pixel."""
        import mujoco
        import numpy as np

        width, height = self._size
        for number, pose in enumerate(shot["poses"]):
            self._data.mocap_pos[number], self._data.mocap_quat[number] = pose[:3], pose[3:]
        self._context.shadowClip = set_stage(self._model, shot)
        # What is open, or inside out, is seen from both sides, unless one sees through it.
        self._scene.flags[mujoco.mjtRndFlag.mjRND_CULL_FACE] = shot["see_through"]
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_camlight(self._model, self._data)
        mujoco.mjv_updateScene(
            self._model,
            self._data,
            _only(shot["group"]),
            None,
            _camera(shot["camera"]),
            mujoco.mjtCatBit.mjCAT_ALL,
            self._scene,
        )
        whole = mujoco.MjrRect(0, 0, width, height)
        pixels = np.empty((height, width, 3), np.uint8)
        mujoco.mjr_render(whole, self._scene, self._context)
        mujoco.mjr_readPixels(pixels, None, whole, self._context)
        return pixels[::-1]


@once
def _window() -> Any:
    """Return OpenGL's context: one for all easels, as what it has compiled is lost with it."""
    import mujoco

    # Nothing is drawn in the window itself.
    window = mujoco.GLContext(1, 1)
    window.make_current()
    return window


def _camera(data: dict[str, Any]) -> Any:
    import mujoco

    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    camera.lookat = data["lookat"]
    camera.distance, camera.azimuth = data["distance"], data["azimuth"]
    camera.elevation = data["elevation"]
    return camera


def _only(group: int) -> Any:
    """Return options that show one group of shapes, and the ground."""
    import mujoco

    options = mujoco.MjvOption()
    options.geomgroup = [int(number in (group, GROUND_GROUP)) for number in range(mujoco.mjNGROUP)]
    return options


def _file(pixels: Any, item: Mapping[str, Any]) -> bytes:
    from PIL import Image

    size = (item["width"], item["height"])
    image = Image.fromarray(pixels).resize(size, Image.Resampling.HAMMING)
    for quality in _QUALITIES:
        file = io.BytesIO()
        image.save(file, item["form"], quality=quality)
        if item["form"] != "JPEG" or file.tell() <= LARGEST:
            break
    return file.getvalue()
