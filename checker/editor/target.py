"""The target of a package: the release and version that an editor shows."""

from __future__ import annotations

from checker.base.resources import table
from checker.formats.sdf.schema import VERSIONS
from checker.package.package import Package
from checker.rule import Context
from checker.settings import Settings


def usual_target(package: Package) -> Context:
    """Return the target of a package for which the user names none."""
    return Settings().for_package(package).judge_profile.context


def plugin_releases(target: Context) -> tuple[str, ...]:
    """Return the releases whose plugins the target has, the newest of all first if it has none."""
    known = tuple(table("gazebo_plugins")["releases"])
    return (target.release,) if target.release in known else known[::-1]


def schema_version(stated: str, target: Context) -> str:
    """Return the SDF version to show: the file's own, else what the target reads."""
    if stated in VERSIONS:
        return stated
    return target.reads if target.reads in VERSIONS else VERSIONS[-1]
