"""Controller managers and spawners of ros2_control in launch files."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from checker.base.record import Record
from checker.launch.ros1.graph import resolve_name
from checker.launch.ros2.graph import LaunchGraph, Node, ParameterFile, is_known
from checker.launch.ros2.package_files import local_file
from checker.model.controllers import Controller, ControllerFile, controllers_of
from checker.model.ros_parameters import MANAGER
from checker.package.package import Package
from checker.ros.ros2_control.robot_control import ControlReader, RobotControl, runs_manager
from checker.ros.spawned import EVERY_SPAWN, SpawnedReader, SpawnedRobot
from checker.ros.unread import unread_files, unread_parts
from checker.source.text import Located, Span

MANAGER_NODE = "ros2_control_node"
_SPAWNERS = ("spawner", "spawner.py")
_WITH_VALUE = (
    *("-c", "--controller-manager", "-p", "--param-file", "-n", "--namespace"),
    *("-t", "--controller-type", "--controller-manager-timeout", "--switch-timeout"),
    *("--service-call-timeout", "--controller-ros-args"),
)
_ROS_ARGS, _END_OF_ROS_ARGS = "--ros-args", "--"


class Spawner(Record, eq=False):
    """A spawner of controllers.

    Attributes:
        node: The node.
        names: The names of the controllers; those known at launch only are left out.
        options: Values of options by their name, short or long, several where given several times.
        complete: Whether nothing of its command line is left to the machine that launches.
    """

    node: Node
    names: tuple[Located[str], ...]
    options: Mapping[str, tuple[str, ...]]
    complete: bool

    @property
    def param_files(self) -> tuple[str, ...]:
        """Files of parameters that it passes to its controllers."""
        own = (file.path for file in self.node.parameter_files)
        return (*self.options.get("-p", ()), *self.options.get("--param-file", ()), *own)

    @property
    def gives_parameters(self) -> bool:
        """True if its controllers may get parameters from it."""
        return bool(self.param_files or "--controller-ros-args" in self.options)

    @property
    def manager(self) -> str:
        """Full name of the controller manager that it waits for; empty if that is not known.

        Until Galactic, the name was absolute where no option states it.
        """
        stated = [*self.options.get("-c", ()), *self.options.get("--controller-manager", ())]
        name = stated[-1] if stated else MANAGER
        old = self.node.executable.value != _SPAWNERS[0] and not name.startswith("/")
        moved = any(word.value.startswith("__ns") for word in self.node.arguments)
        known = self.complete and not moved and not self.options.keys() & {"-n", "--namespace"}
        full = resolve_name(name, self.node.namespace)
        return full if known and not old and is_known(full) else ""

    @property
    def states_type(self) -> bool:
        """True if it states the type of its controllers itself."""
        return bool(self.options.keys() & {"-t", "--controller-type"})


def spawner_of(node: Node) -> Spawner | None:
    """Return a node as a spawner; None for any other node."""
    if node.package.value != MANAGER or node.executable.value not in _SPAWNERS:
        return None
    names: list[Located[str]] = []
    options: dict[str, tuple[str, ...]] = {}
    awaited, for_ros = "", False
    for word in node.arguments:
        text = word.value
        if awaited:
            options[awaited] = (*options.get(awaited, ()), text)
            awaited = ""
        elif text in (_ROS_ARGS, _END_OF_ROS_ARGS):
            for_ros = text == _ROS_ARGS
        elif text.startswith("-") and not for_ros:
            name, assigned, value = text.partition("=")
            if assigned:
                options[name] = (*options.get(name, ()), value)
            elif name in _WITH_VALUE:
                awaited = name
        elif not for_ros and is_known(text) and text:
            names.append(word)
    known = all(is_known(word.value) for word in node.arguments)
    return Spawner(node, tuple(names), options, known and not node.unread)


def may_start(graph: LaunchGraph, controller: str) -> bool:
    """Return whether a launch file, conditions aside, may start or load a controller."""
    spawners = [it for it in map(spawner_of, graph.nodes_and_spawns) if it is not None]
    if any(unread_files(graph)) or not all(it.complete for it in spawners):
        return True
    words = (word for process in graph.processes for word in process.words)
    names = (name for spawner in spawners for name in spawner.names)
    return any(it.value == controller for it in (*words, *names))


def launched_files(package: Package, graphs: Iterable[LaunchGraph]) -> dict[str, Span]:
    """Return the files of parameters that managers and spawners are given, by their path."""
    files: dict[str, Span] = {}
    for node in (node for graph in graphs for node in graph.nodes_and_spawns):
        named = [(file.path, file.span) for file in node.parameter_files if _is_manager(node)]
        spawner = spawner_of(node)
        if spawner is not None:
            named += [(path, node.span) for path in spawner.param_files]
        for path, span in named:
            local = local_file(package, path)
            if local is not None:
                files.setdefault(local, span)
    return files


def _is_manager(node: Node) -> bool:
    return node.package.value == MANAGER and node.executable.value == MANAGER_NODE


class LaunchedControl(Record, eq=False, dict=True):
    """Effects of one launch file, with all that it includes, on ros2_control.

    Attributes:
        graph: The graph of the launch file.
        controls: ros2_control of the robots of the package.
        reader: Reads files of parameters.
        spawned: Reads the robots that launch files spawn.
    """

    graph: LaunchGraph
    controls: tuple[RobotControl, ...]
    reader: ControlReader
    spawned: SpawnedReader

    @cached_property
    def nodes(self) -> tuple[Node, ...]:
        """The nodes that are started with the defaults of all arguments."""
        return tuple(node for node in self.graph.nodes_and_spawns if node.starts)

    @cached_property
    def spawners(self) -> tuple[Spawner, ...]:
        """The spawners among them."""
        found = map(spawner_of, self.nodes)
        return tuple(spawner for spawner in found if spawner is not None)

    @cached_property
    def managers(self) -> tuple[Node, ...]:
        """Controller managers that it starts as nodes."""
        return tuple(filter(_is_manager, self.nodes))

    @cached_property
    def _spawned(self) -> tuple[list[SpawnedRobot], list[str]]:
        """The robots that it spawns, and why others are not among them."""
        return self.spawned.robots(self.graph, EVERY_SPAWN)

    @cached_property
    def in_gazebo(self) -> tuple[RobotControl, ...]:
        """Those of the robots whose plugin in Gazebo runs a manager.

        What it spawns may be of another package; what is not known is a robot of this one.
        """
        robots, unknown = self._spawned
        spawned = [it.control for it in robots if it.control is not None and it.control.managers]
        found = self.controls if unknown or not spawned else spawned
        return tuple(control for control in found if control.managers)

    @cached_property
    def spawns_manager(self) -> bool | None:
        """Whether a plugin of what it spawns runs a controller manager; None if not known."""
        robots, unknown = self._spawned
        plugins = (plugin for spawned in robots for plugin in spawned.robot.plugins)
        return any(map(runs_manager, plugins)) or (None if unknown else False)

    @property
    def is_complete(self) -> bool:
        """True if nothing that it starts depends on other files or on the machine that launches."""
        unsure = any(node.starts is None for node in self.graph.nodes_and_spawns)
        return not (unsure or any(unread_parts(self.graph)))

    @cached_property
    def listed_controllers(self) -> frozenset[str] | None:
        """Controllers whose type the managers know; None if their file is not known."""
        if self._files is None:
            return None
        inline = (name.removesuffix(".type") for name in self.inline if name.endswith(".type"))
        listed = (each.name for each in self.controllers if each.listed)
        return frozenset((*inline, *listed))

    @cached_property
    def inline(self) -> frozenset[str]:
        """Names of the parameters that the launch file itself gives to the managers."""
        return frozenset(
            parameter.name
            for node in self.managers
            for parameter in node.parameters
            if not isinstance(parameter, ParameterFile)
        )

    @cached_property
    def bare_controllers(self) -> tuple[tuple[Controller, Located[str]], ...]:
        """Controllers without a block of their own, each with its name at the spawner.

        Those that may get parameters from a spawner, or by `params_file`, are left out.
        """
        names = {name.value: name for spawner in self.spawners for name in spawner.names}
        giving = [it for it in self.spawners if it.gives_parameters or not it.complete]
        otherwise = {name.value for spawner in giving for name in spawner.names}
        managers = [block for file in self._files or () for block in file.managers]
        stated = {*self.inline, *(name for block in managers for name in block.parameters)}
        return tuple(
            (each, names[each.name])
            for each in self.controllers
            if each.block is None and each.name in names.keys() - otherwise
            if f"{each.name}.params_file" not in stated
        )

    @cached_property
    def controllers(self) -> tuple[Controller, ...]:
        """Controllers in the files of the managers; none if a file is not known."""
        return controllers_of(self._files or ())

    @cached_property
    def _files(self) -> tuple[ControllerFile, ...] | None:
        """The files that the managers are given."""
        named = (file for it in self.in_gazebo for plugin in it.managers for file in plugin.files)
        if any(file.path is None for file in named):
            return None
        files = [file for control in self.in_gazebo for file in control.files]
        for node in self.managers:
            if node.unread:
                return None
            for parameter in node.parameters:
                if isinstance(parameter, ParameterFile):
                    read = self.reader.file(parameter.path)
                    if read is None:
                        return None
                    files.append(read)
        if any(control.unread for control in self.in_gazebo):
            return None
        return tuple(files)

    def typed_controllers(self, spawner: Spawner) -> frozenset[str] | None:
        """Return the controllers whose type a spawner's own files state; None if not known."""
        files: list[ControllerFile] = []
        for path in spawner.param_files:
            read = self.reader.file(path)
            if read is None:
                return None
            files.append(read)
        return frozenset(each.name for each in controllers_of(files))


def launched_controls(
    reader: ControlReader,
    graphs: Sequence[LaunchGraph],
    controls: tuple[RobotControl, ...],
    spawned: SpawnedReader,
) -> Iterator[LaunchedControl]:
    """Yield what launch files do for ros2_control; those that have nothing to do with it are none.

    Args:
        reader: The reader of the files of the package being checked.
        graphs: The graphs of its launch files.
        controls: ros2_control of its robots.
        spawned: The reader of the robots that they spawn.
    """
    for graph in graphs:
        launched = LaunchedControl(graph, controls, reader, spawned)
        if launched.spawners or launched.managers:
            yield launched
