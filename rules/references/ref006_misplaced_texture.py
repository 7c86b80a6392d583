"""A texture in an unusual folder.

Gazebo loads the texture. But reviewers, and tools that move a model to Fuel, expect textures in
`materials/textures`, or next to the mesh that uses them.

Fix: move the file to `materials/textures`, and correct the path in model.sdf.
Source: Model Migration Guide, step 7: materials in `materials`, or textures next to their mesh;
accepted packages use `materials/textures`.
"""

import posixpath

from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

TEXTURES = (".png", ".jpg", ".jpeg", ".tga", ".tif", ".tiff", ".bmp", ".dds", ".hdr")
MESHES = (".dae", ".stl", ".obj", ".glb", ".gltf", ".fbx")


@rule("REF006", "misplaced-texture", Severity.INFO, Concern.PAPERWORK)
def check(
    package: Package,
    robot: Robot,
    *,
    folder: str = "materials/textures",
    holding_textures: tuple[str, ...] = ("materials", "media", "textures"),
) -> Findings:
    """Report textures, by their use or their folder, in other places.

    Options:
        folder: Path in the package; textures may be in and below this folder, or next to meshes.
        holding_textures: Names in lower case of folders at the top of the package; pictures in and
            below them count as textures even if nothing uses them.
    """
    used = {
        posixpath.normpath(posixpath.join(robot.folder_of(uri), uri.value))
        for uri in robot.file_uris
    }
    beside_meshes = {posixpath.dirname(mesh.path) for mesh in package.index.with_suffix(*MESHES)}
    for file in package.index.with_suffix(*TEXTURES):
        place = posixpath.dirname(file.path)
        if place in beside_meshes or f"{place}/".startswith(f"{folder.rstrip('/')}/"):
            continue
        if file.path in used or place.partition("/")[0].lower() in holding_textures:
            yield finding(
                package.place(file.path),
                f"texture {file.path} is neither in {folder} nor next to a mesh",
                key=place,
                covered_by=("REF005",),
            )


def _visual(mesh: str, texture: str) -> str:
    return f"""
<visual name="v">
  <geometry><mesh><uri>{mesh}</uri></mesh></geometry>
  <material><pbr><metal>
    <albedo_map>{texture}
  </metal></pbr></material>
</visual>
"""


GOOD = [
    {
        "@fragment": _visual("meshes/a.dae", "materials/textures/a.png</albedo_map>"),
        "materials/textures/a.png": "",
    },
    {"meshes/a.png": "", "meshes/a.dae": "<COLLADA/>", "thumbnails/2.png": ""},
]
BAD = [
    {
        "@fragment": _visual("meshes/a.dae", "pictures/a.png</albedo_map>"),
        "pictures/a.png": "",
        "@reported": ["pictures/a.png:1"],
    },
    {"textures/a.png": "", "@reported": ["textures/a.png:1"]},
]
