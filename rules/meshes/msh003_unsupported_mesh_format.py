"""A mesh in a format that Gazebo does not read.

The part is invisible, or has no collision. Gazebo Dome and Gazebo Classic read COLLADA, STL and
OBJ; Garden and later also read glTF and FBX. A URDF without a `<gazebo>` element may be for other
tools: there it is a warning. A file that does not exist is a matter of REF002 alone.

Fix: export the mesh as COLLADA (.dae) or OBJ with its textures, or as STL for a collision.
Source: gz-common, MeshManager: its list of file extensions in version 3 (Dome) and 5 (Garden).
"""

import posixpath

from checker.model.robot import Robot
from checker.package.package import Package
from checker.package.uris import path_behind
from checker.rule import Concern, Context, Findings, Severity, finding, rule
from checker.source.text import Located

_SINCE_GARDEN = frozenset({".fbx", ".glb", ".gltf"})


@rule("MSH003", "unsupported-mesh-format", Severity.ERROR, Concern.ROBOT)
def check(
    robot: Robot,
    package: Package,
    context: Context,
    *,
    formats: tuple[str, ...] = (".dae", ".obj", ".stl"),
    older_releases: tuple[str, ...] = ("classic", "dome"),
) -> Findings:
    """Report meshes whose file extension the release does not know.

    Options:
        formats: File extensions, with the dot and in lower case, of the mesh formats that every
            release reads.
        older_releases: Names of the Gazebo releases that read only `formats`; all others also read
            glTF and FBX.
    """
    older = context.release in older_releases
    known = frozenset(formats) if older else _SINCE_GARDEN.union(formats)
    target = f"Gazebo {context.release.title()}".rstrip()
    for use in robot.mesh_uses:
        suffix = posixpath.splitext(use.uri.value)[1]
        if suffix.lower() not in known and not _is_missing(package, use.uri):
            yield finding(
                use.uri,
                f"{use.uri.value} is "
                f"{f'a {suffix} file' if suffix else 'a file without extension'}, which "
                f"{target} does not load: expected one of {', '.join(sorted(known))}",
                severity=None if robot.is_for_gazebo else Severity.WARNING,
                key=suffix.lower(),
            )


def _is_missing(package: Package, uri: Located[str]) -> bool:
    path = path_behind(package, Robot.folder_of(uri), uri.value)
    return isinstance(path, str) and not package.exists(path)


def _visual(uri: str, mark: str = "") -> str:
    return f"""
<visual name="v"><geometry><mesh>
  <uri>meshes/{uri}</uri>{mark}
</mesh></geometry></visual>
"""


_MARK = "  <!-- ^ MSH003 -->"
GOOD = [_visual("a.dae"), _visual("a.STL"), _visual("a.obj"), _visual("missing.blend")]
BAD = [
    {"@fragment": _visual(name, _MARK), f"meshes/{name}": "mesh"}
    for name in ("a.glb", "a.blend", "a")
]
