"""A texture that is too large for graphics cards.

The texture takes memory on the card for each camera's view; above the card's limit it is not shown.
4096 × 4096 pixels take 85 MB.

Fix: scale the picture down; 1024 pixels per side are enough for most parts of a robot.
Source: the limit that every card since OpenGL 4.1 supports is 16384; 4096 is what is sensible.
"""

import posixpath
from collections.abc import Iterator

from checker.model.components import Visual
from checker.model.mesh import Mesh
from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.binary_headers import picture_size
from checker.source.text import Located


@rule("MSH007", "large-texture", Severity.INFO, Concern.PORTABILITY)
def check(package: Package, robot: Robot, *, most: int = 4096) -> Findings:
    """Report pictures of the model and of its meshes with too many pixels per side.

    Options:
        most: Pixels that the longer side of a PNG or JPEG picture may have; more are reported.
    """
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    sizes: dict[str, tuple[int, int] | None] = {}
    for uri, path in _textures(package, robot):
        if path not in sizes:
            data = package.read_bytes(path)
            sizes[path] = picture_size(data) if isinstance(data, bytes) else None
        size = sizes[path]
        if size is not None and max(size) > most:
            yield finding(
                uri,
                f"{path} has {size[0]} × {size[1]} pixels, expected at most {most} per side",
                key=path,
            )


def _textures(package: Package, robot: Robot) -> Iterator[tuple[Located[str], str]]:
    """Yield the pictures that exist, each with the URI that leads to it."""
    for shape in robot.shapes():
        if isinstance(shape, Visual) and shape.material is not None:
            for uri in shape.material.textures:
                yield from _existing_textures(package, uri, robot.folder_of(uri), uri.value)
    for use in robot.mesh_uses:
        if not isinstance(use.file, Mesh):
            continue
        folder = posixpath.dirname(use.file.path)
        for name in use.file.textures:
            yield from _existing_textures(package, use.uri, folder, name)
            yield from _existing_textures(package, use.uri, f"{folder}/../materials/textures", name)


def _existing_textures(
    package: Package, uri: Located[str], folder: str, name: str
) -> Iterator[tuple[Located[str], str]]:
    path = posixpath.normpath(posixpath.join(folder, name))
    entry = package.resolve(path)
    if entry is not None and entry.is_file:
        yield uri, path


def _visual(mark: str = "") -> str:
    return f"""
<visual name="v">
  <geometry><box><size>1 1 1</size></box></geometry>
  <material><pbr><metal>
    <albedo_map>materials/textures/paint.png</albedo_map>{mark}
  </metal></pbr></material>
</visual>
"""


def _header(width: int, height: int) -> bytes:
    """Return the beginning of a PNG file."""
    sizes = width.to_bytes(4, "big") + height.to_bytes(4, "big")
    return b"\x89PNG\r\n\x1a\n\0\0\0\x0dIHDR" + sizes + b"\x08\x02\0\0\0"


_MARK = "  <!-- ^ MSH007 -->"
_MESH = """
<visual name="v"><geometry><mesh>
  <uri>meshes/part.obj</uri>  <!-- ^ MSH007 -->
</mesh></geometry></visual>
"""

GOOD = [
    {"@fragment": _visual(), "materials/textures/paint.png": _header(4096, 4096)},
    {"@fragment": _visual(), "materials/textures/paint.png": "no picture"},
]
BAD = [
    {"@fragment": _visual(_MARK), "materials/textures/paint.png": _header(64, 8192)},
    {
        "@fragment": _MESH,
        "meshes/part.obj": "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "meshes/part.mtl": "newmtl paint\nmap_Kd paint.png\n",
        "meshes/paint.png": _header(4097, 16),
    },
]
