"""A mesh or texture that does not exist.

The part is invisible, or has no collision and falls through the ground. Names must match exactly,
as on the machines that run the simulation: `Wheel.DAE` is not `wheel.dae`. Without a texture the
part is there and has another colour: this is a warning. So is a mesh that is only seen of a model
in a world that has no joints, sensors or plugins. Gazebo Classic does not read the textures of
`<pbr>`.

`package://` of a package that does not exist finds nothing, even if this package has the file: the
name is a former one, or a slip. It is reported if package.xml does not declare that package, no
ROS distribution has it, and this package has every file that is named that way.

`package://` leads to the installed package: a file that the build does not install there is not
found either. Files in one folder of which nothing is installed are reported once; PKG008 reports
meshes/ and other usual folders.

An absolute path such as `/home/me/arm/a.stl` is found on the machine of its author alone.

The models that a world file contains are checked as well. `model://` of a model that is not there
may be one of Fuel, or of the user's own: it is named as not checked. Where it ends as one file of
the package of ROS does, `model://meshes/arm.stl` as `models/meshes/arm.stl`, Gazebo finds it if the
folder above is on its search path: a warning if nothing in the workspace names that path. Where
several folders have the name of the model, one of them with the file is enough.

A file that a CMakeLists.txt of the package, or of a folder around it, downloads is not checked. One
that a `.gitignore` keeps out of the repository is a warning: its author has it.

Fix: add the file, correct the path, or install the folder.
Source: Model Migration Guide, steps 6 and 7: gather all meshes and materials in the package;
resource_retriever: the share folder of the installed package.
"""

import posixpath
import re
from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from checker.finding import Fix
from checker.model.named_files import NamedFiles
from checker.model.robot import Robot
from checker.package.dependencies import Use, former_names
from checker.package.downloaded import downloaded_by
from checker.package.git_ignored import ignored_by
from checker.package.installed import left_out, resolve_listed
from checker.package.manifests import Paperwork
from checker.package.no_package import MESHES
from checker.package.package import Package
from checker.package.resource_path import mentions, searched_folders
from checker.package.target import package_around
from checker.package.uris import (
    Unknown,
    below_searched_folder,
    is_on_one_machine,
    own_path_on_machine,
    path_behind,
)
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    Unchecked,
    finding,
    replace_text,
    rule,
    unchecked,
)
from checker.source.text import Located

_NAMED = re.compile(r"package://([^/]+)/(.+)")
_MODEL = re.compile(r"model://(?!(?:sun|ground_plane)\b)[^/\s]{1,100}")
"""An include; Gazebo Classic installs the two models that are left out."""
_SDF = (".sdf", ".world")
"""Files in which Gazebo finds packages by `model://` alone."""


@rule("REF002", "file-not-found", Severity.ERROR, Concern.ROBOT)
def check(package: Package, files: NamedFiles, paperwork: Paperwork, context: Context) -> Findings:
    """Report URIs that lead to no file."""
    misnamed = _former_names(package, paperwork, files.uris)
    for uri in files.uris:
        if context.is_classic and "/pbr/" in uri.span.element:
            continue
        path = path_behind(package, Robot.folder_of(uri), uri.value)
        if isinstance(path, Unknown):
            if path.package in misnamed:
                yield _misnamed(package, uri, path.package, uri in files.meshes)
            elif path.package:
                yield unchecked(f"{uri.value} {path.reason}")
            elif is_on_one_machine(uri.value):
                yield _elsewhere(package, uri, uri in files.meshes)
            continue
        if package.exists(path):
            yield from _unreached(package, uri, path, uri in files.meshes)
            continue
        if place := downloaded_by(package, path):
            yield unchecked(f"{uri.value} is not there until {place} downloads it")
            continue
        yield _missing(package, files, uri, path)
    models = (_MODEL.match(it.value) for it in files.includes)
    for name in dict.fromkeys(it[0] for it in models if it):
        yield Unchecked(f"{name} is not available", Severity.WARNING)


def _unreached(package: Package, uri: Located[str], path: str, mesh: bool) -> Iterator[Finding]:
    """Report a file that is there, and that its URI does not lead to."""
    if own_path_on_machine(package, uri.value):
        yield _on_machine(uri, posixpath.relpath(path, Robot.folder_of(uri) or "."))
    if lost := _not_searched(package, uri):
        yield lost
    if uri.value.startswith("package://"):
        yield from _not_installed(package, uri, path, mesh)


