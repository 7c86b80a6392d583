"""RViz or Gazebo cannot find a mesh of a URDF file.

Both look for `package://<package>/<path>`. An absolute path works only on the author's machine, and
a path relative to the file only for a program that loads the file itself, as `gz sim` can, not for
one that gets its text, as RViz does; elsewhere the part is invisible. `package:///` names no
package: only Pinocchio reads it as `package://`. `$(find <package>)/<path>` is right on every
machine, but RViz loads it only behind `file://`. The simulation of a robot in SDF does not need the
file, so this is a warning. A path with a drive letter of Windows to a file that the package has is
an error. URD001 reports a `$(find …)` that is not expanded.

Fix: write `package://<package>/<path>`, or `file://` before `$(find <package>)`.
Source: URDF specification, mesh/filename; RViz loads meshes with resource_retriever; Gazebo Classic
reads `package://` as `model://`.
"""

import posixpath
import re
from collections import defaultdict
from collections.abc import Iterator

from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expanded import ExpandedText
from checker.package.package import Package
from checker.package.uris import own_path_on_machine, uri_of_installed
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
)
from checker.source.text import Located

_PACKAGE = re.compile(r"package://([^/]+)/(.*)", re.DOTALL)
_FETCHED = ("http://", "https://")
_FOUND = "$(find "
_NO_PACKAGE, _MODEL = "package:///", "model://"
_ABSOLUTE = ("/", "file:///", _NO_PACKAGE)


@rule("URD002", "mesh-uri", Severity.WARNING, Concern.ROBOT)
def check(package: Package, description: UrdfDescription) -> Findings:
    """Report meshes without `package://`; for RViz, also those that do not exist.

    In a URDF package REF002 reports missing files. A model folder of Gazebo may have `model://` and
    relative paths, and so may a folder that is not a ROS package: other readers take paths from the
    file's own folder.
    """
    outside = package.exists("model.config") or not package.exists("package.xml")
    in_model = package.is_urdf and outside
    missing: dict[str, list[Located[str]]] = defaultdict(list)
    for uri in description.robot.file_uris:
        if uri.value.startswith(_FETCHED) or _FOUND in uri.value:
            continue
        if own := own_path_on_machine(package, uri.value):
            severity = None if description.for_rviz else Severity.ERROR
            yield _on_machine(package, uri, own, severity)
            continue
        named = _PACKAGE.match(uri.value)
        if uri.value.startswith(_MODEL) and _is_of_model(package, uri):
            continue
        if named is None and in_model and not uri.value.startswith(_ABSOLUTE):
            continue
        wrong = _of_other_scheme(uri)
        if wrong is not None or named is None:
            yield wrong or _without_package(package, uri)
        elif description.for_rviz:
            name, path = named.groups()
            folder = _folder(package, name)
            if folder is None:
                yield _of_another(uri, name)
            elif not package.exists(posixpath.normpath(folder + path)):
                missing[uri.value].append(uri)
    yield from _missing(missing)


def _is_of_model(package: Package, uri: Located[str]) -> bool:
    """Return whether the file that names a mesh is in a model folder of Gazebo."""
    folder = posixpath.dirname(uri.span.source.file)
    return package.exists(posixpath.join(folder, "model.config"))


def _of_other_scheme(uri: Located[str]) -> Finding | None:
    """Report a URI of three slashes, and a path that xacro makes of `$(find p)/x`."""
    if uri.value.startswith(_NO_PACKAGE):
        return finding(
            uri,
            f"mesh {uri.value!r} names no package, so RViz and Gazebo do not find it: write "
            "package:// with two slashes",
            key="three slashes",
        )
    source = uri.span.source
    if not isinstance(source, ExpandedText) or not source.states_bare_path(uri.value):
        return None
    name, _, path = uri.value.removeprefix("package://").partition("/")
    written = f"$(find {name})/{path}"
    return finding(
        uri,
        f"mesh {written!r} has no scheme, which RViz needs and Gazebo does not: write "
        f"file://{written}",
        key="no scheme",
    )


