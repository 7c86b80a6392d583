"""The profile that suits a package, detected from its content."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from checker.package.inheritance import SUBMISSION_NAME
from checker.package.kind import PackageKind, enclosing_package, is_launch_name
from checker.package.simulator_signs import is_described_for_ros_2
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

if TYPE_CHECKING:
    from checker.package.package import Package

SUBMISSION, ROS_1, ROS_2, MODEL, ANY_SDF = "subt", "urdf", "ros2", "gazebo-harmonic", "sdf"
MUJOCO = "mujoco"
_OF_ROS_2 = ("ament_", "rclcpp", "rclpy", "ros_gz", "rosidl_", "launch_ros", "ros2")
"""Beginnings of names of packages that only ROS 2 has."""
_OF_SUBT = re.compile(r"(?<![a-z])subt(?![a-z]|-check)", re.IGNORECASE)
"""Names of the challenge in files: `subt_ros`, `subt::`, `SubT`."""
_NAMING = (".xml", ".sdf", ".launch", ".md", ".rb", "cmakelists.txt")
_LEVELS = 6
_SUBMISSIONS = (PackageKind.ROBOT, PackageKind.CONFIGURATION)


def usual_profile(package: Package) -> str:
    """Return the profile that judges a package where the user names none.

    A submission is one by its name, its spawner or its bridges; a package of ROS 2 by its build
    type or its dependencies, a loose folder by its launch files. Another one that names SubT
    nowhere is of ROS 1, or a model for any Gazebo. A model of MuJoCo without a package is for
    MuJoCo, wherever it lies. Another model, a world or a single file is judged as the package
    around it is; without one, it is Gazebo's, even where model.config names a URDF file, and other
    URDF is of ROS 2 or ROS 1 by its content.
    """
    if package.kind in _SUBMISSIONS:
        return SUBMISSION
    manifest = None if package.only else package.xml("package.xml")
    if isinstance(manifest, XmlDocument):
        return _of_manifest(package, manifest)
    if loose := _of_loose_files(package):
        return loose
    around = _usual_around(package)
    if package.is_urdf and not package.exists("model.config"):
        by_content = around != SUBMISSION and is_described_for_ros_2(package)
        return ROS_2 if around == ROS_2 or by_content else ROS_1
    if package.only and around == SUBMISSION:
        return SUBMISSION
    return ANY_SDF if around in (ROS_1, ANY_SDF) else MODEL


def _of_loose_files(package: Package) -> str:
    """Return the profile of models of MuJoCo, or of launch files, without a package."""
    if package.kind is PackageKind.MUJOCO_MODEL:
        return MUJOCO
    is_launched = any(is_launch_name(file.path) for file in package.index.files)
    return ROS_2 if package.is_loose and is_launched else ""


def ros_2_package(package: Package) -> Package | None:
    """Return the package of ROS 2 that a package is, or that a model or file is in."""
    return next((each for each in _holders(package) if usual_profile(each) == ROS_2), None)


def is_of_catkin(package: Package) -> bool:
    """Return whether a package, or that around a model or file, is built by catkin for ROS 1."""
    return any(usual_profile(each) == ROS_1 and _needs_catkin(each) for each in _holders(package))


def _holders(package: Package) -> list[Package]:
    manifest = None if package.only else package.xml("package.xml")
    around = None if isinstance(manifest, XmlDocument) else package_around(package)
    return [each for each in (around, package) if each is not None]


def _needs_catkin(package: Package) -> bool:
    manifest = package.xml("package.xml")
    return isinstance(manifest, XmlDocument) and any(
        child.text.value.strip() == "catkin" for child in manifest.root.all("buildtool_depend")
    )


def _usual_around(package: Package) -> str:
    """Return the profile of the package that a model or file is in; empty without one."""
    whole = package_around(package)
    return usual_profile(whole) if whole is not None else ""


def package_around(package: Package) -> Package | None:
    """Return the available package that a model folder, or a single file, is in."""
    folder = package.root if package.only else package.root.parent
    around = enclosing_package(folder, _LEVELS)
    whole = package.workspace.package(around.name) if around else None
    return whole if whole is not None and whole.root == around else None


def names_mentioned_around(package: Package) -> frozenset[str]:
    """Return the names that files of a package mention, and of the one that a model is in."""
    around = package_around(package)
    return package.mentioned_names | (around.mentioned_names if around else frozenset())


def _of_manifest(package: Package, manifest: XmlDocument) -> str:
    if _is_ros_2(package, manifest):
        return ROS_2
    if package.is_urdf:
        return ROS_1
    if _is_of_subt(package):
        return SUBMISSION
    return ANY_SDF if package.kind is PackageKind.BASE_MODEL else ROS_1


def _is_of_subt(package: Package) -> bool:
    """Return whether a package is for the challenge: it is next to submissions, or names SubT."""
    if any(map(SUBMISSION_NAME.search, package.workspace.packages)):
        return True
    texts = (package.read(file.path) for file in package.index.with_suffix(*_NAMING))
    return any(isinstance(text, SourceText) and _OF_SUBT.search(text.text) for text in texts)


def _is_ros_2(package: Package, manifest: XmlDocument) -> bool:
    if package.build_type is not None:
        return package.build_type.startswith("ament_")
    return any(
        child.tag.endswith("depend") and child.text.value.startswith(_OF_ROS_2)
        for child in manifest.root.children
    )
