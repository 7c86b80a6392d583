"""A launch file of ROS 1 takes a file from a package that does not exist.

roslaunch stops where it evaluates `$(find …)` of a package that is not there: nothing starts. It is
reported if the workspace has a package of nearly the same name, no ROS distribution has the one
that is written, and package.xml does not declare it.

Fix: write the name of the package that exists.
Source: roslaunch XML specification, substitution args: `$(find pkg)`.
"""

from checker.base.words import Suggestions
from checker.launch.ros2.package_launch import is_ros2_only
from checker.package.dependencies import uses_of
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.references import PROVIDED
from checker.package.released import distributions_with
from checker.package.submissions import is_slip_for
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH019", "launch-finds-unknown-package", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, paperwork: Paperwork) -> Findings:
    """Report `$(find …)` of packages that are one word or letter away from an available one."""
    manifest = paperwork.manifest
    if manifest is None or is_ros2_only(package):
        return
    others = package.workspace.packages.values()
    names = Suggestions(it.declared_name for it in (package, *others))
    for use in uses_of(package):
        name = use.package_name
        found = package.named(name) is not None or name in PROVIDED
        known = found or distributions_with(name) or manifest.depends_on(name)
        near = None if known or not use.how.startswith("$(find") else names.closest(name)
        if near and near != name and is_slip_for(name, near):
            yield finding(
                use.place,
                f"roslaunch stops: there is no package {name!r}; did you mean {near!r}?",
                key=name,
            )


_MANIFEST = """<package format="2">
  <name>acme_arm_gazebo</name>
  <buildtool_depend>catkin</buildtool_depend>
  @
</package>
"""
_OTHER = "../acme_arm_description"
_LAUNCH = """<launch>
<param name="robot_description" textfile="$(find @)/urdf/arm.urdf"/>%
</launch>
"""


def _finds(name: str, mark: str = "", depends: str = "") -> dict[str, object]:
    return {
        "@urdf": True,
        "@name": "acme_arm_gazebo",
        "package.xml": _MANIFEST.replace("@", depends),
        "launch/arm.launch": _LAUNCH.replace("@", name).replace("%", mark),
        f"{_OTHER}/package.xml": "<package><name>acme_arm_description</name></package>",
        f"{_OTHER}/urdf/arm.urdf": '<robot name="arm"><link name="base"/></robot>',
    }


_MARK = "  <!-- ^ LCH019 -->"
GOOD = [
    _finds("acme_arm_description"),
    _finds("acme_arm_gazebo"),
    _finds("acme_hand_description"),
    _finds("acme_arm_description_2", depends="<depend>acme_arm_description_2</depend>"),
]
BAD = [
    _finds("acme_arm_description_2", _MARK),
    _finds("acme_arm_desciption", _MARK),
]
