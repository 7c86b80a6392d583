"""The wiring of one launch file: all that it starts, and what these are to one another."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cached_property

from checker.base.record import Record
from checker.launch.ros2.graph import (
    LaunchGraph,
    Node,
    Ros2Launch,
    is_known,
)
from checker.model.robot import Robot
from checker.ros.ros2_control.robot_control import ControlReader, runs_manager
from checker.ros.simulated_topics import unknown_owner
from checker.ros.simulation import Simulation, Simulations
from checker.ros.spawned import CLASSIC_SPAWNS, EVERY_SPAWN, SpawnedReader, SpawnedRobot
from checker.ros.unread import unread_parts
from checker.ros.wiring.classic import classic_endpoints, unknown_plugin
from checker.ros.wiring.controllers import RunController, manager_names, run_controllers
from checker.ros.wiring.endpoints import (
    Endpoint,
    bridge_endpoints,
    node_endpoints,
    passed_endpoints,
)
from checker.ros.wiring.frames import joint_transforms, static_transforms
from checker.ros.wiring.nodes import WiredNode, spawned_names, wired_node
from checker.ros.wiring.transforms import Transform, transforms
from checker.source.text import Span


class Wiring(Record, eq=False, dict=True):
    """The wiring of one launch file.

    Attributes:
        graph: The graph of the launch file.
        every_node: Its nodes, those that conditions leave out among them.
        simulation: What it simulates and bridges; None if it has nothing to do with Gazebo.
        described: The nodes that publish the joints of a robot, each with the robot.
        in_classic: Robots that it puts into Gazebo Classic.
    """

    graph: LaunchGraph
    every_node: tuple[WiredNode, ...]
    simulation: Simulation | None
    described: tuple[tuple[WiredNode, Robot], ...] = ()
    in_classic: tuple[Robot, ...] = ()

    @cached_property
    def nodes(self) -> tuple[WiredNode, ...]:
        """The nodes that it starts with the defaults of all arguments."""
        return tuple(node for node in self.every_node if node.node.starts)

    @cached_property
    def controllers(self) -> tuple[RunController, ...]:
        """Controllers of ros2_control that its controller managers may run."""
        return tuple(run_controllers(self.nodes, self.spawned))

    @property
    def spawned(self) -> tuple[SpawnedRobot, ...]:
        """Robots that it puts into Gazebo."""
        simulation = self.simulation
        return (*simulation.robots, *simulation.classic_robots) if simulation is not None else ()

    @cached_property
    def managers(self) -> Mapping[str, Span]:
        """Controller managers that it may run by their full names; none if one is not known."""
        simulation = self.simulation
        found = dict(manager_names(self.every_node, self.spawned))
        worlds = simulation.worlds if simulation is not None else ()
        plugins = (it for world in worlds for model in world.models for it in model.plugins)
        programs = {it.node.program for it in self.every_node}
        unknown = (
            "" in found,
            any(node.facts is None for node in self.every_node),
            bool(self.unread) or self._renamed_in_classic,
            simulation is not None and (simulation.unknown_robots or simulation.unknown_worlds),
            not self.spawned and not programs.isdisjoint(EVERY_SPAWN),
            any(map(runs_manager, plugins)),
        )
        return {} if any(unknown) else found

    @cached_property
    def endpoints(self) -> tuple[Endpoint, ...]:
        """Publishers and subscriptions that it may have, those that are known."""
        found = [each for node in self.every_node for each in node_endpoints(node)]
        found += [each for run in self.controllers for each in run.endpoints]
        for robot in self.in_classic if not self._renamed_in_classic else ():
            found += classic_endpoints(robot)
        found += bridge_endpoints(self.simulation) if self.simulation is not None else ()
        return (*found, *passed_endpoints(self.every_node, found))

    @cached_property
    def transforms(self) -> tuple[Transform, ...]:
        """Transforms that it publishes for certain, those of the robot's joints last."""
        found = [*transforms(self.nodes, self.simulation, self.in_classic, self.controllers)]
        found += [each for node in self.nodes for each in static_transforms(node)]
        found += [each for node, robot in self.described for each in joint_transforms(node, robot)]
        return tuple(found)

    def publishers(self, message: str) -> dict[str, str]:
        """Return the topics on which a type may be published, each with its publishers.

        Args:
            message: The type: `std_msgs/msg/String`.
        """
        return {
            each.topic: each.by
            for each in self.endpoints
            if each.publishes and {message, "*"}.intersection(each.types)
        }

    def more_publishers(self, message: str) -> str:
        """Return why there may be more topics of a type than `publishers` names; else nothing."""
        for node in self.every_node:
            if reason := node.publishes_more(message):
                return reason
        simulation = self.simulation
        unread = simulation.bridges.unread if simulation is not None else ()
        return next(iter((*self.unread, *unread)), "")

    @cached_property
    def unknown_parts(self) -> str:
        """Return which part of a robot in Gazebo may publish what is not known; else nothing."""
        simulation = self.simulation
        known = {run.controller.name for run in self.controllers if run.is_known}
        reasons = [
            f"what controller {name!r} publishes is not known"
            for name in spawned_names(self.nodes)
            if name not in known
        ]
        if simulation is not None:
            reasons += [*simulation.unknown_robots]
            reasons += filter(None, (unknown_owner(it.robot) for it in simulation.robots))
        reasons += filter(None, map(unknown_plugin, self.in_classic))
        if self._renamed_in_classic:
            reasons.append("spawn_entity.py gives the robot a namespace")
        return next(iter(reasons), "")

    @property
    def _renamed_in_classic(self) -> bool:
        """True if the plugins of a robot in Gazebo Classic may get another namespace."""
        spawners = (it.node for it in self.nodes if _spawns_in_classic(it.node))
        words = (word.value for node in spawners for word in node.arguments)
        return any(word == "-robot_namespace" or not is_known(word) for word in words)

    @cached_property
    def unread(self) -> tuple[str, ...]:
        """Reasons why it may start more than its nodes."""
        return tuple(unread_parts(self.graph))

    @property
    def knows_nodes(self) -> bool:
        """True if it starts only nodes whose names are known."""
        return not self.unread and all(node.full_name for node in self.every_node)


