"""The robots that ROS 2 launch files spawn into Gazebo."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from checker.base.record import Record
from checker.formats.sdf.includes import ModelIncludes
from checker.formats.sdf.reader import read_sdf
from checker.formats.urdf.description import read_description
from checker.formats.xacro.expansion import Expander, Expansions, Wanted
from checker.formats.xacro.files import local_path
from checker.launch.ros1.graph import apply_remaps
from checker.launch.ros1.launch_file import Load
from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import (
    CLASSIC_PACKAGE,
    GAZEBO,
    LaunchGraph,
    Node,
    Parameter,
    display_path,
    is_known,
    share_path,
)
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.robot_description import NAME
from checker.ros.ros2_control.robot_control import (
    ControlReader,
    RobotControl,
    may_be_controlled,
)
from checker.ros.servers import is_gazebo_include
from checker.ros.transforms import STATE_PUBLISHER
from checker.ros.wiring.facts import program_of
from checker.source.xml import XmlDocument

SPAWNS = tuple((package, "create") for package in GAZEBO)
CLASSIC_SPAWNS = ((CLASSIC_PACKAGE, "spawn_entity.py"),)
EVERY_SPAWN = (*SPAWNS, *CLASSIC_SPAWNS)


def may_spawn(graph: LaunchGraph) -> bool:
    """Return whether a launch file spawns something into Gazebo, or includes Gazebo's own."""
    programs = (node.program for node in graph.nodes_and_spawns)
    return any(map(is_gazebo_include, graph.includes)) or any(it in SPAWNS for it in programs)


class SpawnedRobot(Record, eq=False):
    """A robot that a launch file puts into Gazebo.

    Attributes:
        robot: The robot.
        control: Its ros2_control, if it has any.
        name: The name in Gazebo; empty if it is not known.
        node: The node that spawns it.
        publisher: The node that publishes its transforms from the same description, if any.
    """

    robot: Robot
    control: RobotControl | None
    name: str
    node: Node
    publisher: Node | None


class _Described(Record, eq=False):
    """A robot as its file describes it."""

    robot: Robot
    control: RobotControl | None = None


class SpawnedReader:
    """Reads the robots that launch files of a package spawn; each file is read once."""

    def __init__(self, package: Package, expander: Expander, control: ControlReader) -> None:
        """Begin with nothing read.

        Args:
            package: The package being checked.
            expander: Expands the files that are xacro.
            control: Reads ros2_control of its robots.
        """
        self._package = package
        self._expander = expander
        self._known: dict[str, _Described | str] = {}
        self._control = control

    def robots(
        self, graph: LaunchGraph, spawns: Collection[tuple[str, str]] = SPAWNS
    ) -> tuple[list[SpawnedRobot], list[str]]:
        """Return the robots that a launch file spawns, and why others are not among them.

        Args:
            graph: The graph of the launch file.
            spawns: Packages and programs that spawn; those of Gazebo Sim if none are given.
        """
        loaded = [*loaded_descriptions(self._package, graph)]
        robots: list[SpawnedRobot] = []
        unknown: list[str] = [*spawned_otherwise(graph)]
        for node in graph.nodes_and_spawns:
            if node.program not in spawns:
                continue
            if node.starts is False:
                continue
            given = _descriptions_of(node, loaded)
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

    def models(self, graphs: Iterable[LaunchGraph]) -> list[Robot]:
        """Return the SDF models of the package itself that launch files spawn."""
        found = (each.robot for graph in graphs for each in self.robots(graph, EVERY_SPAWN)[0])
        return [
            robot
            for robot in found
            if robot.document.root.tag == "sdf" and not robot.document.source.file.startswith("../")
        ]

    def published_robots(self, graph: LaunchGraph) -> Iterator[tuple[Node, Robot]]:
        """Yield the robot_state_publishers that start for certain, each with its robot if known."""
        for description in loaded_descriptions(self._package, graph):
            read = self._robot(description) if _publishes(description) else ""
            if description.node.starts and not isinstance(read, str):
                yield description.node, read.robot

    def given_robots(self, graph: LaunchGraph, node: Node) -> list[Robot | str]:
        """Return what a node gets as `robot_description`: robots, or why one is not known."""
        counting = (None, node.parameter(NAME))
        read = [
            self._robot(each)
            for each in loaded_descriptions(self._package, graph)
            if each.node is node and each.parameter in counting
        ]
        return [it if isinstance(it, str) else it.robot for it in read]

    def control(self, load: Load) -> RobotControl | None:
        """Return ros2_control of the robot that a file makes with the arguments it is given."""
        read = self._loaded(load)
        return read.control if isinstance(read, _Described) else None

    def _robot(self, description: LoadedDescription) -> _Described | str:
        if description.unknown:
            return f"argument {description.unknown[0]!r} of the robot is not known"
        return self._loaded(description.load)

    def _loaded(self, load: Load) -> _Described | str:
        key = f"{load.path} {sorted(load.args.items())}"
        if key not in self._known:
            self._known[key] = self._described_robot(load)
        return self._known[key]

    def _described_robot(self, load: Load) -> _Described | str:
        path = local_path(self._package, load.path)
        if path is None:
            return f"{display_path(load.path)} is not found"
        document: object = self._package.xml(path)
        if load.by_xacro:
            wanted = [Wanted(path, load.args)]
            (document,) = Expansions(self._package, wanted, self._expander).outcomes()
        if not isinstance(document, XmlDocument):
            return f"{path} cannot be read"
        if document.root.tag == "robot":
            description = read_description(document, path, for_rviz=False)
            controlled = may_be_controlled(description)
            control = self._control.control(description) if controlled else None
            return _Described(description.robot, control)
        models = read_sdf(document, ModelIncludes(self._package))
        return _Described(models[0]) if models else f"{path} contains no model"


