"""Controllers of ros2_control in a launch: their managers and topics."""

from __future__ import annotations

import shlex
from collections.abc import Iterable, Iterator, Mapping
from functools import cache, cached_property
from itertools import pairwise

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.graph import apply_remaps, resolve_name
from checker.launch.ros2.graph import is_known
from checker.model.controllers import Controller, ControllerFile, controllers_of
from checker.model.ros_parameters import MANAGER
from checker.ros.ros2_control.launched import MANAGER_NODE
from checker.ros.spawned import SpawnedRobot
from checker.ros.wiring.endpoints import Endpoint, remap_rule
from checker.ros.wiring.nodes import WiredNode
from checker.source.text import Span

_REMAPS = ("-r", "--remap")


class _Topics(Record):
    publishes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    subscribes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@cache
def _controller_topics() -> Mapping[str, _Topics]:
    return convert(table("ros_nodes")["controllers"], dict[str, _Topics])


class RunController(Record, eq=False, dict=True):
    """A controller that a controller manager of the launch may run.

    Attributes:
        controller: The controller as parameter files configure it.
        namespace: The namespace of the manager, absolute.
        remaps: The remaps of the process that runs it, then those of its spawner: source and
            target.
        started: Whether a spawner starts it.
        simulated: Whether Gazebo runs it.
    """

    controller: Controller
    namespace: str
    remaps: tuple[tuple[str, str], ...]
    started: bool
    simulated: bool

    def resolve(self, name: str) -> str:
        """Return the absolute topic that it gets for a name; empty if unknown."""
        topic = apply_remaps(name, self.remaps, self.namespace, self.controller.name)
        return topic if is_known(topic) else ""

    @cached_property
    def endpoints(self) -> tuple[Endpoint, ...]:
        """The topics that it may have; none if its type is not known."""
        controller = self.controller
        known = _controller_topics().get(controller.type.value, _Topics())
        return tuple(
            Endpoint(
                topic,
                types,
                publishes,
                controller.label,
                controller.span,
                controller,
                self.started,
            )
            for publishes, topics in ((True, known.publishes), (False, known.subscribes))
            for name, types in topics.items()
            if (topic := self.resolve(name))
        )

    @property
    def is_known(self) -> bool:
        """True if its topics are known."""
        return self.controller.type.value in _controller_topics()


def run_controllers(
    nodes: tuple[WiredNode, ...], spawned: Iterable[SpawnedRobot]
) -> Iterator[RunController]:
    """Yield the controllers of all managers of a launch.

    Args:
        nodes: The nodes that it starts.
        spawned: Robots in Gazebo.
    """
    remaps = dict(_spawners(nodes))
    for robot in spawned:
        control = robot.control
        if control is not None and len(control.managers) == 1 and robot.node.starts:
            manager = control.managers[0]
            own = tuple(remap_rule(text.value) for text in manager.plugin.at("ros/remapping"))
            for controller in control.controllers:
                yield _run(controller, manager.namespace.value, own, remaps, simulated=True)
    for node in nodes:
        if node.node.executable.value == MANAGER_NODE and node.name == MANAGER:
            own = tuple((remap.source, remap.target) for remap in node.node.remaps)
            files = [ControllerFile(file.path, file.blocks) for file in node.files]
            for controller in controllers_of(files):
                yield _run(controller, node.node.namespace, own, remaps, simulated=False)


def manager_names(
    nodes: Iterable[WiredNode], spawned: Iterable[SpawnedRobot]
) -> Iterator[tuple[str, Span]]:
    """Yield the full names of controller managers, each with its place; empty if not known.

    Args:
        nodes: The nodes of a launch.
        spawned: Robots in Gazebo.
    """
    for robot in spawned:
        for manager in robot.control.managers if robot.control is not None else ():
            yield resolve_name(manager.node, manager.namespace.value), manager.span
    for node in nodes:
        if node.node.executable.value == MANAGER_NODE:
            yield node.full_name, node.node.span


def _run(
    controller: Controller,
    namespace: str,
    own: tuple[tuple[str, str], ...],
    spawners: Mapping[str, tuple[tuple[str, str], ...]],
    *,
    simulated: bool,
) -> RunController:
    name = controller.name
    remaps = (*own, *spawners.get(name, ()))
    return RunController(controller, namespace, remaps, name in spawners, simulated)


def _spawners(nodes: tuple[WiredNode, ...]) -> Iterator[tuple[str, tuple[tuple[str, str], ...]]]:
    """Yield the controllers that spawners start, each with the remaps that these give it."""
    for node in nodes:
        spawner = node.spawner
        if spawner is not None:
            given = " ".join(spawner.options.get("--controller-ros-args", ()))
            words = pairwise(shlex.split(given)) if given.count("'") + given.count('"') == 0 else ()
            remaps = tuple(remap_rule(rule) for option, rule in words if option in _REMAPS)
            yield from ((name.value, remaps) for name in spawner.names)
