"""The configurations of one robot: packages whose names differ in the last number."""

from __future__ import annotations

import re

from checker.package.package import Package

_NUMBERED = re.compile(r"(.+_sensor_config_)([1-9][0-9]{0,5})")


def first_configuration(package: Package) -> Package | None:
    """Return the configuration of lowest number at hand; None for that package itself."""
    own = _NUMBERED.fullmatch(package.name)
    if own is None or package.only:
        return None
    first, number = package, int(own.group(2))
    for name, other in package.workspace.packages.items():
        match = _NUMBERED.fullmatch(name)
        if match and match.group(1) == own.group(1) and int(match.group(2)) < number:
            first, number = other, int(match.group(2))
    return None if first is package else first
