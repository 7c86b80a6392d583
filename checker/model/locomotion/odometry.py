"""Odometry that drive plugins of Gazebo Classic publish as a transform, in ROS 1."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.source.text import Located

_SWITCHES = {"gazebo_ros_diff_drive": "publishOdomTF", "gazebo_ros_planar_move": ""}
"""Plugins that publish it, with what switches that off."""


class Odometry(Record, eq=False):
    """Frames of a transform.

    Attributes:
        parent: The odometry frame, without a slash in front.
        child: The frame that it places, as it is written; the default at the plugin.
    """

    parent: str
    child: Located[str]


def classic_odometry(plugin: Plugin) -> Odometry | None:
    """Return the frames of the odometry of a plugin; None if it publishes none."""
    switch = _SWITCHES.get(library_stem(plugin.filename.value))
    stated = next((text.value for text in plugin.at(switch)), "true") if switch else "true"
    if switch is None or stated.strip().lower() not in ("1", "true"):
        return None
    parent = next((text.value for text in plugin.at("odometryFrame")), "odom")
    usual = Located("base_footprint", plugin.span, stated=False)
    child = next(plugin.at("robotBaseFrame"), usual)
    return Odometry(parent.strip().removeprefix("/"), child)
