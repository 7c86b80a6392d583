"""Topics of a robot in Gazebo, and the bridges to ROS that they need.

The table `gazebo_topics` has the facts; a `Channel` is one topic of one sensor or plugin.
"""

from __future__ import annotations

import enum
import posixpath
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.bridge import Bridge, Direction
from checker.model.components import Plugin, Sensor
from checker.model.robot import Robot

_PARAMETER = re.compile(r"\{(\w+)\}")


class Need(enum.StrEnum):
    """Importance of a channel for ROS."""

    REQUIRED = "required"
    WANTED = "wanted"
    OPTIONAL = "optional"


class Channel(Record, eq=False):
    """A topic of a sensor or plugin.

    Attributes:
        what: What it carries: `camera_info`.
        owner: The sensor or plugin.
        topics: Its spellings, made comparable by `comparable`.
        ros_types: Message types on ROS's side; empty if no bridge knows any.
        ign_types: Message types on Gazebo's side.
        direction: The direction of its messages.
        need: What it means when nothing bridges it.
        group: Channels of one owner and one group replace each other.
        ros_name: Regular expression for its name in ROS, below the robot's namespace; empty where
            any name will do.
        ros_example: A name that fits.
    """

    what: str
    owner: Sensor | Plugin
    topics: tuple[str, ...]
    ros_types: tuple[str, ...]
    ign_types: tuple[str, ...]
    direction: Direction
    need: Need
    group: str
    ros_name: str
    ros_example: str

    @property
    def owner_name(self) -> str:
        """Name of the owner in a message: `camera 'front' of link 'base_link'`, `DiffDrive`."""
        if isinstance(self.owner, Plugin):
            return self.owner.class_name
        sensor = self.owner
        return f"{sensor.type.value} {sensor.name.value!r} of link {sensor.link!r}"


def comparable(topic: str) -> str:
    """Return a topic so that spellings of the same one are equal, whichever the robot's name.

    `*` represents the names of world and model; a leading slash means nothing to Gazebo.
    """
    parts = [part for part in topic.split("/") if part]
    for start, word in ((0, "world"), (0, "model"), (2, "model")):
        if len(parts) > start + 1 and parts[start] == word and (not start or parts[0] == "world"):
            parts[start + 1] = "*"
    return "/" + "/".join(parts)


def by_topic(bridges: Iterable[Bridge]) -> Mapping[str, Sequence[Bridge]]:
    """Return bridges by what they bridge, made comparable."""
    bridges_by_topic: dict[str, list[Bridge]] = defaultdict(list)
    for bridge in bridges:
        bridges_by_topic[comparable(bridge.ign_topic)].append(bridge)
    return bridges_by_topic


def channels(robot: Robot, release: str) -> tuple[Channel, ...]:
    """Return the channels of all sensors and plugins of which the table knows any.

    Args:
        robot: The robot of the topics.
        release: The release of Gazebo that simulates it.
    """
    of_sensors = (
        channel for sensor in robot.sensors for channel in sensor_channels(sensor, release)
    )
    of_plugins = (channel for plugin in robot.plugins for channel in plugin_channels(plugin))
    return (*of_sensors, *of_plugins)


def sensor_channels(sensor: Sensor, release: str) -> Iterator[Channel]:
    """Yield what a sensor publishes in a release of Gazebo."""
    for entry in table("gazebo_topics")["sensors"].get(sensor.kind.value, ()):
        if sensor.topic.stated and sensor.topic.value.strip("/ "):
            topic = "/" + sensor.topic.value.strip("/ ")
            parent = posixpath.dirname(topic).rstrip("/")
            stated = entry["stated"].replace("{parent}", parent).replace("{topic}", topic)
            topics = [stated]
        else:
            prefix = _prefix(sensor)
            below = entry.get("releases", {}).get(release, entry["topics"])
            topics = [posixpath.normpath(f"{prefix}/{suffix}") for suffix in below]
        yield _channel(entry, sensor, topics)


def _prefix(sensor: Sensor) -> str:
    *models, link = sensor.link.split("::")
    nested = "".join(f"/model/{model}" for model in models)
    return f"/world/*/model/*{nested}/link/{link}/sensor/{sensor.name.value}"


def plugin_channels(plugin: Plugin) -> Iterator[Channel]:
    """Yield what a plugin publishes and listens to; what depends on unstated names is left out."""
    for entry in table("gazebo_topics")["plugins"].get(plugin.class_name, ()):
        topic = _plugin_topic(plugin, entry)
        if topic:
            yield _channel(entry, plugin, [topic])


def _plugin_topic(plugin: Plugin, entry: Mapping[str, Any]) -> str:
    stated = _stated(plugin, entry["parameter"]) if "parameter" in entry else ""
    topic = stated or entry["topic"]
    if "namespace" in entry:
        namespace = _stated(plugin, entry["namespace"])
        return f"{namespace}/{topic}" if namespace else ""
    names = _PARAMETER.findall(topic) if not stated else []
    for name in names:
        value = _stated(plugin, name)
        if not value:
            return ""
        topic = topic.replace(f"{{{name}}}", value)
    return topic


def _stated(plugin: Plugin, parameter: str) -> str:
    return next((text.value.strip() for text in plugin.at(parameter)), "")


def _channel(entry: Mapping[str, Any], owner: Sensor | Plugin, topics: Iterable[str]) -> Channel:
    return Channel(
        entry["what"],
        owner,
        tuple(comparable(topic) for topic in topics),
        tuple(entry["ros"]),
        tuple(entry["ign"]),
        Direction(entry.get("direction", "to_ros")),
        Need(entry["need"]),
        entry.get("group", entry["what"]),
        entry.get("ros_name", ""),
        entry.get("ros_example", ""),
    )


def standard_topics() -> tuple[str, ...]:
    """Return what each robot of the challenge publishes, whatever its plugins are."""
    return tuple(table("gazebo_topics")["standard"])
