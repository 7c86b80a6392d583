"""The URI of a mesh or texture that is not relative.

After an upload the files of a package are in another place and under another name. `model://`,
`package://`, `file://` and absolute paths then lead nowhere: the part is invisible or has no
collision. For a texture this is a warning: the part is there without it. URIs of models on Fuel are
fine; SDF015 reports URIs of `<script>`.

Fix: write the path from model.sdf to the file, such as `meshes/wheel.dae`.
Source: Model Migration Guide, step 8: "Use relative URIs".
"""

import posixpath
import re

from checker.model.named_files import NamedFiles
from checker.model.robot import Robot
from checker.package.package import Package
from checker.package.uris import path_behind
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule
from checker.source.text import Located

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


@rule("REF001", "absolute-uri", Severity.ERROR, Concern.PORTABILITY)
def check(
    package: Package,
    files: NamedFiles,
    *,
    allowed: tuple[str, ...] = ("https://fuel.ignitionrobotics.org", "https://fuel.gazebosim.org"),
) -> Findings:
    """Report URIs with a scheme, and absolute paths.

    Options:
        allowed: Prefixes of URIs, including the scheme, that are allowed, such as those of models
            on Fuel.
    """
    for uri in files.uris:
        scheme = _SCHEME.match(uri.value)
        if (scheme is None and not uri.value.startswith("/")) or uri.value.startswith(allowed):
            continue
        near = _in_package(package, Robot.folder_of(uri), uri)
        hint = f"; write {near}" if near else ""
        yield finding(
            uri,
            f"URI {uri.value} is not relative{hint}",
            severity=None if uri in files.meshes else Severity.WARNING,
            key=scheme.group() if scheme else "/",
            fix=replace_text(uri, near) if near else None,
            covered_by=() if near else ("REF002",),
        )


def _in_package(package: Package, folder: str, uri: Located[str]) -> str | None:
    """Return the relative path of the intended file, if the package has it."""
    target = path_behind(package, folder, uri.value)
    if isinstance(target, str) and target.startswith("../") and package.exists(target):
        return None  # The file of a sibling, and one of the same name here may hold something else.
    path = _SCHEME.sub("", uri.value, count=1).lstrip("/")
    while path:
        if package.exists(posixpath.join(folder, path)):
            return path
        path = path.partition("/")[2]
    return None


GOOD = [
    {
        "@fragment": """
<visual name="v"><geometry><mesh><uri>meshes/wheel.dae</uri></mesh></geometry></visual>
""",
    },
]
BAD = [
    {
        "@fragment": """
<visual name="v"><geometry><mesh>
  <uri>model://rover/meshes/wheel.dae</uri>  <!-- ^ REF001 -->
</mesh></geometry></visual>
""",
        "meshes/wheel.dae": "",
    },
    """
<collision name="c"><geometry><mesh>
  <uri>package://rover/meshes/wheel.dae</uri>  <!-- ^ REF001 -->
</mesh></geometry></collision>
<visual name="v"><geometry><mesh>
  <uri>/home/me/wheel.dae</uri>  <!-- ^ REF001 -->
</mesh></geometry></visual>
""",
]
