"""Bridges that a launch file lacks, written like those that it has."""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterable, Sequence

from checker.finding import Fix, Safety
from checker.launch.ros1.bridge import MARKS, Bridge, BridgeKind
from checker.launch.ros1.graph import LaunchGraph, Node, resolve_name
from checker.model.components import Plugin, Sensor
from checker.ros.topics import Channel, by_topic, comparable
from checker.source.xml import Element
from checker.source.xml_insertion import insert_behind

_PLACE = "front"
"""The place of the sensor in examples of names."""
_IMAGE = "ignition.msgs.Image"


def bridging(launch: LaunchGraph, wanted: Sequence[Channel]) -> Fix | None:
    """Return the fix that adds bridges of channels behind the most similar one that is there.

    None if the launch file has no bridge to write them like, if a channel has several types, or if
    a bridge is there that is switched off or names a wrong link.
    """
    own = _own_bridges(launch)
    if not own or not wanted or any(len(channel.ign_types) != 1 for channel in wanted):
        return None
    topic = wanted[0].topics[0]
    is_off = topic in by_topic(launch.dormant_bridges)
    if is_off or any(_names(bridge, wanted[0].owner) for bridge in own):
        return None
    usual = Counter(bridge.node.namespace for bridge in own).most_common(1)[0][0]
    beside = posixpath.dirname(topic)
    near = [
        bridge
        for bridge in reversed(own)
        if bridge.node.namespace == usual or comparable(bridge.ign_topic).startswith(f"{beside}/")
    ]
    nearest = max(near, key=lambda bridge: _common(comparable(bridge.ign_topic), topic))
    file = [bridge for bridge in own if bridge.node.file == nearest.node.file]
    nodes = [_node(channel, nearest, file, launch) for channel in wanted]
    element = nearest.node.span.holder
    if not all(nodes) or not isinstance(element, Element):
        return None
    return Fix(Safety.UNSAFE, (insert_behind(element, [line for node in nodes for line in node]),))


def _own_bridges(launch: LaunchGraph) -> list[Bridge]:
    """Return the bridges of the package's own files that are started once, and always."""
    places = Counter((bridge.span.source.file, bridge.span.start) for bridge in launch.bridges)
    return [
        bridge
        for bridge in launch.bridges
        if not bridge.node.assumed_from
        and not bridge.node.file.startswith("../")
        and places[bridge.span.source.file, bridge.span.start] == 1
        and not _is_conditional(bridge.node.span.holder)
    ]


def _names(bridge: Bridge, owner: Sensor | Plugin) -> bool:
    """Return whether a bridge names a sensor on a wrong link: then it is the one to correct."""
    topic = bridge.sensor
    if topic is None or isinstance(owner, Plugin):
        return False
    return topic.sensor == owner.name.value and topic.link != owner.link


def _is_conditional(element: object) -> bool:
    while isinstance(element, Element):
        if element.get("if") or element.get("unless"):
            return True
        element = element.parent
    return False


def _common(one: str, other: str) -> int:
    return len(posixpath.commonpath((one, other)))


def _node(
    channel: Channel, nearest: Bridge, file: Sequence[Bridge], launch: LaunchGraph
) -> list[str]:
    """Return the lines of a node that bridges a channel; none if its names cannot be written."""
    heads = _heads(file)
    pictures = [bridge for bridge in file if bridge.kind is BridgeKind.IMAGE]
    by_image = channel.ign_types == (_IMAGE,) and bool(pictures)
    alike = pictures if by_image else [bridge for bridge in file if bridge not in pictures]
    model = nearest if nearest in alike else next(iter(alike), nearest)
    head = max((head for head in heads if f"{channel.topics[0]}/".startswith(f"{head}/")), key=len)
    topic = heads[head] + channel.topics[0].removeprefix(head)
    name = _ros_name(channel, nearest, launch)
    robot = heads.get("/model/*", "").removeprefix("/model")
    is_inside = model.node.namespace != "/"
    if name is None or "*" in topic or not alike or not (is_inside or robot):
        return []
    stems = Counter(bridge.node.name.rpartition("_")[0] for bridge in alike)
    stem = stems.most_common(1)[0][0] or "bridge"
    types = f"@{channel.ros_types[0]}{MARKS[channel.direction]}{channel.ign_types[0]}"
    return [
        _start_tag(model.node, f"{stem}_{name.replace('/', '_')}", topic + types * (not by_image)),
        f'  <remap from="{topic}" to="{name if is_inside else f"{robot}/{name}"}"/>',
        "</node>",
    ]


def _start_tag(node: Node, name: str, args: str) -> str:
    """Return the start tag of a node, laid out as it is, with another name and other args."""
    element = node.span.holder
    if not isinstance(element, Element):
        return ""
    text = element.span.text.removesuffix(">").removesuffix("/").rstrip() + ">"
    stated = {args: element.attribute("args"), name: element.attribute("name")}
    spans = [(value.span, new) for new, value in stated.items() if value is not None]
    for span, new in sorted(spans, key=lambda each: -each[0].start):
        start, end = span.start - element.span.start, span.end - element.span.start
        text = text[:start] + new + text[end:]
    return text


def _heads(bridges: Iterable[Bridge]) -> dict[str, str]:
    """Return what the file writes for the starts of topics, such as `$(arg prefix)`."""
    heads = {"": ""}
    for bridge in bridges:
        written, value = bridge.span.text.split("/"), comparable(bridge.ign_topic).split("/")
        while len(written) > 1 and len(value) > 1 and written[-1] == value[-1]:
            del written[-1], value[-1]
        heads.setdefault("/".join(value), "/".join(written))
    return heads


def _ros_name(channel: Channel, nearest: Bridge, launch: LaunchGraph) -> str | None:
    """Return a name below the robot's namespace: beside the sensor's others, and not taken.

    None where a bridge has the name that is not another sensor's: it may be the one to correct.
    """
    owner, usual = channel.owner, channel.ros_example
    if isinstance(owner, Plugin):
        return usual
    place = owner.name.value
    if owner.kind.takes_pictures:
        own, above = f"/sensor/{place}/", f"{nearest.node.namespace.rstrip('/')}/"
        names = (bridge.ros_topic for bridge in launch.bridges if own in bridge.ign_topic)
        inside = (name.removeprefix(above) for name in names if name.startswith(above))
        folder = next((name.partition("/")[0] for name in inside if "/" in name), place)
        return f"{folder}/{posixpath.basename(usual)}"
    name = usual.replace(_PLACE, place)
    full_name = resolve_name(name, nearest.node.namespace)
    takers = [bridge.sensor for bridge in launch.bridges if bridge.ros_topic == full_name]
    if any(taker is None or taker.sensor == place for taker in takers):
        return None
    return f"{place}/{name}" if takers else name
