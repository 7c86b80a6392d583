"""Draws one small frame with the available OpenGL (see `checker.base.child_process`)."""

from __future__ import annotations

import os
from functools import partial

from checker.base.forked_work import run_in_fork
from checker.base.parts import WorkerFailed
from checker.base.sandbox.files import Files

_RENDERERS = {"egl": "EGL", "osmesa": "OSMesa"}
_SECONDS_EACH = 5
_SCENE = "<mujoco><worldbody><light pos='0 0 3'/><geom size='1'/></worldbody></mujoco>"


def answer(_request: bytes, _files: Files) -> bytes:
    """Return the name of the first renderer that works, or `none`."""
    # A renderer that is not there ends MuJoCo's import, so each is tried in a process of its own.
    for renderer, name in _RENDERERS.items():
        drawn = run_in_fork(partial(_draw, renderer), _SECONDS_EACH)
        if not isinstance(drawn, WorkerFailed) and drawn == b"light":
            return name.encode()
    return b"none"


def _draw(renderer: str) -> bytes:
    """Draw a ball in front of nothing; some of it must be light, not all."""
    os.environ["MUJOCO_GL"] = renderer
    import mujoco

    model = mujoco.MjModel.from_xml_string(_SCENE)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    with mujoco.Renderer(model, 48, 64) as drawer:
        drawer.update_scene(data)
        picture = drawer.render()
    return b"light" if picture.max() > picture.min() else b"dark"
