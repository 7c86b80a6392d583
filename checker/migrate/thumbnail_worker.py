"""Draws a robot from five sides with MuJoCo: the module behind `checker.base.child_process`."""

from __future__ import annotations

import base64
import json
import os
import struct
import zlib
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from typing import Any

from checker.base.files import NotReadable
from checker.base.sandbox.files import Content, Files

WIDTH, HEIGHT = 640, 480
_VIEWS = ((-138.0, -27.0), (0.0, -90.0), (-90.0, 0.0), (180.0, 0.0), (0.0, 0.0))
"""Azimuth and elevation of the line of sight, degrees."""
_DISTANCE = 0.95
"""Of the camera, in diagonals of the robot."""
_RENDERERS = ("egl", "osmesa")
_SECONDS_EACH = 25
_CORNERS = 4
"""That MuJoCo wants of a mesh at least."""


def answer(request: bytes, files: Files) -> bytes:
    """Draw.

    Args:
        request: JSON: `shapes`, each with shape, sizes, file, position, quaternion and colour.
        files: Those that the shapes name.

    Returns:
        JSON: `pictures`, five PNG files in base 64; or `unable`, why there are none.
    """
    shapes = json.loads(request)["shapes"]
    # A renderer that is not there ends MuJoCo's import, so each is tried in a process of its own.
    from checker.base.forked_work import in_fork
    from checker.base.parts import WorkerFailed

    for renderer in _RENDERERS:
        pictures = in_fork(partial(_pictures, shapes, files, renderer), _SECONDS_EACH)
        if not isinstance(pictures, WorkerFailed):
            return pictures
    return _unable("OpenGL is not available (EGL or OSMesa)")


def _unable(reason: str) -> bytes:
    return json.dumps({"unable": reason}).encode()


def _pictures(shapes: Sequence[Mapping[str, Any]], files: Files, renderer: str) -> bytes:
    os.environ["MUJOCO_GL"] = renderer
    import mujoco

    spec = mujoco.MjSpec()
    spec.visual.global_.offwidth, spec.visual.global_.offheight = WIDTH, HEIGHT
    spec.visual.headlight.ambient = [0.4, 0.4, 0.4]
    spec.visual.headlight.diffuse = [0.6, 0.6, 0.6]
    spec.add_texture(
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.95, 0.95, 0.97],
        rgb2=[0.75, 0.78, 0.82],
        width=64,
        height=64,
    )
    for number, shape in enumerate(shapes):
        _add(spec, mujoco, shape, files.read(shape["file"]), number)
    if not spec.geoms:
        return _unable("no mesh of the robot can be read")
    try:
        model = spec.compile()
    except ValueError as error:
        return _unable(f"MuJoCo refuses the shapes ({str(error).splitlines()[0]})")
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    centre, diagonal = _extent(model, data)
    with mujoco.Renderer(model, HEIGHT, WIDTH) as drawer:
        pictures = []
        for azimuth, elevation in _VIEWS:
            camera = mujoco.MjvCamera()
            camera.lookat[:] = centre
            camera.distance = _DISTANCE * diagonal
            camera.azimuth, camera.elevation = azimuth, elevation
            drawer.update_scene(data, camera)
            pictures.append(base64.b64encode(_png(drawer.render())).decode())
    return json.dumps({"pictures": pictures}).encode()


def _add(spec: Any, mujoco: Any, shape: Mapping[str, Any], content: Content, number: int) -> None:
    """Add a shape to the scene; a mesh that cannot be read is left out."""
    kind = mujoco.mjtGeom
    attributes = {
        "pos": shape["position"],
        "quat": shape["quaternion"],
        "rgba": shape["colour"],
        "contype": 0,
        "conaffinity": 0,
    }
    sizes = shape["sizes"]
    match shape["shape"]:
        case "box":
            half = [max(abs(length) / 2, 1e-6) for length in sizes["size"]]
            spec.worldbody.add_geom(type=kind.mjGEOM_BOX, size=half, **attributes)
        case "sphere":
            size = [max(sizes["radius"][0], 1e-6), 0, 0]
            spec.worldbody.add_geom(type=kind.mjGEOM_SPHERE, size=size, **attributes)
        case "cylinder" | "capsule" as round_:
            size = [max(sizes["radius"][0], 1e-6), max(sizes["length"][0] / 2, 1e-6), 0]
            tall = kind.mjGEOM_CYLINDER if round_ == "cylinder" else kind.mjGEOM_CAPSULE
            spec.worldbody.add_geom(type=tall, size=size, **attributes)
        case _:
            corners = _corners(shape["file"], content, sizes.get("scale", [1.0, 1.0, 1.0]))
            if corners is None:
                return
            mesh = spec.add_mesh(name=f"m{number}")
            mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL
            mesh.uservert = corners.reshape(-1)
            mesh.userface = list(range(len(corners)))
            spec.worldbody.add_geom(type=kind.mjGEOM_MESH, meshname=f"m{number}", **attributes)


def _corners(file: str, content: Content, scale: Sequence[float]) -> Any:
    """Return the corners of a mesh's triangles, metres; None where it cannot be read."""
    from checker.physics.mesh.content import NoSurface
    from checker.physics.mesh.reader import read_content

    if isinstance(content, NotReadable):
        return None
    try:
        corners = read_content(content, file).corners.reshape(-1, 3)
    except NoSurface:
        return None
    return corners * scale if len(corners) >= _CORNERS else None


def _extent(model: Any, data: Any) -> tuple[list[float], float]:
    """Return the middle of all shapes, and how far it is from corner to corner, metres."""
    import numpy

    reach = model.geom_rbound[:, None]
    low = (data.geom_xpos - reach).min(axis=0)
    high = (data.geom_xpos + reach).max(axis=0)
    return list((low + high) / 2), max(float(numpy.linalg.norm(high - low)), 1e-3)


def _png(pixels: Any) -> bytes:
    """Return a picture of rows of red, green, blue as a PNG file."""
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + pixels[row].tobytes() for row in range(height))
    return b"\x89PNG\r\n\x1a\n" + b"".join(_chunks(width, height, rows))


def _chunks(width: int, height: int, rows: bytes) -> Iterator[bytes]:
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    for name, content in ((b"IHDR", header), (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
        check = zlib.crc32(name + content)
        yield struct.pack(">I", len(content)) + name + content + struct.pack(">I", check)
