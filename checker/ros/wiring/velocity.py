"""The publishers and readers of velocities in a launch, with the types of a distribution."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.bridge import Direction
from checker.ros.wiring.controllers import RunController
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.source.text import Span

_MESSAGES = "geometry_msgs/msg/"
_TYPES = ("Twist", "TwistStamped")


class Velocity(Record, eq=False):
    """A velocity topic of a node, controller or bridge.

    Attributes:
        topic: Absolute.
        message: `Twist` or `TwistStamped`.
        publishes: Whether it publishes; else it reads.
        by: The owner, for a message.
        span: The place where it is started, or that decides its type.
        switch: The parameter that decides its type, if any.
    """

    topic: str
    message: str
    publishes: bool
    by: str
    span: Span
    switch: str = ""


class _Side(Record):
    topic: str
    type: str


class _Choice(Record):
    topic: str = ""
    type: str = ""
    param: str = ""
    default: bool = False
    true: _Side | None = None
    false: _Side | None = None

    def side(self, value_of: Callable[[str], str | None]) -> _Side | None:
        """Return topic and type for the values of parameters; None if they are not known."""
        if not self.param:
            return _Side(self.topic, self.type)
        value = value_of(self.param)
        return {"true": self.true, "false": self.false}.get(value or "")


class _Entry(Record):
    program: str
    publishes: bool
    by: Mapping[str, _Choice] = field(default_factory=dict)


def velocities(wiring: Wiring, distribution: str) -> Iterator[Velocity]:
    """Yield the velocity topics of a launch, those that are known for certain.

    Args:
        wiring: The wiring of the launch.
        distribution: The distribution of ROS 2.
    """
    entries = [
        (entry, entry.by[distribution])
        for entry in convert(table("ros_nodes")["velocity"], tuple[_Entry, ...])
        if distribution in entry.by
    ]
    for entry, choice in entries:
        for node in wiring.nodes:
            if node.program == entry.program and node.knows_parameters:
                yield from _of_node(node, choice, entry.publishes)
    for run in wiring.controllers:
        for entry, choice in entries:
            if run.started and run.simulated and run.controller.type.value == entry.program:
                yield from _of_controller(run, choice)
    yield from _bridged(wiring)


def _of_node(node: WiredNode, choice: _Choice, publishes: bool) -> Iterator[Velocity]:
    setting = node.settings.get(choice.param)
    usual = str(choice.default).lower()
    side = choice.side(lambda _: usual if setting is None else setting.text)
    name = node.fill_in(side.topic) if side is not None else None
    topic = node.resolve(name) if name else ""
    if side is not None and topic:
        span = node.node.span if setting is None else setting.span
        yield Velocity(topic, side.type, publishes, node.label, span, choice.param)


def _of_controller(run: RunController, choice: _Choice) -> Iterator[Velocity]:
    value = str(run.controller.flag(choice.param, default=choice.default)).lower()
    side = choice.side(lambda _: value)
    topic = run.resolve(side.topic) if side is not None else ""
    if side is not None and topic:
        by, span = run.controller.label, run.controller.span
        yield Velocity(topic, side.type, False, by, span, choice.param)


def _bridged(wiring: Wiring) -> Iterator[Velocity]:
    """Yield what bridges pass to Gazebo."""
    for entry in wiring.simulation.entries if wiring.simulation is not None else ():
        message = entry.passed.ros_type.value.removeprefix(_MESSAGES)
        if entry.counts and entry.direction is not Direction.TO_ROS and message in _TYPES:
            span = entry.passed.ros_type.span
            if entry.ros_topic:
                yield Velocity(entry.ros_topic, message, False, "a bridge to Gazebo", span)
