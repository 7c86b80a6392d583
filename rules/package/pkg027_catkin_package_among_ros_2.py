"""A package of ROS 1 among packages of ROS 2.

`colcon build` stops at it: CMake does not find catkin, which ROS 2 does not have, and what comes
after it is not built. Packages that the SolidWorks exporter writes are of ROS 1.

Only a package in the same folder `src` as one of ROS 2, or beside one that is checked too, is
reported; one that supports both by conditions is right. One whose CMakeLists.txt calls nothing of
catkin is built, whatever package.xml names.

Fix: port package.xml, CMakeLists.txt and the launch files to ROS 2 (`ament_cmake`); or put an empty
file COLCON_IGNORE into the folder of the package.
Source: colcon-ros, which builds packages of type `ros.catkin` with CMake; ROS 2 documentation,
"Migrating from ROS 1 to ROS 2"; catkin has no release for ROS 2.
"""

import os
from pathlib import Path

from checker.launch.ros2.package_launch import built_by_ament, is_ros2_only
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_IGNORED = ("COLCON_IGNORE", "AMENT_IGNORE")


@rule("PKG027", "catkin-package-among-ros-2", Severity.WARNING, Concern.PAPERWORK)
def check(package: Package, papers: Paperwork) -> Findings:
    """Report a package that only catkin builds, in a workspace with one that only ament builds."""
    if papers.manifest is None or built_by_ament(package) or any(map(package.exists, _IGNORED)):
        return
    if _builds_without_catkin(package):
        return
    tools = (
        each.package
        for each in papers.manifest.dependencies
        if (each.kind, each.package.value) == ("buildtool_depend", "catkin")
        and not each.is_conditional
    )
    others = (it for it in package.other_packages if is_ros2_only(it))
    beside = next((it for it in others if _builds_with(package, it.root)), None)
    if beside is None:
        return
    for tool in tools:
        yield finding(
            tool,
            f"colcon build stops here: ROS 2 has no catkin, and {beside.declared_name} beside it "
            "is of ROS 2: port the package to ament_cmake, or put an empty file COLCON_IGNORE "
            "into its folder",
        )


def _builds_without_catkin(package: Package) -> bool:
    """Return whether CMakeLists.txt names no catkin in what it calls: colcon runs CMake alone."""
    calls = package.build.calls if package.build is not None else ()
    words = (word for call in calls for word in (call.name, *(it.value for it in call.arguments)))
    return bool(calls) and not any("catkin" in word.lower() for word in words)


def _builds_with(package: Package, other: Path) -> bool:
    """Return whether one call of colcon builds a package and that in another folder."""
    given = package.workspace.given
    checked = given is not None and other.is_relative_to(given)
    above = Path(os.path.commonpath((package.root, other)))
    return above.name == "src" or (checked and other.parent == package.root.parent)


def _manifest(tool: str, mark: str = "") -> str:
    return f"""<package format="3">
  <name>acme_arm_description</name>
  <buildtool_depend>{tool}</buildtool_depend>{mark}
</package>
"""


_DRIVER = {
    "@name": "src/acme_arm_description",
    "../acme_arm_driver/package.xml": _manifest("ament_cmake"),
}
_BOTH = """<package format="3">
  <name>acme_arm_description</name>
  <buildtool_depend condition="$ROS_VERSION == 1">catkin</buildtool_depend>
  <buildtool_depend condition="$ROS_VERSION == 2">ament_cmake</buildtool_depend>
</package>
"""
GOOD = [
    {"@urdf": True, "package.xml": _manifest("catkin")},
    {"@urdf": True, "package.xml": _manifest("ament_cmake"), **_DRIVER},
    {"@urdf": True, "package.xml": _BOTH, **_DRIVER},
    {"@urdf": True, "package.xml": _manifest("catkin"), "COLCON_IGNORE": "", **_DRIVER},
    {
        "@urdf": True,
        "package.xml": _manifest("catkin"),
        "CMakeLists.txt": "project(acme)\nfind_package(ament_cmake REQUIRED)\nament_package()\n",
        **_DRIVER,
    },
]
BAD = [{"@urdf": True, "package.xml": _manifest("catkin", "  <!-- ^ PKG027 -->"), **_DRIVER}]
