r"""A mesh file names a texture that does not exist.

The part is plain grey. Gazebo looks in the mesh's folder, then in the folder `materials/textures`
next to it. A path such as `C:\Users\me\paint.png` works on one machine only.

Where a visual of an SDF file has a `<material>` of its own, Gazebo paints the part with that: then
it is information.

Fix: put the picture where the mesh file expects it, or correct the path in the mesh file.
Source: Model Migration Guide, step 7; gz-common, `Material::SetTextureImage`, which tries
`<folder of the mesh>/<name>` and `<folder of the mesh>/../materials/textures/<name>`.
"""

import posixpath
import re
from collections.abc import Iterator
from urllib.parse import unquote

from checker.model.components import Visual
from checker.model.geometry.shapes import Material
from checker.model.mesh import Mesh, MeshUse
from checker.model.robot import Robot
from checker.package.package import Package
from checker.package.target import package_around
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_ABSOLUTE = re.compile(r"/|[A-Za-z]:[\\/]|file:|\\\\", re.IGNORECASE)
_ON_A_SERVER = re.compile(r"https?:", re.IGNORECASE)


@rule("MSH006", "mesh-texture-missing", Severity.WARNING, Concern.ROBOT)
def check(package: Package, robot: Robot) -> Findings:
    """Report files that the meshes of visuals name, unless the model gives a texture itself."""
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        if not isinstance(use.file, Mesh) or use.is_collision or _has_own_texture(use):
            continue
        for name in (*use.file.materials, *use.file.textures):
            if _ON_A_SERVER.match(name) or _is_there(package, use.file, name):
                continue
            absolute = "an absolute path" if _ABSOLUTE.match(name) else "which does not exist"
            replaced = robot.conventions.read_by_gazebo and _material(use) is not None
            kind = "material file" if name in use.file.materials else "texture"
            message = f"{use.uri.value} names the {kind} {name}, {absolute}"
            severity = Severity.INFO if replaced else None
            yield finding(use.uri, message, severity=severity, key=kind)


def _is_there(package: Package, mesh: Mesh, name: str) -> bool:
    """Return whether a file is in the package, or in the one around a folder of a model."""
    around, paths = package_around(package), [*_paths(mesh, name)]
    if any(map(package.exists, paths)):
        return True
    inside = package.root.relative_to(around.root).as_posix() if around is not None else ""
    places = (posixpath.normpath(posixpath.join(inside, path)) for path in paths)
    return around is not None and any(map(around.exists, places))


def _paths(mesh: Mesh, name: str) -> Iterator[str]:
    """Yield where Gazebo looks for a picture; `%20` is read as a space too."""
    if _ABSOLUTE.match(name):
        return
    folder = posixpath.dirname(mesh.path)
    for written in (name, unquote(name)):
        yield posixpath.normpath(posixpath.join(folder, written))
        yield posixpath.normpath(posixpath.join(folder, "../materials/textures", written))


def _material(use: MeshUse) -> Material | None:
    return use.shape.material if isinstance(use.shape, Visual) else None


def _has_own_texture(use: MeshUse) -> bool:
    material = _material(use)
    return material is not None and bool(material.textures)


def _visual(mark: str = "", material: str = "") -> str:
    return f"""
<visual name="v"><geometry><mesh>
  <uri>meshes/part.obj</uri>{mark}
</mesh></geometry>{material}</visual>
"""


def _example(picture: str) -> dict[str, str]:
    return {
        "meshes/part.obj": "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "meshes/part.mtl": f"newmtl paint\nmap_Kd {picture}\n",
    }


_MARK = "  <!-- ^ MSH006 -->"
_PBR = "<material><pbr><metal><albedo_map>b.png</albedo_map></metal></pbr></material>"

GOOD = [
    {"@fragment": _visual(), **_example("a.png"), "meshes/a.png": ""},
    {"@fragment": _visual(), **_example("-s 1 1 a b.png"), "materials/textures/a b.png": ""},
    {"@fragment": _visual(material=_PBR), **_example("a.png")},
]
BAD = [
    {"@fragment": _visual(_MARK), **_example("a.png")},
    {"@fragment": _visual(_MARK), **_example("C:\\pictures\\a.png"), "meshes/a.png": ""},
    {
        "@fragment": _visual(_MARK),
        **_example("a.png"),
        "meshes/a.png": "",
        "meshes/part.mtl": None,
    },
]
