"""Which descriptions launch files put into Gazebo, and into which."""

from __future__ import annotations

import posixpath
from collections.abc import Iterator, Sequence
from functools import cached_property

from msgspec.structs import replace

from checker.base.record import Record
from checker.finding import Place
from checker.formats.xacro.files import local_path
from checker.launch.ros1.launch_file import Load
from checker.launch.ros2.descriptions import LoadedDescription, loaded_descriptions
from checker.launch.ros2.graph import LaunchGraph, Node, is_known
from checker.launch.ros2.package_launch import launches_naming
from checker.model.robot import Robot
from checker.model.ros_parameters import MANAGER
from checker.package.package import Package
from checker.robots.unspawned import may_load_others
from checker.ros.ros2_control.launched import MANAGER_NODE, may_start
from checker.ros.servers import is_gazebo
from checker.ros.spawned import CLASSIC_SPAWNS, EVERY_SPAWN, is_state_publisher, spawned_otherwise
from checker.ros.unread import unread_files
from checker.source.text import Span

_ELSEWHERE = "Gazebo gets another description"
_HARDWARE = "launch files give it to ros2_control_node, and none spawns it into Gazebo"

_STARTING = (("run",), ("launch",))
"""Verbs of `ros2` that start nodes."""


class _Spawn(Record):
    """A description that a node spawns: its file, empty if it is none of the package's."""

    file: str
    node: Node
    load: Load | None = None

    @property
    def in_classic(self) -> bool:
        """Whether Gazebo Classic gets it."""
        return self.node.program in CLASSIC_SPAWNS


class OutsideManager(Record, eq=False):
    """A ros2_control_node of a launch file that spawns nothing into Gazebo.

    Attributes:
        load: The description that it certainly gets.
        place: Its program in the launch file, as the checked package lists that.
    """

    load: Load
    place: Place


