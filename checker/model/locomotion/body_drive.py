"""Plugins that set the velocity of the whole robot, beside a drive that turns its wheels."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.locomotion.drive import body_velocity
from checker.model.locomotion.locomotion import WheelDrive
from checker.model.robot import Robot

_TOPICS = ("topic", "commandTopic", "topicName")
"""What names the topic of commands, in Gazebo Sim and in the plugins of ROS 1."""
_NAMESPACES = ("ros/namespace", "robotNamespace")
_USUAL = "cmd_vel"


class BodyDrive(Record, eq=False):
    """A plugin that moves the body on the commands that a drive has, too.

    Attributes:
        plugin: The plugin.
        name: What it is called.
        drive: The drive of wheels.
        topic: Their topic.
    """

    plugin: Plugin
    name: str
    drive: WheelDrive
    topic: str


def body_drives(robot: Robot) -> Iterator[BodyDrive]:
    """Yield the plugins that move a robot as a whole on the topic of a plugin for its wheels."""
    drives = [it for it in robot.locomotion.wheel_drives if isinstance(it.plugin, Plugin)]
    for plugin in robot.all_plugins if drives else ():
        name = body_velocity(plugin)
        for drive in drives if name else ():
            topic = _topic(plugin)
            if isinstance(drive.plugin, Plugin) and _topic(drive.plugin) == topic:
                yield BodyDrive(plugin, name, drive, topic)
                break


def _topic(plugin: Plugin) -> str:
    """Return the topic of the commands of a plugin, without a slash in front."""
    stated = next((text.value for tag in _TOPICS for text in plugin.at(tag)), "").strip()
    for text in () if stated else plugin.at("ros/remapping"):
        source, _, target = text.value.strip().partition(":=")
        stated = target if source == _USUAL else stated
    if stated.startswith("/"):
        return stated.strip("/")
    namespace = next((text.value for tag in _NAMESPACES for text in plugin.at(tag)), "")
    return f"{namespace.strip().strip('/')}/{stated or _USUAL}".strip("/")
