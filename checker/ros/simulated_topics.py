"""Topics in Gazebo of a robot's sensors and systems, with the messages that they carry.

The table `simulated_topics` has the facts, for Gazebo Fortress and later.
"""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Sequence
from itertools import product
from typing import Any

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.bridge import Direction
from checker.model.components import Plugin, Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType
from checker.ros.topics import comparable

_PARAMETER = re.compile(r"\{([\w/]+)(?::(\w+))?\}")
_CHOICES = 30
"""Topics that one line of the table may represent: a plugin may name many joints."""


class SimulatedTopic(Record, eq=False):
    """A topic of a sensor or a system.

    Attributes:
        topic: Absolute; `*` represents the names of world and model where it is a default.
        messages: Gazebo's messages that it may carry, without their package.
        direction: The direction of messages through a bridge.
        owner: The sensor or plugin.
    """

    topic: str
    messages: tuple[str, ...]
    direction: Direction
    owner: Sensor | Plugin

    @property
    def key(self) -> str:
        """The topic made comparable by `comparable`."""
        return comparable(self.topic)

    @property
    def owner_name(self) -> str:
        """Name of the owner in a message."""
        if isinstance(self.owner, Plugin):
            return f"plugin {self.owner.class_name}"
        return f"{self.owner.type.value} sensor {self.owner.name.value!r}"


def simulated_topics(robot: Robot) -> Iterator[SimulatedTopic]:
    """Yield the topics of a robot's sensors and plugins, those that the table knows."""
    lumped = _lumped_into(robot)
    for sensor in robot.sensors:
        yield from _of_sensor(sensor, lumped.get(sensor.link, (sensor.link,)))
    for plugin in robot.plugins:
        if not plugin.nested_in:
            yield from _of_plugin(plugin)


def likely_topics(robot: Robot) -> Iterator[SimulatedTopic]:
    """Yield these topics; of two spellings of a default, the one for what carries the sensor."""
    for topic in simulated_topics(robot):
        owner = topic.owner
        if isinstance(owner, Sensor) and not owner.topic.stated:
            unlike = "/joint/" if owner.link in robot.links_by_name else "/link/"
            if unlike in topic.topic:
                continue
        yield topic


def topics_of_sensors(robot: Robot) -> dict[int, tuple[str, ...]]:
    """Return the topics of each sensor, by its `id`: as stated, else the defaults."""
    topics: dict[int, list[str]] = {id(sensor): [] for sensor in robot.sensors}
    for topic in likely_topics(robot):
        if isinstance(topic.owner, Sensor):
            topics[id(topic.owner)].append(topic.topic)
    for sensor in robot.sensors:
        if sensor.topic.stated and not topics[id(sensor)]:
            topics[id(sensor)].append(sensor.topic.value)
    return {key: tuple(dict.fromkeys(names)) for key, names in topics.items()}


def unknown_owner(robot: Robot) -> str:
    """Return which part of a robot may have topics that the table does not know; else nothing."""
    known = table("simulated_topics")
    for sensor in robot.sensors:
        if not all(map(is_silent, sensor.plugins)) or _kind(sensor) not in known["sensors"]:
            return f"topics of the {sensor.type.value} sensor {sensor.name.value!r} are not known"
    for plugin in robot.plugins:
        name = plugin.class_name
        if plugin.nested_in or (name not in known["plugins"] and not is_silent(plugin)):
            return f"topics of the plugin {plugin.label} are not known"
    return robot.missing_parts or robot.unread_plugins


def is_silent(plugin: Plugin) -> bool:
    """Return whether a plugin is known to have only topics of sensors and of the world."""
    return plugin.class_name in table("simulated_topics")["silent"]


def _kind(sensor: Sensor) -> str:
    if sensor.kind is not SensorType.OTHER:
        # One of the CPU is never simulated; the rule that reports that covers the missing messages.
        return "gpu_lidar" if sensor.kind is SensorType.CPU_LIDAR else sensor.kind.value
    written = sensor.type.value
    return str(table("simulated_topics")["spellings"].get(written, written))


