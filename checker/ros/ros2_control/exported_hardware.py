"""Hardware classes that packages of the workspace describe for pluginlib."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.package.package import Package
from checker.source.xml import XmlDocument

_OWNER = re.compile("/|::")
_GAZEBO = re.compile(r"(?:gz|ign|gazebo)_ros2_control::")
_ROOTS = ("library", "class_libraries")


def owner_of(plugin: str) -> str:
    """Return the package that a class is named after."""
    return _OWNER.split(plugin)[0]


def exported_hardware(package: Package) -> Iterator[tuple[str, bool]]:
    """Yield the names of hardware classes, each with whether Gazebo's plugin loads it."""
    for file in package.index.with_suffix(".xml"):
        document = package.xml(file.path)
        if isinstance(document, XmlDocument) and document.root.tag in _ROOTS:
            for found in document.root.descendants("class"):
                base = found.get("base_class_type") or ""
                of_gazebo = _GAZEBO.match(base) is not None
                if of_gazebo or base.startswith("hardware_interface::"):
                    yield found.get("name") or found.get("type") or "", of_gazebo


def is_exported_for_gazebo(plugin: str, package: Package) -> bool:
    """Return whether a package of the workspace describes a class as one that Gazebo loads."""
    owner = package.workspace.package(owner_of(plugin))
    return owner is not None and (plugin, True) in exported_hardware(owner)
