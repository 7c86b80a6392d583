"""A Fuel URI that leads nowhere.

Gazebo downloads the file that such a URI names. It does not understand a URI of another form, and
it cannot download a file that its package does not have. Blanks in it are allowed. The models that
`<depend>` of model.config names are downloaded too; a blank in such a name is reported if the
package of that name, here or in package.xml, has an underscore in its place.

Fix: write `https://fuel.ignitionrobotics.org/1.0/<owner>/models/<name>/tip/files/<path>`; or
better, write the relative path of a file in the package.
Source: general knowledge of the URIs that ign-fuel-tools reads.
"""

import re
from collections.abc import Iterator

from checker.model.named_files import NamedFiles
from checker.package.fuel import is_on_fuel, package_on_fuel, read_fuel_uri
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, replace_text, rule

_MEANT = {True: "<owner>/models/<name>/tip/files/<path>", False: "<owner>/models/<name>"}


@rule("REF004", "broken-fuel-uri", Severity.ERROR, Concern.ROBOT)
def check(package: Package, files: NamedFiles, paperwork: Paperwork) -> Findings:
    """Report Fuel URIs of another form, and files that an available package does not have."""
    yield from _depends(package, paperwork)
    for uri in (*files.uris, *files.includes):
        if not is_on_fuel(uri.value):
            continue
        is_file = uri in files.uris
        named = read_fuel_uri(uri.value)
        if named is None or bool(named.path) is not is_file:
            yield finding(uri, f"Fuel URI {uri.value} is not of the form {_MEANT[is_file]}")
            continue
        holder = package_on_fuel(package, named.model) if is_file else None
        if holder is not None and not holder.exists(named.path):
            yield finding(uri, f"{uri.value}: {holder.name} does not have {named.path}")


def _depends(package: Package, paperwork: Paperwork) -> Iterator[Finding]:
    """Report models that model.config needs under a name that they do not have."""
    for uri in paperwork.config.depends if paperwork.config is not None else ():
        if not is_on_fuel(uri.value):
            continue
        named = read_fuel_uri(uri.value)
        if named is None or named.path:
            yield finding(uri, f"Fuel URI {uri.value} is not of the form {_MEANT[False]}")
            continue
        name = re.sub(r"\s+", "_", named.model)
        if name != named.model and _is_known(package, paperwork, name):
            yield finding(
                uri,
                f"Fuel URI {uri.value} has a blank in the name: the package is {name}",
                severity=Severity.WARNING,
                key="blank in a name",
                fix=replace_text(uri, re.sub(r"(?:\s|%20)+", "_", uri.value)),
            )


def _is_known(package: Package, paperwork: Paperwork, name: str) -> bool:
    """Return whether a package of this name is available, or package.xml depends on it."""
    manifest = paperwork.manifest
    declared = manifest is not None and manifest.depends_on(name)
    return declared or package_on_fuel(package, name) is not None


def _visual(path: str) -> str:
    fuel = "https://fuel.ignitionrobotics.org/1.0/acme/models"
    return f"""
<visual name="v"><geometry><mesh>
  <uri>{fuel}/{path}
</mesh></geometry></visual>
"""


def _needs(name: str, mark: str = "") -> dict[str, str]:
    uri = f"https://fuel.ignitionrobotics.org/1.0/openrobotics/models/{name}"
    return {
        "model.config": f"""<model>
  <depend><model><uri>{uri}</uri></model></depend>{mark}
</model>
""",
        "package.xml": "<package><name>r</name><run_depend>acme_arm</run_depend></package>",
    }


_MARK = "  <!-- ^ REF004 -->"
_OWN = "ACME_ROVER_SENSOR_CONFIG_1/tip/files/meshes/wheel.dae"

GOOD = [
    {"@fragment": _visual(f"{_OWN}</uri>"), "meshes/wheel.dae": "<COLLADA/>"},
    _visual("Rover/2/files/meshes/wheel%20rim.dae</uri>"),
    _visual("Rover/tip/files/meshes/wheel rim.dae</uri>"),
    _needs("acme_arm"),
    _needs("Cave Bend 01"),
]
BAD = [
    _visual("Rover/meshes/wheel.dae</uri>  <!-- ^ REF004 -->"),
    _visual(f"{_OWN}</uri>  <!-- ^ REF004 -->"),
    _needs("acme arm", _MARK),
    _needs("acme_arm/meshes/arm.dae", _MARK),
]