def _missing(package: Package, files: NamedFiles, uri: Located[str], path: str) -> Finding:
    alike = [other for other in package.index.similar_files(path) if _may_be(other, path)]
    where = f" (looked for {path})" if path != uri.value else ""
    hint = f"; did you mean {alike[0]}?" if alike else ""
    ignored = ignored_by(package, path)
    if ignored:
        hint = f": {ignored} keeps it out of the repository; git add -f adds it"
    return finding(
        uri,
        f"{uri.value} does not exist{where}{hint}",
        severity=None if uri in files.meshes and not ignored else Severity.WARNING,
        key=files.unloaded or path,
        covered_by=("REF004",),
        fix=None if ignored else _other_file(uri, path, alike),
    )


def _former_names(
    package: Package, paperwork: Paperwork, uris: Iterable[Located[str]]
) -> frozenset[str]:
    """Return names that this package had before, which its package.xml does not declare."""
    named = ((uri, _NAMED.fullmatch(uri.value)) for uri in uris)
    uses = [Use(it[1], uri.span.place(), uri.value, it[2]) for uri, it in named if it]
    return paperwork.undeclared(former_names(package, uses))


def _misnamed(package: Package, uri: Located[str], name: str, mesh: bool) -> Finding:
    path = uri.value.removeprefix(f"package://{name}/")
    return finding(
        uri,
        f"{uri.value} does not exist: there is no package {name!r}, and this package has {path}: "
        f"write package://{package.name}/{path}",
        severity=None if mesh else Severity.WARNING,
        key=name,
    )


def _on_machine(uri: Located[str], near: str) -> Finding:
    return finding(
        uri,
        f"{uri.value} is on its author's machine and is found on no other: write {near}",
        key="machine",
        fix=replace_text(uri, near),
        covered_by=("REF001", "URD002"),
    )


def _elsewhere(package: Package, uri: Located[str], mesh: bool) -> Finding:
    """Report a path on its author's machine of which this package has no file."""
    near, around = "a relative URI", package_around(package)
    if around is not None and (inside := own_path_on_machine(around, uri.value)):
        scheme = "model" if uri.span.source.file.endswith(_SDF) else "package"
        near = f"{scheme}://{around.declared_name}/{inside}"
    severity = None if mesh else Severity.WARNING
    return replace(_on_machine(uri, near), severity=severity, fix=None)


def _not_installed(package: Package, uri: Located[str], path: str, mesh: bool) -> Iterator[Finding]:
    """Report a file that its package has and does not install."""
    left = left_out(package, *resolve_listed(package, path))
    if left is not None:
        yield finding(
            uri,
            f"{uri.value} is not installed: {left.instead}",
            severity=None if mesh else Severity.WARNING,
            key=left.around,
        )


def _not_searched(package: Package, uri: Located[str]) -> Finding | None:
    """Report a `model://` whose file is in a folder that is not on Gazebo's search path."""
    below = below_searched_folder(package, uri.value)
    if below is None:
        return None
    around, path = below
    folder = path.removesuffix(uri.value.removeprefix("model://")).rstrip("/")
    every, kinds = (around, *around.other_packages), (True, False)
    on_path = [
        it for each in every for kind in kinds for it in searched_folders(each, classic=kind)
    ]
    named = any(True for each in every for kind in kinds for _ in mentions(each, classic=kind))
    share = posixpath.join(around.declared_name, folder).rstrip("/")
    if named or any(not it.known or it.folder == share for it in on_path):
        return None
    prefix = posixpath.join("${prefix}", folder).rstrip("/")
    return finding(
        uri,
        f"Gazebo does not find {uri.value}: it is {path} of {around.declared_name}, and nothing "
        f"puts {folder or 'that folder'} on its search path; expected "
        f'<gazebo_ros gazebo_model_path="{prefix}"/> in <export> of package.xml',
        severity=Severity.WARNING,
        key=f"not searched {share}",
    )


def _may_be(other: str, path: str) -> bool:
    """Return whether a file may be the missing one: a mesh where a mesh is named."""
    is_mesh = not path.lower().endswith(MESHES) or other.lower().endswith(MESHES)
    return other != path and is_mesh and not other.lower().endswith(".mtl")


