"""Topics of the plugins of Gazebo Classic that a robot loads."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

from msgspec import convert

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.graph import apply_remaps
from checker.model.components import Plugin, Sensor
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.ros.wiring.endpoints import Endpoint, remap_rule, remap_texts

_DEFAULT_OUTPUT = "sensor_msgs/PointCloud2"
_TRUE = ("1", "true")


class _Topic(Record):
    topic: str
    type: str
    publishes: bool = True
    when: str = ""
    default: bool = False
    sensors: tuple[str, ...] = ()


@cache
def _topics() -> Mapping[str, tuple[_Topic, ...]]:
    return convert(table("gazebo_classic_ros2")["topics"], dict[str, tuple[_Topic, ...]])


def classic_endpoints(robot: Robot) -> Iterator[Endpoint]:
    """Yield the topics of a robot's plugins in Gazebo Classic, as their parameters decide."""
    sensors = {id(plugin): sensor for sensor in robot.sensors for plugin in sensor.plugins}
    for plugin in robot.all_plugins:
        sensor = sensors.get(id(plugin))
        for topic in _topics().get(library_stem(plugin.filename.value), ()):
            fits = not topic.sensors or (sensor is not None and sensor.type.value in topic.sensors)
            if fits and _is_on(plugin, topic):
                yield _endpoint(plugin, sensor, topic)


def unsent_topics(plugin: Plugin) -> Iterator[Endpoint]:
    """Yield the topics that a plugin does not publish, as it states no parameter that wants them.

    Args:
        plugin: A plugin that is in no sensor.
    """
    for topic in _topics().get(library_stem(plugin.filename.value), ()):
        is_stated = bool(topic.when) and plugin.element.child(topic.when) is not None
        if topic.publishes and not is_stated and not _is_on(plugin, topic):
            yield _endpoint(plugin, None, topic)


def unknown_plugin(robot: Robot) -> str:
    """Return which plugin may have topics that the table does not know; else nothing."""
    known = table("gazebo_classic_ros2")["plugins"]
    stems = (library_stem(plugin.filename.value) for plugin in robot.all_plugins)
    return next((f"what {stem} publishes is not known" for stem in stems if stem not in known), "")


def _is_on(plugin: Plugin, topic: _Topic) -> bool:
    stated = next((text.value for text in plugin.at(topic.when)), "") if topic.when else ""
    return not topic.when or (stated.strip().lower() in _TRUE if stated else topic.default)


def _endpoint(plugin: Plugin, sensor: Sensor | None, topic: _Topic) -> Endpoint:
    ros = "ros/" if plugin.element.child("ros") is not None else ""
    namespace = next((text.value.strip() for text in plugin.at(f"{ros}namespace")), "/")
    camera = next((text.value.strip() for text in plugin.at("camera_name")), "")
    name = topic.topic.replace(
        "{camera_name}", camera or (sensor.name.value if sensor is not None else "")
    )
    rules = (remap_rule(text.value) for text in remap_texts(plugin))
    resolved = apply_remaps(name, rules, f"/{namespace.strip('/')}", plugin.name.value)
    output = next((text.value.strip() for text in plugin.at("output_type")), _DEFAULT_OUTPUT)
    kind = topic.type.replace("{output_type}", output.replace("/msg/", "/").replace("/", "/msg/"))
    by = f"plugin {plugin.filename.value}"
    return Endpoint(resolved, (kind,), topic.publishes, by, plugin.span, plugin, True)
