"""The SDF file beside a URDF robot that describes it with its drive; URDF is then for display."""

from __future__ import annotations

import posixpath

from checker.formats.sdf.links import read_plugin
from checker.model.locomotion.drive import driven_joints
from checker.model.robot import Robot
from checker.package.package import Package
from checker.source.xml import XmlDocument

_MODEL = "model.sdf"
_SUFFIXES = (".sdf", ".sdf.xacro", ".sdf.erb")
MAX_FILES = 50
"""SDF files of a package that are read for this."""


def driving_file(package: Package, robot: Robot) -> str:
    """Return the file in which a plugin moves joints of a robot's namesake; empty without one.

    Files with xacro are not expanded: plugins stand in them as they are.
    """
    paths = [entry.path for entry in package.index.with_suffix(*_SUFFIXES)[:MAX_FILES]]
    # Beside a model may lie older versions of it.
    for path in sorted(paths, key=lambda path: posixpath.basename(path) != _MODEL):
        document = package.xml(path)
        if isinstance(document, XmlDocument) and _drives(document, robot):
            return path
    return ""


def _drives(document: XmlDocument, robot: Robot) -> bool:
    plugins = [
        read_plugin(element)
        for model in document.root.all("model")
        if model.get("name") == robot.name.value
        for element in model.all("plugin")
    ]
    return bool(driven_joints(plugins, robot.joints))