class SpawnedFiles(Record, eq=False, dict=True):
    """Descriptions of a package, as far as its launch files and those that name it load them.

    Attributes:
        package: The package being checked.
        own: What its own launch files start.
    """

    package: Package
    own: tuple[LaunchGraph, ...]

    @cached_property
    def _graphs(self) -> Sequence[tuple[LaunchGraph, Sequence[LoadedDescription]]]:
        """What these launch files start, and the descriptions that they load."""
        graphs = (*self.own, *(graph for _, graph in self._naming))
        return [(graph, [*loaded_descriptions(self.package, graph)]) for graph in graphs]

    @cached_property
    def _naming(self) -> Sequence[tuple[Package, LaunchGraph]]:
        """Launch files of other packages that name this one, each with its package.

        Most packages need none of it: they are read when the first rule asks.
        """
        return [*launches_naming(self.package)]

    def without(self, robot: Robot) -> str:
        """Return that Gazebo never gets a robot that is loaded, as a clause; empty if it may.

        Either launch files spawn others, or a controller manager outside of Gazebo gets it.
        """
        file = robot.document.source.file
        loading = [graph for graph, loaded in self._graphs if file in map(self._file, loaded)]
        spawns = self._spawns
        if not loading or spawns is None or any(it.file == file for it in spawns):
            return ""
        if any(map(_may_spawn_more, loading)):
            return ""
        if spawns:
            return _ELSEWHERE
        return _HARDWARE if any(map(_starts_manager, loading)) else ""

    def of_hardware(self, robot: Robot) -> str:
        """Return that a robot is loaded for hardware alone, as a clause; empty if it may not be."""
        clause = self.without(robot)
        return clause if clause == _HARDWARE else ""

    def managers_outside(self, robot: Robot) -> Iterator[OutsideManager]:
        """Yield the ros2_control_nodes that certainly get the file of a robot, and no Gazebo.

        Each is one of a launch file that spawns nothing, and that gives xacro known arguments.
        """
        file = robot.document.source.file
        for graph, loaded in self._graphs:
            given = [it for it in loaded if it.node.starts is not False and _describes(it)]
            nodes = graph.nodes_and_spawns
            managers = [it for it in nodes if it.starts and it.program == (MANAGER, MANAGER_NODE)]
            certain = given and all(
                self._file(it) == file
                and it.node.starts
                and it.load.args == given[0].load.args
                and not it.unknown
                for it in given
            )
            spawns = any(it.program in EVERY_SPAWN for it in nodes)
            if managers and certain and not spawns and not _may_spawn_more(graph):
                place = self._place(graph, managers[0].executable.span)
                yield OutsideManager(given[0].load, place)

    def _place(self, graph: LaunchGraph, span: Span) -> Place:
        """Return a place in a launch file, or in what it includes, as the package lists files."""
        place = span.place()
        holder = next((it for it, naming in self._naming if naming is graph), self.package)
        path = f"../{holder.name}/{place.file}" if holder is not self.package else place.file
        own = f"../{self.package.name}/"
        return replace(place, file=posixpath.normpath(path).removeprefix(own))

    def starts_for_others(self, robot: Robot, controller: str) -> bool:
        """Return whether launch files start a controller, and those of this robot certainly not."""
        own, others = False, False
        for graph, loaded in self._graphs:
            files = set(map(self._file, loaded))
            is_own, starts = robot.document.source.file in files, may_start(graph, controller)
            if starts and (is_own or not files):
                return False
            own, others = own or is_own, others or starts
        return own and others

    def is_spawned(self, robot: Robot) -> bool:
        """Return whether a launch file that loads a robot starts what spawns it into Gazebo."""
        file = robot.document.source.file
        return any(
            node.program in EVERY_SPAWN and node.starts
            for graph, loaded in self._graphs
            if file in map(self._file, loaded)
            for node in graph.nodes_and_spawns
        )

    def is_in_classic(self, robot: Robot) -> bool | None:
        """Return whether a robot is spawned into Classic alone; None if into others, or neither."""
        file = robot.document.source.file
        found = {it.in_classic for it in self._spawns or () if it.file == file}
        return found.pop() if len(found) == 1 else None

    def misplaced(self, robot: Robot) -> Sequence[Node]:
        """Return the nodes that spawn a robot into Gazebo Sim, where as many files do into Classic.

        Classic gets the same file with the same arguments. None where a launch file of another
        package is among them: its places are not those of this package.
        """
        own = self._certain_of(robot)
        classic = [it for it in own if it.in_classic]
        given = [it.load for it in classic]
        later = [it.node for it in own if not it.in_classic and it.load in given]
        as_many = len({it.node.file for it in classic}) >= len({it.file for it in later})
        mine = {id(node) for graph in self.own for node in graph.nodes_and_spawns}
        return later if as_many and mine.issuperset(map(id, later)) else ()

    def is_certainly_spawned(self, robot: Robot) -> bool:
        """Return whether a launch file spawns a robot with the defaults of its arguments."""
        return any(it.node.starts for it in self._certain_of(robot))

    def is_in_both(self, robot: Robot) -> bool:
        """Return whether launch files spawn a robot into Classic, and into a later Gazebo."""
        return {it.in_classic for it in self._certain_of(robot)} == {True, False}

    def classic_spawn(self, robot: Robot) -> Node | None:
        """Return the first node that spawns a robot into Classic, if any does."""
        return next((it.node for it in self._certain_of(robot) if it.in_classic), None)

    def _certain_of(self, robot: Robot) -> Sequence[_Spawn]:
        """Return what spawns a robot for certain, though launch files may spawn more."""
        file = robot.document.source.file
        return [it for it in self._read_spawns if it is not None and it.file == file]

    @cached_property
    def _spawns(self) -> tuple[_Spawn, ...] | None:
        """All that is spawned; None if that is not known."""
        found = self._read_spawns
        known = tuple(it for it in found if it is not None)
        return known if len(known) == len(found) else None

    @cached_property
    def _read_spawns(self) -> Sequence[_Spawn | None]:
        """All that is spawned; None in place of each that is not known."""
        return [spawn for each in self._graphs for spawn in self._spawned(*each)]

    def _spawned(
        self, graph: LaunchGraph, loaded: Sequence[LoadedDescription]
    ) -> Iterator[_Spawn | None]:
        if graph.unread or any(spawned_otherwise(graph)):
            yield None
        for node in graph.nodes_and_spawns:
            if node.program in EVERY_SPAWN:
                given = _given(graph, node, loaded)
                yield from (self._spawn(graph, node, it) for it in given)
                if not given:
                    yield _Spawn("", node) if _is_file(node) else None

    def _spawn(self, graph: LaunchGraph, node: Node, given: LoadedDescription) -> _Spawn | None:
        sure = not may_load_others(graph, given)
        return _Spawn(self._file(given), node, given.load) if sure else None

    def _file(self, loaded: LoadedDescription) -> str:
        return local_path(self.package, loaded.load.path) or ""


def _describes(given: LoadedDescription) -> bool:
    """Return whether a node passes a description on to controller managers, or is one."""
    return is_state_publisher(given.node) or given.node.program == (MANAGER, MANAGER_NODE)


def _given(
    graph: LaunchGraph, node: Node, loaded: Sequence[LoadedDescription]
) -> Sequence[LoadedDescription]:
    """Return all that a node may spawn; nothing if that is not known.

    One that starts for other arguments alone takes what the same launch file publishes, if any.
    """
    own = [it for it in loaded if it.node is node]
    if own or "-topic" not in {word.value for word in node.arguments}:
        return own
    every = [it for it in graph.nodes_and_spawns if is_state_publisher(it)]
    beside = [it for it in every if it.file == node.file and node.starts is False] or every
    given = [it for it in loaded if it.node in beside]
    return given if {id(it) for it in beside} == {id(it.node) for it in given} else ()


def _may_spawn_more(graph: LaunchGraph) -> bool:
    """Return whether what is not read of a launch file may spawn the robot that it publishes."""
    commands = (
        it for process in graph.processes if not is_gazebo(process) for it in process.commands
    )
    names = (tuple(word.value for word in command[:2]) for command in commands)
    return any(unread_files(graph)) or any(
        it[:1] != ("ros2",) or it[1:] in _STARTING for it in names
    )


def _is_file(node: Node) -> bool:
    """Return whether a node spawns a file alone, which is none of the package's."""
    words = [word.value for word in node.arguments]
    return "-file" in words and all(map(is_known, words)) and not node.unread


def _starts_manager(graph: LaunchGraph) -> bool:
    return (MANAGER, MANAGER_NODE) in (it.program for it in graph.nodes_and_spawns)