def _lumped_into(robot: Robot) -> dict[str, tuple[str, ...]]:
    """Return each link with the links that the simulator may merge it into."""
    if not robot.conventions.merges_fixed_links:
        return {}
    parents = {
        joint.child.value: joint.parent.value
        for joint in robot.joints
        if joint.type.value == "fixed"
    }
    chains = {}
    for link in robot.links_by_name:
        chain = [link]
        while (above := parents.get(chain[-1])) is not None and above not in chain:
            chain.append(above)
        chains[link] = tuple(chain)
    return chains


def _of_sensor(sensor: Sensor, links: Sequence[str]) -> Iterator[SimulatedTopic]:
    entry = table("simulated_topics")["sensors"].get(_kind(sensor))
    if entry is None:
        return
    for base in _bases(sensor, links, entry["below"]):
        for suffix, message in entry["topics"]:
            topic = base + suffix
            if suffix and suffix[0] not in "/_":
                topic = _info_topic(sensor) or posixpath.join(posixpath.dirname(base), suffix)
            messages = tuple(message.split())
            yield SimulatedTopic(topic, messages, Direction.TO_ROS, sensor)


def _info_topic(sensor: Sensor) -> str:
    """Return the topic of its camera_info, if the sensor states one."""
    camera = sensor.element.child("camera")
    stated = camera.child("camera_info_topic") if camera is not None else None
    return "/" + stated.text.value.strip(" /") if stated is not None else ""


def _bases(sensor: Sensor, links: Sequence[str], below: str) -> Iterator[str]:
    stated = [sensor.topic.value] if sensor.topic.stated else []
    if (contact := sensor.element.child("contact")) is not None:
        stated += [it.text.value for it in contact.all("topic")]
    named = [topic.strip("/ ") for topic in stated if topic.strip("/ ")]
    if named:
        yield from (f"/{topic}" for topic in named)
        return
    for link in links:
        *models, name = link.split("::")
        nested = "".join(f"/model/{model}" for model in models)
        for part in ("link", "joint"):
            prefix = f"/world/*/model/*{nested}/{part}/{name}/sensor/{sensor.name.value}"
            yield f"{prefix}/{below}".rstrip("/")


def _of_plugin(plugin: Plugin) -> Iterator[SimulatedTopic]:
    for default, parameter, messages, direction in table("simulated_topics")["plugins"].get(
        plugin.class_name, ()
    ):
        stated = [text.value.strip() for text in plugin.at(parameter)] if parameter else []
        for topic in [it for it in stated if it] or _filled(plugin, default):
            carried = _messages(plugin, messages)
            way = Direction(direction)
            yield SimulatedTopic("/" + topic.strip("/"), carried, way, plugin)


def _filled(plugin: Plugin, default: str) -> Iterator[str]:
    """Yield a default topic with what the plugin states; nothing if it does not state it."""
    values: dict[str, list[str]] = {}
    for match in _PARAMETER.finditer(default):
        stated = [text.value.strip().strip("/") for text in plugin.at(match[1])]
        values[match[0]] = stated or ([match[2]] if match[2] else [])
    for _, choice in zip(range(_CHOICES), product(*values.values()), strict=False):
        topic = default
        for mark, value in zip(values, choice, strict=True):
            topic = topic.replace(mark, value)
        yield topic


def _messages(plugin: Plugin, messages: Sequence[Any]) -> tuple[str, ...]:
    """Return the messages; PosePublisher states which of two it publishes."""
    if list(messages) != ["Pose", "Pose_V"]:
        return tuple(messages)
    stated = next((text.value.lower() for text in plugin.at("use_pose_vector_msg")), "false")
    return ("Pose_V",) if stated in ("1", "true") else ("Pose",)
