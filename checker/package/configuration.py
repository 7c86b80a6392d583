"""The configurations of one robot: packages whose names differ in the last number."""

from __future__ import annotations

import re

from checker.package.package import Package

_NUMBERED = re.compile(r"(.+_sensor_config_)([1-9][0-9]{0,5})")


def configurations(package: Package) -> tuple[int, dict[int, Package]] | None:
    """Return a package's number, and the available configurations of its robot by number.

    None for a package that is not a numbered configuration.
    """
    own = _NUMBERED.fullmatch(package.name)
    if own is None or package.only:
        return None
    packages = {int(own.group(2)): package}
    for name, other in package.workspace.packages.items():
        match = _NUMBERED.fullmatch(name)
        if match and match.group(1) == own.group(1):
            packages.setdefault(int(match.group(2)), other)
    return int(own.group(2)), packages


def configuration_number(package: Package) -> int:
    """Return the number at the end of a package's name; 1 for a name without."""
    number = re.search(r"_([0-9]{1,4})$", package.name)
    return int(number.group(1)) if number else 1


def first_configuration(package: Package) -> Package | None:
    """Return the configuration of lowest number that is available; None for that package itself."""
    known = configurations(package)
    if known is None:
        return None
    number, packages = known
    first = min(packages)
    return packages[first] if first < number else None
