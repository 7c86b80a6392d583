"""Gazebo Classic in the README and CMakeLists.txt around models that are in no ROS package."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.files_above import files_above, own_files

if TYPE_CHECKING:
    from checker.package.package import Package

_NAMES = re.compile(r"\A(?:\.\./)*(?:readme(?:\.\w{1,4})?|cmakelists\.txt)\Z")
_CLASSIC = re.compile(
    r"\bGAZEBO_(?:MODEL|PLUGIN|RESOURCE)_PATH\b|/share/gazebo/setup\.(?:ba)?sh"
    r"|\bgz(?:server|client)\b|\bgazebo_ros\b|\bfind_package\(\s{0,8}gazebo\b",
    re.IGNORECASE,
)
_LATER = re.compile(
    r"\b(?:gz|ign)[ -](?:sim|gazebo|launch)|\b(?:GZ_SIM|IGN_GAZEBO)_|\bros_(?:gz|ign)"
    r"|\bignition[ -]gazebo|\bgazebo (?:sim|fortress|garden|harmonic|ionic|jetty)\b"
    r"|\bfind_package\(\s{0,8}(?:gz|ignition)-",
    re.IGNORECASE,
)


def classic_sign(package: Package) -> str:
    """Return what names Gazebo Classic, and no later Gazebo: `../README.md:9 names gzserver`.

    The files of the nearest folder that names one of both count; empty if that is a later one.
    """
    for sources in (own_files(package, _NAMES), *files_above(package, _NAMES)):
        if any(_LATER.search(source.text) for source in sources):
            return ""
        for source in sources:
            if match := _CLASSIC.search(source.text):
                line, _ = source.position(match.start())
                return f"{source.file}:{line} names {match.group()}"
    return ""
