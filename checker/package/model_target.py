"""The Gazebo that a model or world is made for, where that is not what its package is made for."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.detected_target import classic_reason
from checker.package.gazebo_sign import classic_sign, fortress_sign
from checker.package.simulator_signs import (
    CLASSIC,
    DESCRIPTION,
    GZ,
    IGNITION,
    LAUNCH,
    ROS_GZ,
    signs_in_files,
)

if TYPE_CHECKING:
    from checker.package.package import Package

_LATER = (IGNITION, GZ, ROS_GZ)
_OF_IGNITION = re.compile(r"\blibignition-gazebo\d*-[\w-]+-system\.so\b")


def model_target(package: Package, around: Package | None, *, in_classic: bool) -> tuple[str, str]:
    """Return the Gazebo of a model, `CLASSIC` or `IGNITION`, and what shows it; else nothing.

    Args:
        package: The model or world.
        around: The package of ROS 2 that it is in, if any.
        in_classic: Whether that package is for Gazebo Classic.
    """
    classic = fortress = ""
    if in_classic:
        fortress = _ignition_sign(package)
    elif around is not None:
        classic = _classic_model_sign(package, around)
    else:
        classic = classic_sign(package)
        fortress = "" if classic else fortress_sign(package)
        if not (classic or fortress) and (beside := _classic_beside(package)):
            fortress = _ignition_sign(package)
            classic = "" if fortress else beside
    if classic:
        return CLASSIC, classic_reason(classic)
    return (IGNITION, f"Gazebo Fortress: {fortress}") if fortress else ("", "")


def _classic_beside(package: Package) -> str:
    """Return what shows that packages beside a model are for Classic, and none for a later Gazebo.

    Args:
        package: A model or world in no package.
    """
    signs: dict[str, str] = {}
    for other in package.workspace.packages.values():
        for simulator, words in other.simulator_signs.items():
            signs.setdefault(simulator, f"{words} in {other.name}")
    return signs[CLASSIC] if [*signs] == [CLASSIC] else ""


def _classic_model_sign(package: Package, around: Package) -> str:
    """Return what shows that a model or world is for Classic, in a package that names more; or "".

    A launch file that names it shows which simulator gets it; where none does, or launch files of
    both, its own plugins.

    Args:
        package: The model or world.
        around: The package of ROS 2 that it is in.
    """
    starting = package.workspace.launches_with(package.name)
    in_classic = any(LAUNCH[CLASSIC].search(text) for text in starting)
    in_later = any(LAUNCH[later].search(text) for text in starting for later in _LATER)
    if in_later and not in_classic:
        return ""
    own = _own_signs(package, DESCRIPTION)
    if [*own] == [CLASSIC] and (in_classic or CLASSIC in around.simulator_signs):
        return own[CLASSIC]
    is_alone = in_classic and not in_later and not own
    return f"a launch file of Gazebo Classic names {package.name}" if is_alone else ""


def _ignition_sign(package: Package) -> str:
    """Return what shows that a model or world is for Ignition, where all else is for Classic.

    Empty if nothing does, as where it has its own package.xml, or a launch file names it.
    """
    if package.exists("package.xml") or package.workspace.launches_with(package.name):
        return ""
    return _own_signs(package, {IGNITION: _OF_IGNITION}).get(IGNITION, "")


def _own_signs(package: Package, patterns: dict[str, re.Pattern[str]]) -> dict[str, str]:
    """Return which simulators a model or world names, each with the first place that does."""
    paths = (file.path for file in package.index.with_suffix(".sdf", ".world"))
    return dict(reversed([*signs_in_files(package, paths, patterns)]))
