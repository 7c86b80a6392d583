"""The Gazebo in the README and CMakeLists.txt around models that are in no ROS package."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.files_above import README, files_above, own_files

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
_FORTRESS = re.compile(
    r"\b(?:gazebo|ignition) fortress\b|\bign gazebo\b|\bignition-gazebo6\b", re.IGNORECASE
)
_OTHER = re.compile(
    r"\bgz[ -]sim|\bGZ_SIM_|\bgazebo (?:sim|citadel|dome|edifice|garden|harmonic|ionic|jetty)\b"
    r"|\bignition[ -](?:citadel|dome|edifice|gazebo[345]\b)",
    re.IGNORECASE,
)


_RELEASE = re.compile(
    r"\b(?:gazebo(?:[ -]?sim)?|gz(?:[ -]sim)?|ignition|ros[-_]gz|gz_version)[ _=:-]{0,3}"
    r"(fortress|garden|harmonic|ionic|jetty)\b(?!%)",
    re.IGNORECASE,
)
"""`Gazebo Harmonic`, `gz-harmonic`, `GZ_VERSION=harmonic`, and the badge `Gazebo-Harmonic-blue`."""


def release_sign(package: Package) -> tuple[str, str]:
    """Return the release of Gazebo that README files alone name, and where; else nothing."""
    for sources in (own_files(package, README), *files_above(package, README)):
        named = [(it, match) for it in sources for match in _RELEASE.finditer(it.text)]
        if len({match[1].lower() for _, match in named}) == 1:
            source, match = named[0]
            words = f"{source.where(match.start())} names {match.group()}"
            return match[1].lower(), words
        if named:
            break
    return "", ""


def classic_sign(package: Package) -> str:
    """Return what names Gazebo Classic, and no later Gazebo: `../README.md:9 names gzserver`.

    The files of the nearest folder that names one of both count; empty if that is a later one.
    """
    return _sign(package, _CLASSIC, _LATER)


def fortress_sign(package: Package) -> str:
    """Return what names Gazebo Fortress, and no other release, in the same way."""
    return _sign(package, _FORTRESS, _OTHER)


def _sign(package: Package, named: re.Pattern[str], other: re.Pattern[str]) -> str:
    for sources in (own_files(package, _NAMES), *files_above(package, _NAMES)):
        if any(other.search(source.text) for source in sources):
            return ""
        for source in sources:
            if match := named.search(source.text):
                return f"{source.where(match.start())} names {match.group()}"
    return ""
