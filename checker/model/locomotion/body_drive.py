"""Plugins that set the velocity of the whole robot, beside a drive that turns its wheels."""

from __future__ import annotations

from collections.abc import Iterator

from checker.base.record import Record
from checker.model.components import Plugin
from checker.model.locomotion.drive import body_velocity
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
        wheels: The plugin that turns wheels.
        topic: Their topic.
    """

    plugin: Plugin
    name: str
    wheels: Plugin
    topic: str


def body_drives(robot: Robot) -> Iterator[BodyDrive]:
    """Yield the plugins that move a robot as a whole on the topic of a plugin for its wheels."""
    drives = [it.plugin for it in robot.locomotion.wheel_drives]
    wheels = {_topic(it): it for it in reversed(drives) if isinstance(it, Plugin)}
    for plugin in robot.all_plugins if wheels else ():
        name, topic = body_velocity(plugin), _topic(plugin)
        if name and topic in wheels:
            yield BodyDrive(plugin, name, wheels[topic], topic)


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
