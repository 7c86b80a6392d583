"""Simulator that an argument of a xacro file selects."""

from __future__ import annotations

import re

from checker.model.plugin_library import classic_plugin
from checker.model.robot import Robot
from checker.package.package import Package
from checker.source.text import SourceText

_LATER = re.compile(r"(?:gz-sim|ignition-gazebo)\d*-[\w-]+-system|\b(?:gz|ign)_ros2_control\b")
"""Libraries of Gazebo since it was called Ignition, as plugins and descriptions name them."""


def classic_by_default(robot: Robot, package: Package) -> str:
    """Return why the robot is for Gazebo Classic alone, as a clause; empty if it is not.

    A xacro may serve both simulators: an argument chooses whose plugins it contains. With the
    defaults of the arguments it can be for Classic, and be right for both.
    """
    names = [plugin.filename.value for plugin in robot.all_plugins]
    if robot.conventions.read_by_gazebo or all(classic_plugin(name) is None for name in names):
        return ""
    if any(_LATER.search(name) for name in names):
        return ""
    sources = (package.read(file.path) for file in package.index.with_suffix(".xacro"))
    texts = (source.text for source in sources if isinstance(source, SourceText))
    if any(_LATER.search(text) for text in texts):
        return "an argument of its xacro chooses the simulator, by default Gazebo Classic"
    return ""
