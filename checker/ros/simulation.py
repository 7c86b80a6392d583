"""Simulation of a ROS 2 launch file: robots and world in Gazebo, and the bridges to ROS."""

from __future__ import annotations

import re
from functools import cached_property

from checker.base.record import Record
from checker.launch.ros2.bridges.entry import BridgeEntry
from checker.launch.ros2.bridges.reader import Bridges, bridges_without_launch, read_bridges
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch
from checker.model.robot import Robot
from checker.model.world import World, systems_of
from checker.package.package import Package
from checker.ros.servers import (
    GazeboServer,
    includes_classic,
    is_gazebo_include,
    read_servers,
    starts_classic,
)
from checker.ros.simulated_topics import (
    SimulatedTopic,
    is_silent,
    simulated_topics,
    unknown_owner,
)
from checker.ros.spawned import CLASSIC_SPAWNS, SpawnedReader, SpawnedRobot
from checker.ros.topics import comparable
from checker.ros.unread import unread_parts

_OF_WORLD = re.compile(r"/world/([^/]{1,200})/")


class Simulation(Record, eq=False, dict=True):
    """Robots, worlds and bridges of one launch file.

    Attributes:
        graph: The graph of the launch file; None for files of bridges that no launch file names.
        bridges: The topics and services that are passed.
        robots: The robots that it spawns.
        unknown_robots: The reasons why some that it spawns are not among them.
        servers: Each start of Gazebo.
        classic_robots: The robots that it spawns into Gazebo Classic, if it starts that.
    """

    graph: LaunchGraph | None
    bridges: Bridges
    robots: tuple[SpawnedRobot, ...] = ()
    unknown_robots: tuple[str, ...] = ()
    servers: tuple[GazeboServer, ...] = ()
    classic_robots: tuple[SpawnedRobot, ...] = ()

    @property
    def entries(self) -> tuple[BridgeEntry, ...]:
        """The topics that are passed."""
        return self.bridges.entries

    @property
    def worlds(self) -> tuple[World, ...]:
        """The worlds that Gazebo loads."""
        return tuple(world for server in self.servers for world in server.worlds)

    @property
    def unknown_worlds(self) -> tuple[str, ...]:
        """Reasons why the world is not known; empty if no Gazebo is started."""
        return tuple(server.unknown for server in self.servers if server.unknown)

    def given(self, robot: Robot) -> list[Robot]:
        """Return a robot as the launch file gives it to Gazebo, for each time that it does so."""
        file = robot.document.source.file
        spawned = (it.robot for it in (*self.robots, *self.classic_robots))
        return [it for it in spawned if it.document.source.file == file]

    def worlds_of(self, robot: Robot) -> tuple[World | None, ...]:
        """Return the worlds into which it spawns a robot; None for one that is not known."""
        if not self.given(robot):
            return ()
        return (*self.worlds, *([] if self.worlds and not self.unknown_worlds else [None]))

    @property
    def starts_gazebo(self) -> bool:
        """True if it certainly starts Gazebo."""
        return any(server.starts for server in self.servers)

    @property
    def reads_exports(self) -> bool:
        """True if Gazebo gets `<gazebo_ros>` of package.xml: its own launch files pass it."""
        if self.graph is None:
            return False
        own = (include for include in self.graph.includes if is_gazebo_include(include))
        return any(include.starts for include in own) or includes_classic(self.graph)

    @cached_property
    def models(self) -> tuple[Robot, ...]:
        """Robots that are spawned, and the models of the world."""
        of_worlds = (model for world in self.worlds for model in world.models)
        return (*(spawned.robot for spawned in self.robots), *of_worlds)

    @cached_property
    def topics(self) -> dict[str, list[SimulatedTopic]]:
        """Topics of all models, by their comparable name."""
        topics: dict[str, list[SimulatedTopic]] = {}
        for model in self.models:
            for topic in simulated_topics(model):
                topics.setdefault(topic.key, []).append(topic)
        return topics

    @property
    def is_whole(self) -> bool:
        """True if it starts Gazebo, and all that it starts was read."""
        return self.starts_gazebo and not self.unread

    @property
    def model_names(self) -> frozenset[str]:
        """Names of the models in Gazebo; none if one is not known."""
        names = [spawned.name for spawned in self.robots]
        names += [model.name.value for world in self.worlds for model in world.models]
        return frozenset(names) if all(names) else frozenset()

    @property
    def world_names(self) -> frozenset[str]:
        """Names of the worlds; none if one is not known."""
        names = [world.name for world in self.worlds]
        own = (server.own_world for server in self.servers)
        names += [file.removesuffix(".sdf") for file in own if file]
        return frozenset(names) if all(names) and not self.unknown_worlds else frozenset()

    def missing_world(self, name: str) -> str:
        """Return the world of a topic or service that the launch file does not load; else empty.

        Args:
            name: `/world/yard/clock`.
        """
        named = _OF_WORLD.match(f"/{name.strip('/')}")
        if named is None or not self.is_whole or not self.world_names:
            return ""
        return named.group(1) if named.group(1) not in self.world_names else ""

    def topics_of(self, entry: BridgeEntry) -> list[SimulatedTopic]:
        """Return what is behind the topic of a bridge, whatever world and model are called."""
        known = entry.gz_topic and entry.counts
        return self.topics.get(comparable(entry.gz_topic), []) if known else []

    def is_silent(self, entry: BridgeEntry) -> bool:
        """Return whether nothing in Gazebo publishes what a bridge passes, where all is known."""
        is_known = self.is_whole and self.knows_world and not self.unknown_topics
        return bool(is_known and self.robots and not self.topics_of(entry))

    @cached_property
    def unknown_topics(self) -> tuple[str, ...]:
        """Reasons why models may have more topics than those that are known.

        What a world includes may have more, too: see `knows_world`.
        """
        owners = filter(None, map(unknown_owner, self.models))
        return (*self.unknown_robots, *self.unknown_worlds, *owners)

    @property
    def missing_parts(self) -> str:
        """The only reason why models may have more topics: parts not available; else empty."""
        reasons = set(self.unknown_topics)
        is_only = reasons <= {model.missing_parts for model in self.models}
        return self.unknown_topics[0] if reasons and is_only else ""

    @property
    def knows_world(self) -> bool:
        """True if all models of the world are available, and its systems have no own topics."""
        if any(world.unknown for world in self.worlds):
            return False
        plugins = (plugin for world in self.worlds for plugin in world.plugins)
        return all(is_silent(plugin) for plugin in plugins)

    @cached_property
    def spawned_systems(self) -> frozenset[str]:
        """Systems that the robots that it spawns load, with their sensors: `sensors`, `imu`."""
        plugins = (plugin for spawned in self.robots for plugin in spawned.robot.all_plugins)
        return frozenset(name for plugin in plugins for name in systems_of(plugin))

    @cached_property
    def unread(self) -> str:
        """Reason why it may start more than is known; empty if all was read."""
        if self.graph is None:
            return "no launch file names it"
        return next(iter((*self.bridges.unread, *unread_parts(self.graph))), "")


