"""What shows that a package of ROS 1 is made for Gazebo Classic, for the report."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.package.detected_target import launching
from checker.package.distribution_sign import ros_1_sign
from checker.package.simulator_signs import CLASSIC, LAUNCH, signs_in_files
from checker.package.target import package_around

if TYPE_CHECKING:
    from checker.package.package import Package

_STARTS = {CLASSIC: LAUNCH[CLASSIC]}


def ros_1_target(package: Package) -> str:
    """Return the simulator and the release of ROS 1 that a package is made for, and the reasons.

    Its launch files show it: `Gazebo Classic with ROS 1: a.launch:3 names gazebo_ros`; else those
    that launch it. Empty where none starts Gazebo.

    Args:
        package: A package of ROS 1, or a model or file in one.
    """
    whole = (package_around(package) if package.only else None) or package
    starts = _start(whole)
    if not starts:
        others = ((_start(other), other.name) for other in launching(whole))
        found = (f"{start} in {name}, which launches it" for start, name in others if start)
        starts = next(found, "")
    if not starts:
        return ""
    release = ros_1_sign(whole)
    if release is None:
        return f"Gazebo Classic with ROS 1: {starts}"
    return f"Gazebo Classic with ROS {release.distro.capitalize()}: {starts}, {release.words}"


def _start(package: Package) -> str:
    """Return the first place in launch files of ROS 1 that names Gazebo: `a.launch:3 names …`."""
    paths = (file.path for file in package.index.with_suffix(".launch", ".launch.xml"))
    return next((words for _, words in signs_in_files(package, paths, _STARTS, ros_1=True)), "")
