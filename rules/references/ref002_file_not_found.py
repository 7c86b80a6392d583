"""A mesh or texture that does not exist.

The part is invisible, or has no collision and falls through the ground. Names must match exactly,
as on the machines that run the simulation: `Wheel.DAE` is not `wheel.dae`. Without a texture the
part is there and has another colour: this is a warning.

Fix: add the file, or correct the path.
Source: Model Migration Guide, steps 6 and 7: gather all meshes and materials in the package.
"""

import posixpath
import re

from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_SCHEME = re.compile(r"(?:model|package)://([^/]+)/(.*)", re.DOTALL)
_ELSEWHERE = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


@rule("REF002", "file-not-found", Severity.ERROR, Concern.ROBOT)
def check(package: Package, robot: Robot) -> Findings:
    """Report URIs that lead to no file."""
    meshes = {shape.geometry.uri for shape in robot.shapes()}
    for uri in robot.file_uris:
        if (named := _SCHEME.match(uri.value)) and not _at_hand(package, named.group(1)):
            yield unchecked(f"{uri.value} is in {named.group(1)}, which is not available")
            continue
        path = _path(package, robot.folder_of(uri), uri.value)
        if path is None or package.exists(path):
            continue
        if (other := _sibling(path)) and not _at_hand(package, other):
            yield unchecked(f"{uri.value} is in {other}, which is not available")
            continue
        where = f" (looked for {path})" if path != uri.value else ""
        yield finding(
            uri,
            f"{uri.value} does not exist{where}{_hint(package, path)}",
            severity=None if uri in meshes else Severity.WARNING,
            key=path,
        )


def _path(package: Package, folder: str, uri: str) -> str | None:
    """Return where a URI leads, from the package's folder; None if that cannot be checked."""
    if named := _SCHEME.match(uri):
        other, path = named.groups()
        if _is_own_name(package, other):
            return posixpath.normpath(path)
        sibling = package.workspace.package(other)
        return f"../{sibling.name}/{path}" if sibling is not None else None
    if _ELSEWHERE.match(uri) or uri.startswith("/") or not uri:
        return None
    return posixpath.normpath(posixpath.join(folder, uri))


def _sibling(path: str) -> str:
    """Return the package next to this one that a path leads into."""
    return path.split("/")[1] if path.startswith("../") else ""


def _at_hand(package: Package, name: str) -> bool:
    return _is_own_name(package, name) or package.workspace.package(name) is not None


def _is_own_name(package: Package, name: str) -> bool:
    """Models on Fuel have the package's name in upper case."""
    return name.casefold() == package.name.casefold()


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
