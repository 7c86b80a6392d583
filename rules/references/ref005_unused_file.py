"""A mesh or texture that nothing uses.

Each user of the robot downloads it. Often a wrong path should lead to it. A folder of meshes
without a model is for other models: it is not reported.

Fix: delete it, or correct the reference that should lead to it.
Source: common practice; the Model Migration Guide, steps 6 and 7, gathers what the model uses.
"""

from checker.package.kind import PackageKind
from checker.package.mentions import unsearched
from checker.package.package import Package
from checker.package.target import names_mentioned_around
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

MESHES = (".dae", ".stl", ".obj", ".glb", ".gltf", ".fbx", ".mtl")
TEXTURES = (".png", ".jpg", ".jpeg", ".tga", ".tif", ".tiff", ".bmp", ".dds", ".hdr")


@rule("REF005", "unused-file", Severity.INFO, Concern.PAPERWORK)
def check(
    package: Package, *, folders: tuple[str, ...] = ("meshes", "materials", "textures", "media")
) -> Findings:
    """Report meshes, and textures in their folders, whose names are in no file.

    Options:
        folders: Names in lower case of folders at the top of the package; unused pictures are
            reported only there, meshes anywhere.
    """
    if package.kind is PackageKind.UNKNOWN:
        return
    if too_large := unsearched(package):
        yield unchecked(f"{too_large[0]} is too large to search for names")
        return
    mentioned = names_mentioned_around(package)
    for file in package.index.with_suffix(*MESHES, *TEXTURES):
        folder, _, rest = file.path.partition("/")
        if file.path.lower().endswith(TEXTURES) and not (rest and folder.lower() in folders):
            continue
        name = file.path.rpartition("/")[2].casefold()
        if name not in mentioned:
            yield finding(
                package.place(file.path),
                f"nothing uses {file.path}: delete it, or correct the path that should lead to it",
                key=f"unused in {folder}",
            )


_VISUAL = """
<visual name="v"><geometry><mesh><uri>meshes/wheel%20rim.dae</uri></mesh></geometry></visual>
"""

GOOD = [
    {
        "@fragment": _VISUAL,
        "meshes/wheel rim.dae": "<COLLADA><init_from>../materials/a.png</init_from></COLLADA>",
        "materials/a.png": "",
    },
]
BAD = [
    {"meshes/wheel.dae": "<COLLADA/>", "@reported": ["meshes/wheel.dae:1"]},
    {
        "@fragment": _VISUAL,
        "meshes/wheel rim.dae": "<COLLADA><init_from>paint.jpg</init_from></COLLADA>",
        "meshes/paint.png": "",
        "@reported": ["meshes/paint.png:1"],
    },
]
