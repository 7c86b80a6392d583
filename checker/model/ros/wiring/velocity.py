"""Who publishes velocities in a launch and who reads them, with the types of a distribution."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.expand.launch.bridge import Direction
from checker.expand.launch.graph import resolve_name
from checker.model.ros.wiring.nodes import WiredNode
from checker.model.ros.wiring.wiring import Wiring
from checker.model.ros2_control.controllers import Controller
from checker.model.ros2_control.launched import spawner_of
from checker.model.ros2_control.robot_control import GazeboManager
from checker.source.text import Span

_MESSAGES = "geometry_msgs/msg/"
_TYPES = ("Twist", "TwistStamped")


class Velocity(Record, eq=False):
    """A velocity topic of a node, controller or bridge.

    Attributes:
        topic: Absolute.
        message: `Twist` or `TwistStamped`.
        publishes: Whether it publishes; else it reads.
        by: Whose it is, for a message.
        span: Where it is started, or what decides its type.
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
        """Return topic and type for the values of parameters; None when they are not known."""
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
        wiring: Of the launch.
        distribution: Of ROS 2.
    """
    entries = [
        (entry, entry.by[distribution])
        for entry in convert(table("ros_nodes")["velocity"], tuple[_Entry, ...])
        if distribution in entry.by
    ]
    for entry, choice in entries:
        for node in wiring.nodes:
            program = f"{node.node.package.value}/{node.node.executable.value}"
            if program == entry.program and node.knows_parameters:
                yield from _of_node(node, choice, entry.publishes)
    for controller, manager in _controllers(wiring):
        for entry, choice in entries:
            if controller.type.value == entry.program:
                yield from _of_controller(controller, manager, choice)
    yield from _bridged(wiring)


def _of_node(node: WiredNode, choice: _Choice, publishes: bool) -> Iterator[Velocity]:
    setting = node.settings.get(choice.param)
    usual = str(choice.default).lower()
    side = choice.side(lambda _: usual if setting is None else setting.text)
    name = node.filled(side.topic) if side is not None else None
    topic = node.resolve(name) if name else ""
    if side is not None and topic:
        span = node.node.span if setting is None else setting.span
        yield Velocity(topic, side.type, publishes, node.called, span, choice.param)


def _controllers(wiring: Wiring) -> Iterator[tuple[Controller, GazeboManager]]:
    """Yield the controllers that are spawned in Gazebo, each with its manager."""
    started = {
        name.value
        for node in wiring.nodes
        if (spawner := spawner_of(node.node)) is not None
        and "--controller-ros-args" not in spawner.options
        for name in spawner.names
    }
    for spawned in wiring.simulation.robots if wiring.simulation is not None else ():
        control = spawned.control
        if control is not None and len(control.managers) == 1 and spawned.node.starts:
            for controller in control.controllers:
                if controller.name in started:
                    yield controller, control.managers[0]


def _of_controller(
    controller: Controller, manager: GazeboManager, choice: _Choice
) -> Iterator[Velocity]:
    value = str(controller.flag(choice.param, default=choice.default)).lower()
    side = choice.side(lambda _: value)
    if side is None:
        return
    space, name = manager.namespace.value, controller.name
    topic = resolve_name(side.topic.replace("~/", "~", 1), space, name)
    for text in manager.plugin.at("ros/remapping"):
        source, _, target = text.value.strip().partition(":=")
        if resolve_name(source.replace("~/", "~", 1), space, name) == topic:
            topic = resolve_name(target, space, name)
            break
    yield Velocity(topic, side.type, False, controller.called, controller.span, choice.param)


def _bridged(wiring: Wiring) -> Iterator[Velocity]:
    """Yield what bridges pass to Gazebo."""
    for entry in wiring.simulation.entries if wiring.simulation is not None else ():
        message = entry.passed.ros_type.value.removeprefix(_MESSAGES)
        if entry.counts and entry.direction is not Direction.TO_ROS and message in _TYPES:
            span = entry.passed.ros_type.span
            if entry.ros_topic:
                yield Velocity(entry.ros_topic, message, False, "a bridge to Gazebo", span)
