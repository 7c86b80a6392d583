"""A relative URI that leaves the package.

After an upload a package is alone: other packages are not next to it, and a path such as
`../other_robot/meshes/wheel.dae` leads nowhere. This is also true for a path through the package's
own name. If package.xml names the other package as a dependency and has the file, the two are
installed together, and this is an info. For a texture it is a warning: the part is there without
it. No accepted package that we checked has this fault.

Fix: copy the file into the package, and write the path from model.sdf to it.
Source: Model Migration Guide, steps 6 to 8: gather all meshes and materials in the package, and use
relative URIs.
"""

import posixpath
import re

from checker.model.named_files import NamedFiles
from checker.model.robot import Robot
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]*:")


@rule("REF003", "uri-leaves-package", Severity.ERROR, Concern.ROBOT)
def check(files: NamedFiles, package: Package, paperwork: Paperwork) -> Findings:
    """Report relative URIs that lead out of the package that states them."""
    manifest = paperwork.manifest
    for uri in files.uris:
        if _SCHEME.match(uri.value) or uri.value.startswith("/"):
            continue
        path = _from_package(Robot.folder_of(uri), uri.value)
        if not path.startswith("../"):
            continue
        other = path.split("/")[1]
        together = manifest is not None and manifest.depends_on(other) and package.exists(path)
        severity = None if uri in files.meshes else Severity.WARNING
        yield finding(
            uri,
            f"{uri.value} leaves the package: copy the file into the package",
            severity=Severity.INFO if together else severity,
            key=other,
        )


def _from_package(folder: str, uri: str) -> str:
    """Return where a URI leads, from the folder of the package whose model states it."""
    inside = folder.split("/", 2)[2:] if folder.startswith("../") else [folder]
    return posixpath.normpath(posixpath.join(*inside, uri))


GOOD = [
    """
<visual name="v"><geometry><mesh><uri>meshes/../meshes/wheel.dae</uri></mesh></geometry></visual>
""",
    """
<visual name="v"><geometry><mesh><uri>model://rover/meshes/wheel.dae</uri></mesh></geometry></visual>
""",
]
BAD = [
    """
<visual name="v"><geometry><mesh>
  <uri>../x1_sensor_config_6/meshes/wheel.dae</uri>  <!-- ^ REF003 -->
</mesh></geometry></visual>
""",
    """
<collision name="c"><geometry><mesh>
  <uri>meshes/../../acme_rover_sensor_config_1/meshes/wheel.dae</uri>  <!-- ^ REF003 -->
</mesh></geometry></collision>
""",
]