def _without_package(package: Package, uri: Located[str]) -> Finding:
    if uri.value.startswith(_MODEL):
        return finding(
            uri,
            f"mesh {uri.value!r} is found by Gazebo alone, on its model path: RViz needs package://",
            key="model",
        )
    if uri.value.startswith("/") or ":" in uri.value:
        where, meant = "is found only on the machine of its author", uri_of_installed(uri.value)
    else:
        path = posixpath.normpath(
            posixpath.join(posixpath.dirname(uri.span.source.file), uri.value)
        )
        is_there = package.exists("package.xml") and package.exists(path)
        where = "is relative, so RViz does not find it"
        meant = f"package://{package.declared_name}/{path}" if is_there else ""
    return finding(
        uri,
        f"mesh {uri.value!r} {where}: write {meant or 'package://<package>/<path>'}",
        key="no package",
        fix=replace_text(uri, meant, Safety.UNSAFE) if meant else None,
    )


def _on_machine(
    package: Package, uri: Located[str], path: str, severity: Severity | None
) -> Finding:
    folder = posixpath.dirname(uri.span.source.file)
    is_ros = package.exists("package.xml")
    named = f"package://{package.declared_name}/{path}"
    return finding(
        uri,
        f"mesh {uri.value!r} is on its author's machine and is found on no other: write "
        f"{named if is_ros else posixpath.relpath(path, folder or '.')}",
        severity=severity,
        key="machine",
    )


def _folder(package: Package, name: str) -> str | None:
    """Return the path from a package to the one in a URI; None if it is not available."""
    sibling = package.workspace.package(name)
    if name.casefold() == package.name.casefold() or sibling is package:
        return ""
    return None if sibling is None else f"../{sibling.name}/"


def _of_another(uri: Located[str], name: str) -> Finding:
    return finding(
        uri,
        f"the meshes of {name} are not available, so RViz needs that package too",
        severity=Severity.INFO,
        key=name,
    )


def _missing(uris: dict[str, list[Located[str]]]) -> Iterator[Finding]:
    """Report missing files as one finding: usually one missing folder contains them all."""
    others = len(uris) - 1
    also = f", nor {'does 1 other mesh' if others == 1 else f'do {others} other meshes'}"
    for uri, places in uris.items():
        for place in places:
            yield finding(place, f"{uri} does not exist{also if others else ''}", key="missing")


_DESCRIPTION = "urdf/robot_from_sdf.xacro"
_MESH = "meshes/wheel.dae"


def _visual(uri: str) -> str:
    return f"""<robot name="rover">
  <link name="base_link">
    <visual>
      <geometry>
        <mesh filename="{uri}
      </geometry>
    </visual>
  </link>
</robot>
"""


def _example(uri: str) -> dict[str, str]:
    return {_DESCRIPTION: _visual(uri), _MESH: "<COLLADA/>"}


_OWN = "package://acme_rover_sensor_config_1/meshes"
_MARK = '"/>  <!-- ^ URD002 -->'
GOOD = [
    {"@urdf": True, "urdf/arm.urdf": _visual('file://$(find other_arm)/meshes/wheel.dae"/>')},
    {
        "models/wheel/model.config": "<model/>",
        "models/wheel/wheel.urdf": _visual('model://wheel/wheel.dae"/>'),
        "models/wheel/wheel.dae": "<COLLADA/>",
    },
    _example(f'{_OWN}/wheel.dae"/>'),
    _example('https://example.org/wheel.dae"/>'),
    {
        _MESH: "<COLLADA/>",
        _DESCRIPTION: _visual('file://$(find acme_rover_sensor_config_1)/meshes/wheel.dae"/>'),
    },
]
BAD = [
    _example(f"{_OWN}/weel.dae{_MARK}"),
    _example(f"meshes/wheel.dae{_MARK}"),
    _example(f"model://wheel/wheel.dae{_MARK}"),
    _example(f"file:///home/me/wheel.dae{_MARK}"),
    _example(f"file:///home/me/ws/install/acme_arm/share/acme_arm/meshes/wheel.dae{_MARK}"),
    _example(f"package://other_description/meshes/wheel.dae{_MARK}"),
    _example(f"$(find acme_rover_sensor_config_1)/meshes/wheel.dae{_MARK}"),
    {"@urdf": True, _MESH: "<COLLADA/>", **_example(f"D:\\work\\rover/meshes/wheel.dae{_MARK}")},
    {
        "@urdf": True,
        "package.xml": None,
        _MESH: "<COLLADA/>",
        "urdf/arm.urdf": _visual(f"D:/work/rover/meshes/wheel.dae{_MARK}"),
    },
    {
        "@urdf": True,
        "package.xml": None,
        "urdf/arm.urdf": _visual(f"package:///other_description/meshes/wheel.dae{_MARK}"),
    },
]
