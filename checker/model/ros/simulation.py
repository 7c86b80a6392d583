"""What a ROS 2 launch file simulates: robots and world in Gazebo, and the bridges to ROS."""

from __future__ import annotations

import shlex
from collections.abc import Iterator, Mapping
from functools import cached_property

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
    Process,
    Ros2Launch,
    is_known,
    share_path,
    shown,
)
from checker.expand.ros2_launch.package_files import local_file
from checker.expand.xacro.expansion import Expansions, Wanted
from checker.expand.xacro.files import local_path
from checker.model.robot import Robot
from checker.model.ros.simulated_topics import (
    SimulatedTopic,
    is_silent,
    simulated_topics,
    unknown_owner,
)
from checker.model.ros.topics import comparable
from checker.model.sdf.includes import ModelIncludes
from checker.model.sdf.reader import read_sdf
from checker.model.sdf.world import World, read_worlds
from checker.model.urdf.description import read_description
from checker.package.package import Package
from checker.source.text import Located
from checker.source.xml import XmlDocument

GAZEBO = ("ros_gz_sim", "ros_ign_gazebo")
STATE_PUBLISHER = "robot_state_publisher"
_STARTS_ALL = ("gz_sim.launch", "gz_server.launch", "ign_gazebo.launch", "gz_gui.launch")
"""Launch files of Gazebo's own packages that start it, and neither bridge nor spawn."""
_WORLD_SUFFIXES = (".sdf", ".world")


class SpawnedRobot(Record, eq=False):
    """A robot that a launch file puts into Gazebo.

    Attributes:
        robot: The robot.
        node: That spawns it.
        name: In Gazebo; empty when it is not known.
        publisher: The node that publishes its transforms from the same description, if any.
    """

    robot: Robot
    node: Node
    name: str
    publisher: Node | None


class Simulation(Record, eq=False, dict=True):
    """What one launch file simulates and bridges.

    Attributes:
        graph: Of the launch file; None for files of bridges that no launch file names.
        bridges: What is passed.
        robots: That it spawns.
        unknown_robots: Why some that it spawns are not among them.
        worlds: That it loads.
        unknown_worlds: Why the world is not known; empty where no Gazebo is started as well.
        starts_gazebo: Whether it starts Gazebo.
        reads_exports: Whether Gazebo is told of `<gazebo_ros>` in package.xml, as the launch files
            of ros_gz_sim do.
    """

    graph: LaunchGraph | None
    bridges: Bridges
    robots: tuple[SpawnedRobot, ...] = ()
    unknown_robots: tuple[str, ...] = ()
    worlds: tuple[World, ...] = ()
    unknown_worlds: tuple[str, ...] = ()
    starts_gazebo: bool = False
    reads_exports: bool = False

    @property
    def entries(self) -> tuple[BridgeEntry, ...]:
        """The topics that are passed."""
        return self.bridges.entries

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
    def unread(self) -> str:
        """Why it may start more than is known; empty where all was read."""
        if self.graph is None:
            return "no launch file names it"
        if any(not _is_gazebo(process) for process in self.graph.processes):
            return "a command may start anything"
        reasons = [*self.bridges.unread, *(unread.reason for unread in self.graph.unread)]
        reasons += [fault.message for fault in self.graph.faults]
        for include in self.graph.includes:
            target = share_path(include.target.value)
            own = target is not None and target.package in GAZEBO
            if not include.path and not (own and _starts_gazebo(include.target.value)):
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
    """Read what the launch files of a package simulate and bridge.

    Args:
        package: That is checked.
        launch: Its launch files.
        cache: Where what xacro makes is kept.
    """
    reader = _Reader(package, cache)
    launched = tuple(map(reader.simulation, launch.entries if launch is not None else ()))
    named = {file for each in launched for file in each.bridges.files}
    return Simulations(launched, Simulation(None, loose_bridges(package, named)))


class _Reader:
    def __init__(self, package: Package, cache: Cache) -> None:
        self._package = package
        self._cache = cache
        self._known: dict[str, Robot | str] = {}

    def simulation(self, graph: LaunchGraph) -> Simulation:
        bridges = read_bridges(self._package, graph)
        included = any(_starts_gazebo(each.target.value) and each.starts for each in graph.includes)
        called = any(_is_gazebo(process) and process.starts for process in graph.processes)
        robots, unknown = self._robots(graph)
        # Who asks for the world asks what is behind a bridge.
        worlds, unknown_worlds = self._worlds(graph) if bridges.entries else ([], [])
        return Simulation(
            graph,
            bridges,
            tuple(robots),
            tuple(unknown),
            tuple(worlds),
            tuple(unknown_worlds),
            included or called,
            included,
        )

    def _robots(self, graph: LaunchGraph) -> tuple[list[SpawnedRobot], list[str]]:
        loaded = [*loaded_descriptions(self._package, graph)]
        robots: list[SpawnedRobot] = []
        unknown: list[str] = []
        for node in graph.nodes:
            if node.package.value not in GAZEBO or node.executable.value != "create":
                continue
            if node.starts is False:
                continue
            given = _given(node, loaded)
            if not given:
                unknown.append(f"what {node.executable.value} spawns is not known")
            for description in given:
                robot = self._robot(description)
                if isinstance(robot, str):
                    unknown.append(robot)
                else:
                    publisher = _publisher(description, loaded)
                    robots.append(SpawnedRobot(robot, node, _name(node, robot), publisher))
        return robots, unknown

    def _robot(self, description: LoadedDescription) -> Robot | str:
        if description.unknown:
            return f"argument {description.unknown[0]!r} of the robot is not known"
        load = description.load
        key = f"{load.path} {sorted(load.args.items())}"
        if key not in self._known:
            self._known[key] = self._read(load)
        return self._known[key]

    def _read(self, load: Load) -> Robot | str:
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
            return read_description(document, path, for_rviz=False).robot
        models = read_sdf(document, ModelIncludes(self._package))
        return models[0] if models else f"{path} holds no model"

    def _worlds(self, graph: LaunchGraph) -> tuple[list[World], list[str]]:
        worlds: list[World] = []
        unknown: list[str] = []
        for include in graph.includes:
            if not _starts_gazebo(include.target.value) or include.starts is False:
                continue
            words = [*_words(include.arguments)]
            if any(word == "-g" for word in words):
                continue
            named = [word for word in words if word.lower().endswith(_WORLD_SUFFIXES)]
            path = local_file(self._package, named[0]) if named else None
            document = self._package.xml(path) if path is not None else None
            if isinstance(document, XmlDocument):
                worlds += read_worlds(document, ModelIncludes(self._package))
            elif named != ["empty.sdf"]:
                unknown.append("the world is not known")
        if any(_is_gazebo(process) for process in graph.processes):
            unknown.append("the world is not known")
        return worlds, unknown


def _words(arguments: Mapping[str, Located[str]]) -> Iterator[str]:
    for name in ("gz_args", "ign_args", "world_sdf_file"):
        if name in arguments:
            try:
                yield from shlex.split(arguments[name].value)
            except ValueError:  # a quotation mark that nothing closes
                return


def _is_gazebo(process: Process) -> bool:
    return bool(process.words) and process.words[0].value in ("gz", "ign")


def _starts_gazebo(target: str) -> bool:
    found = share_path(target)
    file = found.path.rpartition("/")[2] if found is not None else ""
    return found is not None and found.package in GAZEBO and file.startswith(_STARTS_ALL)


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