class Wirings(Record, eq=False):
    """The wiring of all launch files of a package, which users start side by side."""

    all: tuple[Wiring, ...]

    @property
    def unknown_readers(self) -> str:
        """Why there may be more readers of a topic than its endpoints; else nothing."""
        nodes = [node for each in self.all for node in each.every_node]
        unread = [reason for each in self.all for reason in each.unread]
        unread += [
            f"what {node.program} reads is not known" for node in nodes if not node.knows_inputs
        ]
        unread += filter(None, (each.unknown_parts for each in self.all))
        return next(iter(unread), "")


def wirings(
    launch: Ros2Launch,
    simulations: Simulations | None,
    reader: ControlReader,
    robots: SpawnedReader,
) -> Iterator[Wiring]:
    """Yield the wiring of each launch file that starts a node.

    Args:
        launch: The launch files of a package.
        simulations: What they simulate; None if that is nothing.
        reader: The reader of the parameter files of the package.
        robots: The robots that launch files are given.
    """
    launched = simulations.launched if simulations is not None else ()
    by_graph = {id(simulation.graph): simulation for simulation in launched}
    for graph in launch.entries:
        included = (node for include in graph.includes for node in include.nodes)
        nodes = tuple(wired_node(node, reader) for node in (*graph.nodes_and_spawns, *included))
        if nodes:
            described = tuple(_described(graph, nodes, robots))
            spawns = any(_spawns_in_classic(node) for node in graph.nodes)
            in_classic = tuple(robot for _, robot in described) if spawns else ()
            yield Wiring(graph, nodes, by_graph.get(id(graph)), described, in_classic)


def _described(
    graph: LaunchGraph, nodes: tuple[WiredNode, ...], robots: SpawnedReader
) -> Iterator[tuple[WiredNode, Robot]]:
    published = {id(node): robot for node, robot in robots.published_robots(graph)}
    yield from ((node, published[id(node.node)]) for node in nodes if id(node.node) in published)


def _spawns_in_classic(node: Node) -> bool:
    return node.starts is True and node.program in CLASSIC_SPAWNS