def spawned_otherwise(graph: LaunchGraph) -> Iterator[str]:
    """Yield launch files of Gazebo's that spawn robots of which nothing is known."""
    for include in graph.includes:
        target = share_path(include.target.value)
        if target and target.package in GAZEBO and not is_gazebo_include(include):
            yield f"what {target} spawns is not known"


def _descriptions_of(node: Node, loaded: list[LoadedDescription]) -> list[LoadedDescription]:
    """Return the descriptions that a node spawns: its own, or what is published on a topic.

    Of a file that two nodes publish on one topic with other arguments, one arrives: the first is
    taken. Where no node is known to publish on its topic, all that are published are.
    """
    own = [description for description in loaded if description.node is node]
    words = [word.value for word in node.arguments]
    if own or "-topic" not in words:
        return own
    published = [it for it in loaded if _publishes(it) and it.node.starts is not False]
    wanted = _topic(node, words[words.index("-topic") + 1]) if words[-1] != "-topic" else ""
    published = [it for it in published if _topic(it.node, NAME) == wanted] or published
    by_file: dict[str, LoadedDescription] = {}
    for description in published:
        by_file.setdefault(description.load.path, description)
    return [*by_file.values()]


def _topic(node: Node, name: str) -> str:
    """Return the absolute topic that a node gets for a name."""
    remaps = ((remap.source, remap.target) for remap in node.remaps)
    return apply_remaps(name, remaps, node.namespace)


def _publishes(description: LoadedDescription) -> bool:
    return is_state_publisher(description.node)


def is_state_publisher(node: Node) -> bool:
    """Return whether a node publishes the description that it gets."""
    return program_of(node).endswith(f"/{STATE_PUBLISHER}")


def _publisher(description: LoadedDescription, loaded: list[LoadedDescription]) -> Node | None:
    """Return the node that publishes transforms of the same file with the same arguments."""
    same = (each for each in loaded if _publishes(each) and each.load == description.load)
    return next((each.node for each in same), None)


def _name(node: Node, robot: Robot) -> str:
    """Return the name that a model gets in Gazebo; empty if it is not known."""
    words = [word.value for word in node.arguments]
    name = robot.name.value
    if "-name" in words[:-1]:
        name = words[words.index("-name") + 1]
    renamed = any(isinstance(p, Parameter) and p.name == "name" for p in node.parameters)
    free = "-allow_renaming" in words or "--allow_renaming" in words
    return name if is_known(name) and not renamed and not free else ""
