"""The package name does not follow the challenge's pattern.

The SubT launcher builds the name of the robot's configuration from the folder's name. It cannot
start a package whose folder has another name.

Fix: rename the folder to `<organization>_<robot>_sensor_config_<#>`: lower case letters, digits
and `_`, the number from 1 without leading zeros.
Source: Model Migration Guide, step 4.
"""

import re
from collections.abc import Iterator

from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_PATTERN = re.compile(r"([a-z0-9]+(?:_[a-z0-9]+)*)_sensor_config_([0-9]+)")


@rule("PKG001", "package-name", Severity.ERROR, Concern.PAPERWORK)
def check(package: Package) -> Findings:
    """Report folder names that do not match the pattern."""
    if package.kind in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
        yield from _faults(package)


def _faults(package: Package) -> Iterator[Finding]:
    name, place = package.name, package.folder_place()
    match = _PATTERN.fullmatch(name)
    if match is None:
        expected = _expected(package.declared_name)
        yield finding(place, f"the folder is called {name!r}, expected {expected}", key="pattern")
        return
    robot, number = match.groups()
    if number.startswith("0"):
        yield finding(place, f"the configuration number of {name!r} is {number}, expected 1, 2, …")
    if "_" not in robot:
        yield finding(
            place,
            f"the package {name!r} has no organization in front of {robot!r}",
            severity=Severity.WARNING,
        )


def _expected(name: str) -> str:
    lower = re.sub(r"[^a-z0-9]+", "_", name.lower()).strip("_")
    if _PATTERN.fullmatch(lower):
        return repr(lower)
    return "<organization>_<robot>_sensor_config_<#> in lower case"


GOOD = [{"@name": "acme_rover_sensor_config_1"}]
BAD = [
    {"@name": "Acme-Rover_sensor_config_1", "@reported": [".:1"]},
    {"@name": "acme_rover_sensor_config_0", "@reported": [".:1"]},
    {"@name": "rover_sensor_config_2", "@reported": [".:1"]},
]
