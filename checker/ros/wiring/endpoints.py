"""Publishers and subscriptions of a launch: whose they are, their topics and types."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from checker.base.record import Record
from checker.launch.ros1.bridge import Direction
from checker.model.components import Plugin
from checker.ros.simulation import Simulation
from checker.ros.wiring.nodes import WiredNode
from checker.source.text import Located, Span


class Endpoint(Record, eq=False):
    """A publisher or a subscription.

    Attributes:
        topic: Absolute, after remaps.
        types: The types of its messages; several where a parameter or the distribution decides, and
            `*` where it may be any.
        publishes: Whether it publishes; else it reads.
        by: The owner, for a message.
        span: What decides its topic, else the start of its owner.
        owner: The node, controller, plugin or entry of a bridge.
        certain: Whether its owner is started with the defaults of all arguments.
        parameter: The parameter that gives it its topic, where the user states it.
    """

    topic: str
    types: tuple[str, ...]
    publishes: bool
    by: str
    span: Span
    owner: object
    certain: bool
    parameter: str = ""


def node_endpoints(node: WiredNode) -> Iterator[Endpoint]:
    """Yield what is known of the topics of a node."""
    by, certain = node.label, node.node.starts is True
    for topic, types in node.published_topics:
        yield Endpoint(topic, types, True, by, node.node.span, node, certain)
    for each in node.read:
        topic = node.resolve(each.topic)
        if topic:
            span = each.setting.span if each.setting is not None else node.node.span
            yield Endpoint(topic, each.types, False, by, span, node, certain, each.parameter)


def passed_endpoints(nodes: Iterable[WiredNode], known: Collection[Endpoint]) -> Iterator[Endpoint]:
    """Yield what nodes publish that pass on the messages of other topics.

    Args:
        nodes: The nodes of a launch.
        known: The endpoints that are known otherwise.
    """
    for node in nodes:
        for topic, source in node.passed_topics:
            given = (each.types for each in known if each.publishes and each.topic == source)
            types = tuple(sorted({it for each in given for it in each})) or ("*",)
            certain = node.node.starts is True
            yield Endpoint(topic, types, True, node.label, node.node.span, node, certain)


def bridge_endpoints(simulation: Simulation) -> Iterator[Endpoint]:
    """Yield what bridges of Gazebo pass in either direction."""
    for entry in simulation.entries:
        types = (entry.passed.ros_type.value,)
        owners = {topic.owner_name for topic in simulation.topics_of(entry)}
        by = f"{owners.pop()} by a bridge" if len(owners) == 1 else "a bridge"
        for publishes, other in ((True, Direction.TO_IGN), (False, Direction.TO_ROS)):
            if entry.ros_topic and entry.direction is not other:
                span = entry.passed.ros_topic.span
                yield Endpoint(entry.ros_topic, types, publishes, by, span, entry, entry.counts)


def remap_texts(plugin: Plugin) -> Iterator[Located[str]]:
    """Yield the remaps of a plugin of Gazebo Classic, in its `<ros>` or beside it.

    gazebo_ros gives `<argument>` to rcl before `--ros-args`, where `a:=b` is a remap as well.
    """
    ros = "ros/" if plugin.element.child("ros") is not None else ""
    yield from (it for it in plugin.at(f"{ros}argument") if ":=" in it.value)
    yield from plugin.at(f"{ros}remapping")


def remap_rule(text: str) -> tuple[str, str]:
    """Return source and target of a remap as command lines and plugins write it: `a:=b`."""
    source, _, target = text.strip().partition(":=")
    return source, target
