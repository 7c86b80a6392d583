"""Facts about the nodes that are launched most: the table `ros_nodes`."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros2.graph import Node, NodeKind

TransformFact = tuple[str, str, Mapping[str, str]]
"""Parent, child, and the values that parameters must have; `{x}` is the value of parameter x."""


class NodeFacts(Record):
    """The interface of a program.

    Attributes:
        name: The name of its node where the launch file sets none; empty if none is fixed.
        publishes: Topics that it may publish, each with its types.
        publishes_more: Types of topics that are only known when it runs; `*` for any.
        passes: Topics that get the messages of others, whatever their types; where both names are
            known, it publishes nothing else.
        subscribes: Topics that it may read, each with its types.
        transforms: The transforms that it publishes whose frames are parameters.
        defaults: The defaults of the parameters for topics and transforms.
        offers: Its own services and actions.
        waits_for: Services and actions of others that it cannot do without; `{x}` is each item of
            parameter x.
        unless: Parameters with which it may wait for others.
        lifecycle_from: The first distribution in which it is a lifecycle node, if it was none
            before.
    """

    name: str = ""
    publishes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    publishes_more: tuple[str, ...] = ()
    passes: Mapping[str, str] = field(default_factory=dict)
    subscribes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    transforms: tuple[TransformFact, ...] = ()
    defaults: Mapping[str, str] = field(default_factory=dict)
    offers: tuple[str, ...] = ()
    waits_for: tuple[str, ...] = ()
    unless: tuple[str, ...] = ()
    lifecycle_from: str = ""


@cache
def node_facts() -> Mapping[str, NodeFacts]:
    """Return the known programs by package and executable: `nav2_amcl/amcl`."""
    return convert(table("ros_nodes")["nodes"], dict[str, NodeFacts])


def program_of(node: Node) -> str:
    """Return package and executable of a node; a component has those of the same node."""
    executable = node.executable.value
    if node.kind is NodeKind.COMPONENT:
        executable = table("ros_nodes")["components"].get(executable, executable)
    return f"{node.package.value}/{executable}"