class Simulations(Record, eq=False):
    """Simulations of the launch files of a package, and the bridge files that none names."""

    launched: tuple[Simulation, ...]
    loose: Simulation

    @property
    def all(self) -> tuple[Simulation, ...]:
        """Those of launch files first."""
        return (*self.launched, self.loose)

    def given(self, robot: Robot) -> list[Robot]:
        """Return a robot as launch files give it to Gazebo, each with its own arguments."""
        return [it for each in self.launched for it in each.given(robot)]


def simulations(package: Package, launch: Ros2Launch | None, reader: SpawnedReader) -> Simulations:
    """Read what the launch files of a package simulate, those that start Gazebo or a bridge.

    Args:
        package: The package being checked.
        launch: Its launch files.
        reader: The reader of the robots that they spawn.
    """
    graphs = launch.entries if launch is not None else ()
    launched = tuple(_simulation(package, graph, reader) for graph in graphs)
    named = {file for each in launched for file in each.bridges.files}
    return Simulations(launched, Simulation(None, bridges_without_launch(package, named)))


def _simulation(package: Package, graph: LaunchGraph, reader: SpawnedReader) -> Simulation:
    bridges = read_bridges(package, graph)
    servers = tuple(read_servers(package, graph))
    if not servers and starts_classic(graph):
        classic, _ = reader.robots(graph, CLASSIC_SPAWNS)
        return Simulation(graph, bridges, classic_robots=tuple(classic))
    if not bridges.entries and not servers:
        return Simulation(graph, bridges)
    robots, unknown = reader.robots(graph)
    return Simulation(graph, bridges, tuple(robots), tuple(unknown), servers)
