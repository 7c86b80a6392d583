"""What a ROS 2 launch file simulates: robots and world in Gazebo, and the bridges to ROS."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from itertools import pairwise

from checker.base.cache import Cache
from checker.base.record import Record
from checker.expand.launch.launch_file import Load
from checker.expand.ros2_launch.bridge_entry import BridgeEntry
from checker.expand.ros2_launch.bridges import Bridges, loose_bridges, read_bridges
from checker.expand.ros2_launch.descriptions import LoadedDescription, loaded_descriptions
from checker.expand.ros2_launch.graph import (
    LaunchGraph,
    Node,
    Parameter,
    Ros2Launch,
    is_known,
    share_path,
    shown,
)
from checker.expand.xacro.expansion import Expansions, Wanted
from checker.expand.xacro.files import local_path
from checker.model.robot import Robot
from checker.model.ros.servers import (
    GAZEBO,
    GazeboServer,
    is_gazebo,
    is_gazebo_include,
    read_servers,
)
from checker.model.ros.simulated_topics import (
    SimulatedTopic,
    is_silent,
    simulated_topics,
    unknown_owner,
)
from checker.model.ros.topics import comparable
from checker.model.ros2_control.launched import launched_files
from checker.model.ros2_control.robot_control import (
    ControlReader,
    RobotControl,
    may_be_controlled,
)
from checker.model.sdf.includes import ModelIncludes
from checker.model.sdf.reader import read_sdf
from checker.model.sdf.world import World, systems_of
from checker.model.urdf.description import read_description
from checker.package.package import Package
from checker.source.xml import XmlDocument

_SPAWNS = tuple((package, "create") for package in GAZEBO)
STATE_PUBLISHER = "robot_state_publisher"


class SpawnedRobot(Record, eq=False):
    """A robot that a launch file puts into Gazebo.

    Attributes:
        robot: The robot.
        control: Its ros2_control, if it has any.
        name: In Gazebo; empty when it is not known.
        node: That spawns it.
        publisher: The node that publishes its transforms from the same description, if any.
    """

    robot: Robot
    control: RobotControl | None
    name: str
    node: Node
    publisher: Node | None


class Simulation(Record, eq=False, dict=True):
    """What one launch file simulates and bridges.

    Attributes:
        graph: Of the launch file; None for files of bridges that no launch file names.
        bridges: What is passed.
        robots: That it spawns.
        unknown_robots: Why some that it spawns are not among them.
        servers: Gazebo, as often as it starts it.
    """

    graph: LaunchGraph | None
    bridges: Bridges
    robots: tuple[SpawnedRobot, ...] = ()
    unknown_robots: tuple[str, ...] = ()
    servers: tuple[GazeboServer, ...] = ()

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
        """Why the world is not known; empty where no Gazebo is started as well."""
        return tuple(server.unknown for server in self.servers if server.unknown)

    @property
    def starts_gazebo(self) -> bool:
        """Whether it starts Gazebo for certain."""
        return any(server.starts for server in self.servers)

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
        """Whether it starts Gazebo, and all that it starts was read."""
        return self.starts_gazebo and not self.unread

    @property
    def model_names(self) -> frozenset[str]:
        """Names of the models in Gazebo; none where one is not known."""
        names = [spawned.name for spawned in self.robots]
        names += [model.name.value for world in self.worlds for model in world.models]
        return frozenset(names) if all(names) else frozenset()

    @property
    def world_names(self) -> frozenset[str]:
        """Names of the worlds; none where one is not known."""
        names = [world.name for world in self.worlds]
        return frozenset(names) if all(names) and not self.unknown_worlds else frozenset()

    def topics_of(self, entry: BridgeEntry) -> list[SimulatedTopic]:
        """Return what is behind the topic of a bridge, whatever world and model are called."""
        known = entry.gz_topic and entry.counts
        return self.topics.get(comparable(entry.gz_topic), []) if known else []

    @cached_property
    def unknown_topics(self) -> str:
        """Why models may have more topics than those that are known; empty where all are."""
        reasons = [*self.unknown_robots, *self.unknown_worlds]
        reasons += filter(None, map(unknown_owner, self.models))
        reasons += [
            f"{uri.value} is not available" for world in self.worlds for uri in world.unknown
        ]
        return next(iter(reasons), "")

    @property
    def knows_systems(self) -> bool:
        """Whether the systems of the world itself have no topics but the usual ones."""
        plugins = (plugin for world in self.worlds for plugin in world.plugins)
        return all(is_silent(plugin) for plugin in plugins)

    @cached_property
    def spawned_systems(self) -> frozenset[str]:
        """What the robots that it spawns load: `sensors`, `imu`."""
        plugins = (plugin for spawned in self.robots for plugin in spawned.robot.plugins)
        return frozenset(name for plugin in plugins for name in systems_of(plugin))

    @cached_property
    def unread(self) -> str:
        """Why it may start more than is known; empty where all was read."""
        if self.graph is None:
            return "no launch file names it"
        if any(not is_gazebo(process) for process in self.graph.processes):
            return "a command may start anything"
        reasons = [*self.bridges.unread, *(unread.reason for unread in self.graph.unread)]
        reasons += [fault.message for fault in self.graph.faults]
        for include in self.graph.includes:
            if not include.path and not is_gazebo_include(include):
                reasons.append(f"{shown(include.target.value)} is not read")
        return next(iter(reasons), "")


class Simulations(Record, eq=False):
    """What the launch files of a package simulate, and the files of bridges that none names."""

    launched: tuple[Simulation, ...]
    loose: Simulation

    @property
    def all(self) -> tuple[Simulation, ...]:
        """Those of launch files first."""
        return (*self.launched, self.loose)


def simulations(package: Package, launch: Ros2Launch | None, cache: Cache) -> Simulations:
    """Read what the launch files of a package simulate, those that bridge something.

    Args:
        package: That is checked.
        launch: Its launch files.
        cache: Where what xacro makes is kept.
    """
    graphs = launch.entries if launch is not None else ()
    reader = _Reader(package, cache, graphs)
    launched = tuple(map(reader.simulation, graphs))
    named = {file for each in launched for file in each.bridges.files}
    return Simulations(launched, Simulation(None, loose_bridges(package, named)))


class _Described(Record, eq=False):
    robot: Robot
    control: RobotControl | None = None


class _Reader:
    def __init__(self, package: Package, cache: Cache, graphs: Sequence[LaunchGraph]) -> None:
        self._package = package
        self._cache = cache
        self._known: dict[str, _Described | str] = {}
        self._control = ControlReader(package, launched_files(package, graphs))

    def simulation(self, graph: LaunchGraph) -> Simulation:
        bridges = read_bridges(self._package, graph)
        servers = tuple(read_servers(self._package, graph))
        if not bridges.entries and not servers:
            return Simulation(graph, bridges)
        robots, unknown = self._robots(graph)
        return Simulation(graph, bridges, tuple(robots), tuple(unknown), servers)

    def _robots(self, graph: LaunchGraph) -> tuple[list[SpawnedRobot], list[str]]:
        loaded = [*loaded_descriptions(self._package, graph)]
        robots: list[SpawnedRobot] = []
        unknown: list[str] = [*_spawned_otherwise(graph)]
        for node in graph.nodes:
            if node.package.value not in GAZEBO or node.executable.value != "create":
                continue
            if node.starts is False:
                continue
            given = _given(node, loaded)
            if not given:
                unknown.append(f"what {node.executable.value} spawns is not known")
            for description in given:
                read = self._robot(description)
                if isinstance(read, str):
                    unknown.append(read)
                else:
                    publisher, name = _publisher(description, loaded), _name(node, read.robot)
                    spawned = SpawnedRobot(read.robot, read.control, name, node, publisher)
                    robots.append(spawned)
        return robots, unknown

    def _robot(self, description: LoadedDescription) -> _Described | str:
        if description.unknown:
            return f"argument {description.unknown[0]!r} of the robot is not known"
        load = description.load
        key = f"{load.path} {sorted(load.args.items())}"
        if key not in self._known:
            self._known[key] = self._read(load)
        return self._known[key]

    def _read(self, load: Load) -> _Described | str:
        path = local_path(self._package, load.path)
        if path is None:
            return f"{shown(load.path)} is not at hand"
        document: object = self._package.xml(path)
        if load.by_xacro:
            wanted = [Wanted(path, load.args)]
            (document,) = Expansions(self._package, wanted, self._cache).outcomes()
        if not isinstance(document, XmlDocument):
            return f"{path} cannot be read"
        if document.root.tag == "robot":
            description = read_description(document, path, for_rviz=False)
            controlled = may_be_controlled(description)
            control = self._control.control(description) if controlled else None
            return _Described(description.robot, control)
        models = read_sdf(document, ModelIncludes(self._package))
        return _Described(models[0]) if models else f"{path} holds no model"


def _spawned_otherwise(graph: LaunchGraph) -> Iterator[str]:
    """Yield what spawns robots of which nothing is known: launch files of Gazebo's, commands."""
    for include in graph.includes:
        target = share_path(include.target.value)
        if target and target.package in GAZEBO and not is_gazebo_include(include):
            yield f"what {target} spawns is not known"
    for process in graph.processes:
        words = [word.value for word in process.words]
        if any(pair in _SPAWNS for pair in pairwise(words)):
            yield "what a command spawns is not known"


def _given(node: Node, loaded: list[LoadedDescription]) -> list[LoadedDescription]:
    """Return the descriptions that a node spawns: its own, or what is published on a topic."""
    own = [description for description in loaded if description.node is node]
    words = [word.value for word in node.arguments]
    if own or "-topic" not in words:
        return own
    return [
        description
        for description in loaded
        if _publishes(description) and description.node.starts is not False
    ]


def _publishes(description: LoadedDescription) -> bool:
    return description.node.executable.value == STATE_PUBLISHER


def _publisher(description: LoadedDescription, loaded: list[LoadedDescription]) -> Node | None:
    """Return the node that publishes transforms of the same file with the same arguments."""
    same = (each for each in loaded if _publishes(each) and each.load == description.load)
    return next((each.node for each in same), None)


def _name(node: Node, robot: Robot) -> str:
    """Return the name that a model gets in Gazebo; empty when it is not known."""
    words = [word.value for word in node.arguments]
    name = robot.name.value
    if "-name" in words[:-1]:
        name = words[words.index("-name") + 1]
    renamed = any(isinstance(p, Parameter) and p.name == "name" for p in node.parameters)
    free = "-allow_renaming" in words or "--allow_renaming" in words
    return name if is_known(name) and not renamed and not free else ""
