"""The topics that a node reads: its own, and those of parameters."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.launch.ros2.graph import NodeKind
from checker.ros.wiring.parameters import Setting, settings_of

if TYPE_CHECKING:
    from checker.ros.wiring.nodes import WiredNode

_WHOLE = re.compile(r"\{([\w.]+)(#?)\}")
_COSTMAPS = {
    "nav2_controller/controller_server": "local_costmap",
    "nav2_planner/planner_server": "global_costmap",
}
"""Programs of Nav2 that make a separate node for a costmap, in a namespace of its name.

That of a component gets its parameters from the container.
"""
_MONITORS = (
    "nav2_collision_monitor/collision_monitor",
    "nav2_collision_monitor/collision_detector",
)
_SENSOR = "sensor_msgs/msg/"
_DATA_TYPES = {
    "LaserScan": "LaserScan",
    "PointCloud2": "PointCloud2",
    "scan": "LaserScan",
    "pointcloud": "PointCloud2",
    "range": "Range",
}
"""Values of `data_type` of a costmap and of `type` of the collision monitor."""


class Input(Record, eq=False):
    """A topic that a node reads.

    Attributes:
        topic: The topic as the node names it.
        types: The types of the messages.
        parameter: The parameter that names it; empty for its own topic, or the default of a
            parameter.
        setting: The setting of that parameter.
    """

    topic: str
    types: tuple[str, ...]
    parameter: str = ""
    setting: Setting | None = None


def inputs(node: WiredNode) -> Iterator[Input]:
    """Yield the topics that a node reads, those that are known."""
    for topic, types in node.facts.subscribes.items() if node.facts is not None else ():
        whole = _WHOLE.fullmatch(topic)
        if whole is None or (not whole[2] and whole[1] not in node.settings):
            name = node.fill_in(topic) if whole is None or not whole[2] else None
            yield from (Input(name, types),) if name else ()
            continue
        wanted = re.compile(re.escape(whole[1]) + (r"\d+" if whole[2] else ""))
        for name, setting in node.settings.items():
            if wanted.fullmatch(name) and setting.text:
                yield Input(setting.text, types, name, setting)
    if node.program in _MONITORS:
        yield from _sources("", node.settings, "type")
    yield from _of_costmap(node)


def costmap_of(node: WiredNode) -> tuple[str, Mapping[str, Setting]]:
    """Return the name and the parameters of the costmap that a node of Nav2 makes; else nothing."""
    name = _COSTMAPS.get(node.program, "")
    if not name or not node.full_name or node.node.kind is NodeKind.COMPONENT:
        return "", {}
    above = node.node.namespace.rstrip("/")
    return name, settings_of(node.node, node.files, name, f"{above}/{name}")


def _of_costmap(node: WiredNode) -> Iterator[Input]:
    """Yield absolute topics alone: what others are relative to, distributions differ in."""
    _, settings = costmap_of(node)
    layers = settings.get("plugins")
    for layer in layers.value if layers is not None and isinstance(layers.value, list) else ():
        enabled = settings.get(f"{layer}.enabled")
        if enabled is None or enabled.text != "false":
            for each in _sources(f"{layer}.", settings, "data_type"):
                if each.topic.startswith("/"):
                    yield each


def _sources(above: str, settings: Mapping[str, Setting], kind: str) -> Iterator[Input]:
    """Yield the topics of observation sources, whose names another parameter lists."""
    listed = settings.get(f"{above}observation_sources")
    value = listed.value if listed is not None else ""
    for source in value.split() if isinstance(value, str) else _texts(value):
        name = f"{above}{source}.topic"
        stated = settings.get(f"{above}{source}.{kind}")
        message = _DATA_TYPES.get(str(stated.value) if stated is not None else "LaserScan")
        if name in settings and message and (topic := settings[name].text):
            yield Input(topic, (_SENSOR + message,), name, settings[name])


def _texts(value: object) -> Iterator[str]:
    yield from (str(each) for each in value) if isinstance(value, list) else ()
