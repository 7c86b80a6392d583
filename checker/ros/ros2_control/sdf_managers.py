"""SDF models that run the controller manager of a robot, which its URDF file only describes."""

from __future__ import annotations

from collections.abc import Iterator

from checker.formats.sdf.links import read_plugin
from checker.package.package import Package
from checker.ros.ros2_control.robot_control import RobotControl, runs_manager
from checker.source.xml import Element, XmlDocument

_SUFFIXES = (".sdf", ".sdf.xacro", ".sdf.erb")
MAX_FILES = 50
"""SDF files of a package that are read for this."""


def managed_by_sdf(package: Package, control: RobotControl) -> bool:
    """Return whether an SDF model of the workspace has a robot's joints and runs their manager."""
    joints = set(control.joints)
    return any(
        joints <= {joint.get("name") for joint in model.all("joint")}
        and any(runs_manager(read_plugin(element)) for element in model.all("plugin"))
        for model in _models(package)
    )


def _models(package: Package) -> Iterator[Element]:
    others = () if package.only else package.other_packages
    for holder in (package, *others):
        for entry in holder.index.with_suffix(*_SUFFIXES)[:MAX_FILES]:
            document = holder.xml(entry.path)
            if isinstance(document, XmlDocument):
                yield from document.root.all("model")