def _other_file(uri: Located[str], path: str, alike: list[str]) -> Fix | None:
    """Return the fix that writes the one file of the folder that is called alike."""
    folder = posixpath.dirname(path)
    beside = [other for other in alike if posixpath.dirname(other) == folder]
    if len(beside) != 1 or not uri.value.endswith(path) or uri.span.text != uri.value:
        return None
    return replace_text(uri, uri.value.removesuffix(path) + beside[0], Safety.UNSAFE)


_BUILD = """project(acme_arm)
find_package(ament_cmake REQUIRED)
install(DIRECTORY urdf shapes DESTINATION share/${PROJECT_NAME})
ament_package()
"""
_MESH = '<mesh filename="package://acme_arm/shapes/arm.dae"/>'
_ROBOT = f"""<robot name="arm">
  <link name="base_link">
    <visual><geometry>{_MESH}</geometry></visual>
    <collision><geometry>{_MESH}</geometry></collision>
  </link>
</robot>
"""
_MANIFEST = """<package format="3">
  <name>acme_arm</name>
  <version>1.0.0</version>
  <description>An arm</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
_ARM = {
    "@name": "acme_arm",
    "@profile": "ros2",
    "@urdf": "",
    "package.xml": _MANIFEST,
    "CMakeLists.txt": _BUILD,
    "shapes/arm.dae": "<COLLADA/>",
    "urdf/arm.urdf": _ROBOT,
}
_BELOW_MODELS: dict[str, object] = {
    "@name": "acme_arm",
    "@profile": "gazebo-classic",
    "@ros2": True,
    "urdf/arm.urdf.xacro": None,
    "models/shapes/arm.stl": "solid a\nendsolid a\n",
}
_VISUAL = """
<visual name="v"><geometry><mesh><uri>model://shapes/arm.stl</uri>{}</mesh></geometry></visual>
"""
_PAINTED = """
<visual name="v">
  <geometry><box><size>1 1 1</size></box></geometry>
  <material><pbr><metal>
    <albedo_map>materials/textures/paint.png</albedo_map>@
  </metal></pbr></material>
</visual>
"""
_FORMER = _ROBOT.replace("acme_arm/", "old_arm/")
GOOD = [
    {
        **_BELOW_MODELS,
        "@fragment": _VISUAL.format(""),
        "README.md": "export GAZEBO_MODEL_PATH=src/acme_arm/models\n",
    },
    {"@fragment": _PAINTED.replace("@", ""), "@profile": "gazebo-classic"},
    _ARM,
    {**_ARM, "CMakeLists.txt": _BUILD.replace("urdf shapes", "${FOLDERS}")},
    {
        "@fragment": """
<visual name="v"><geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry></visual>
""",
        "meshes/wheel.dae": "<COLLADA/>",
    },
]
BAD = [
    {**_BELOW_MODELS, "@fragment": _VISUAL.format("  <!-- ^ REF002 -->")},
    {
        "@fragment": """
<visual name="v"><geometry><mesh>
  <uri>/home/ann/ws/src/rover/meshes/wheel.dae</uri>  <!-- ^ REF002 -->
</mesh></geometry></visual>
""",
        "meshes/wheel.dae": "",
    },
    """
<visual name="v"><geometry><mesh>
  <uri>file:///home/ann/ws/src/other/meshes/wheel.dae</uri>  <!-- ^ REF002 -->
</mesh></geometry></visual>
""",
    {
        **_ARM,
        "urdf/arm.urdf": _FORMER.replace("</visual>", "</visual> <!-- ^ REF002 -->").replace(
            "</collision>", "</collision> <!-- ^ REF002 -->"
        ),
    },
    {
        **_ARM,
        "CMakeLists.txt": _BUILD.replace(" shapes", ""),
        "urdf/arm.urdf": _ROBOT.replace("</visual>", "</visual> <!-- ^ REF002 -->").replace(
            "</collision>", "</collision> <!-- ^ REF002 -->"
        ),
    },
    {
        "@fragment": """
<visual name="v"><geometry><mesh>
  <uri>meshes/wheel.dae</uri>  <!-- ^ REF002 -->
</mesh></geometry></visual>
""",
        "meshes/Wheel.DAE": "<COLLADA/>",
    },
    _PAINTED.replace("@", "  <!-- ^ REF002 -->"),
]
