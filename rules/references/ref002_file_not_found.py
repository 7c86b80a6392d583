"""A mesh or texture that does not exist.

The part is invisible, or has no collision and falls through the ground. Names must match exactly,
as on the machines that run the simulation: `Wheel.DAE` is not `wheel.dae`. Without a texture the
part is there and has another colour: this is a warning.

Fix: add the file, or correct the path.
Source: Model Migration Guide, steps 6 and 7: gather all meshes and materials in the package.
"""

from checker.model.robot import Robot
from checker.package.package import Package
from checker.package.uris import Unknown, path_behind
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("REF002", "file-not-found", Severity.ERROR, Concern.ROBOT)
def check(package: Package, robot: Robot) -> Findings:
    """Report URIs that lead to no file."""
    meshes = {shape.geometry.uri for shape in robot.shapes()}
    for uri in robot.file_uris:
        path = path_behind(package, robot.folder_of(uri), uri.value)
        if isinstance(path, Unknown):
            if path.package:
                yield unchecked(f"{uri.value} {path.reason}")
            continue
        if package.exists(path):
            continue
        where = f" (looked for {path})" if path != uri.value else ""
        yield finding(
            uri,
            f"{uri.value} does not exist{where}{_hint(package, path)}",
            severity=None if uri in meshes else Severity.WARNING,
            key=path,
        )


def _hint(package: Package, path: str) -> str:
    alike = [other for other in package.index.similar(path) if other != path]
    return f"; did you mean {alike[0]}?" if alike else ""


GOOD = [
    {
        "@fragment": """
<visual name="v"><geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry></visual>
""",
        "meshes/wheel.dae": "<COLLADA/>",
    },
]
BAD = [
    {
        "@fragment": """
<visual name="v"><geometry><mesh>
  <uri>meshes/wheel.dae</uri>  <!-- ^ REF002 -->
</mesh></geometry></visual>
""",
        "meshes/Wheel.DAE": "<COLLADA/>",
    },
    """
<visual name="v">
  <geometry><box><size>1 1 1</size></box></geometry>
  <material><pbr><metal>
    <albedo_map>materials/textures/paint.png</albedo_map>  <!-- ^ REF002 -->
  </metal></pbr></material>
</visual>
""",
]
