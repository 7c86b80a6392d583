"""Topics that bridges pass between Gazebo and ROS 2, from launch files and YAML files."""

from __future__ import annotations

import re
from collections.abc import Iterable
from itertools import islice
from typing import TYPE_CHECKING

from msgspec import field
from msgspec.structs import replace

from checker.base.record import Record
from checker.launch.ros1.bridge import Direction
from checker.launch.ros1.graph import Remap, resolve_name
from checker.launch.ros2.bridges.entry import (
    BridgedService,
    BridgeEntry,
    BridgeFault,
    BridgeFaultKind,
    Passed,
    named_file,
    read_argument,
)
from checker.launch.ros2.bridges.file import is_bridge_file, read_bridge_file
from checker.launch.ros2.graph import (
    Include,
    LaunchGraph,
    Node,
    Parameter,
    ParameterFile,
    Parameters,
    display_path,
    is_known,
    share_path,
)
from checker.launch.ros2.package_files import exists, local_file, read_file
from checker.package.package import Package
from checker.source.text import Located, SourceText

if TYPE_CHECKING:
    from checker.source.yaml import YamlDocument

_BRIDGES = ("ros_gz_bridge", "ros_ign_bridge")
_IMAGES = ("ros_gz_image", "ros_ign_image")
_PROGRAM = "parameter_bridge"
_PLUGINS = ("ros_gz_bridge::RosGzBridge", "RosGzBridge")
_INCLUDED = (
    "ros_gz_bridge/launch/ros_gz_bridge.launch",
    "ros_gz_sim/launch/ros_gz_sim.launch",
    "ros_gz_sim/launch/ros_gz_spawn_model.launch",
)
"""Launch files that start a bridge, given a `config_file`."""
_ROS_ARGS = "--ros-args"
_EXPAND = "expand_gz_topic_names"
_LOOSE = re.compile(r"bridge[^/]{0,80}\.ya?ml\Z")
_LOOSE_LIMIT = 50


class Bridges(Record, eq=False):
    """Topics and services that the bridges of a launch file pass.

    Attributes:
        entries: The topics.
        faults: The faults in arguments and files.
        unread: The reasons why some topics are not known.
        files: Paths of the YAML files that are read, as the package lists them.
        services: The services.
    """

    entries: tuple[BridgeEntry, ...] = ()
    faults: tuple[BridgeFault, ...] = ()
    unread: tuple[str, ...] = ()
    files: frozenset[str] = field(default_factory=frozenset)
    services: tuple[BridgedService, ...] = ()

    @property
    def is_there(self) -> bool:
        """True if something is bridged, or was meant to be."""
        return bool(self.entries or self.services or self.faults or self.unread)


class _At(Record, eq=False):
    """Namespace and remaps of a bridge, which its relative names need."""

    namespace: str
    name: str
    remaps: tuple[Remap, ...]
    expands: bool
    node: Node | None

    def entry(self, passed: Passed) -> BridgeEntry:
        """Return what is passed, with the names that both sides know it by."""
        topic = passed.gz_topic.value
        if self.expands:
            topic = f"{self.namespace}/{topic.lstrip('/')}"
        gz_topic = "/" + topic.strip("/") if _is_name(topic) else ""
        ros_topic, remapped = self._resolved(passed.ros_topic.value)
        return BridgeEntry(passed, gz_topic, ros_topic, remapped, self.node)

    def _resolved(self, name: str) -> tuple[str, bool]:
        absolute = resolve_name(name, self.namespace, self.name)
        for remap in self.remaps:
            if resolve_name(remap.source, self.namespace, self.name) == absolute:
                target = resolve_name(remap.target, self.namespace, self.name)
                return (target if _is_name(target) else ""), True
        return (absolute if _is_name(absolute) else ""), False


def _is_name(text: str) -> bool:
    """Return whether a name is known: without substitutions or parts to be replaced."""
    return is_known(text) and not any(mark in text for mark in "${<")


def read_bridges(package: Package, graph: LaunchGraph) -> Bridges:
    """Read the bridges that a launch file starts, those under conditions among them.

    Args:
        package: The package being checked.
        graph: The graph of the launch file.
    """
    reader = _Reader(package)
    for node in graph.nodes:
        reader.node(node)
    for include in graph.includes:
        reader.include(include)
    return reader.bridges()


def bridges_without_launch(package: Package, named: Iterable[str]) -> Bridges:
    """Read files of bridges that no available launch file names.

    Args:
        package: The package being checked.
        named: The files that launch files name.
    """
    from checker.source.yaml import read_yaml

    reader, known = _Reader(package), set(named)
    files = (entry.path for entry in package.index.files if _LOOSE.search(entry.path.lower()))
    for path in islice((path for path in files if path not in known), _LOOSE_LIMIT):
        source = package.read(path)
        if isinstance(source, SourceText) and is_bridge_file(document := read_yaml(source)):
            reader.document(document, _At("/", "", (), False, None))
    # Names depend on the namespace of the reading node.
    found = reader.bridges()
    unknown = tuple(replace(entry, gz_topic="", ros_topic="") for entry in found.entries)
    return replace(found, entries=unknown)


class _Reader:
    def __init__(self, package: Package) -> None:
        self._package = package
        self._entries: list[BridgeEntry] = []
        self._faults: list[BridgeFault] = []
        self._unread: list[str] = []
        self._files: set[str] = set()
        self._services: list[BridgedService] = []

    def bridges(self) -> Bridges:
        return Bridges(
            tuple(self._entries),
            tuple(self._faults),
            tuple(dict.fromkeys(self._unread)),
            frozenset(self._files),
            tuple(self._services),
        )

    def node(self, node: Node) -> None:
        package, executable = node.program
        own, given = _split(node.arguments)
        at = _at(node, given)
        if package in _IMAGES and executable == "image_bridge":
            self._entries += [at.entry(_image(word)) for word in own if _names_topic(word)]
        elif executable in _PLUGINS or (
            package in _BRIDGES and executable in (_PROGRAM, "bridge_node")
        ):
            self._unread += [unread.reason for unread in node.unread]
            for word in own:
                self._argument(word, at)
            self._configured(node.parameters, given, at)

    def include(self, include: Include) -> None:
        """Read the file that an include of the bridge's own launch files is given."""
        target = share_path(include.target.value)
        if target is None or not f"{target.package}/{target.path}".startswith(_INCLUDED):
            return
        given = include.arguments
        if "bridge_params" in given:
            self._unread.append("the bridge gets its parameters from a string")
        if (file := given.get("config_file")) is not None:
            namespace = given["namespace"].value if "namespace" in given else ""
            self.file(file.value, _At(resolve_name(namespace, "/"), "", (), False, None))

    def _argument(self, word: Located[str], at: _At) -> None:
        if word.value.startswith("-"):
            return
        read = read_argument(word)
        if isinstance(read, Passed):
            self._entries.append(at.entry(read))
        elif isinstance(read, BridgedService):
            self._services.append(read)
        elif is_known(word.value):
            self._faults.append(self._with_missing_file(read, word.value))
        else:
            self._unread.append(f"the argument {display_path(word.value)[:80]!r} is not known")

    def _with_missing_file(self, fault: BridgeFault, argument: str) -> BridgeFault:
        """Add to the fault of an argument that is a file that this does not exist."""
        file = named_file(argument)
        if not file or exists(self._package, file) is not False:
            return fault
        return replace(fault, message=f"{fault.message}; {display_path(file)} does not exist")

    def _configured(self, parameters: Parameters, given: dict[str, Located[str]], at: _At) -> None:
        """Read the files that parameters name."""
        for parameter in parameters:
            if isinstance(parameter, ParameterFile):
                self._parameter_file(parameter)
            elif parameter.name == "config_file" and isinstance(parameter.value, str):
                self.file(parameter.value, at)
        if (file := given.get("config_file")) is not None:
            self.file(file.value, at)

    def _parameter_file(self, parameter: ParameterFile) -> None:
        """Report that parameters of a file are not known, if they may name a file of the bridge."""
        source = read_file(self._package, parameter.path)
        if isinstance(source, str) or "config_file" in source.text or "bridge" in source.text:
            self._unread.append(f"parameters of the bridge are in {display_path(parameter.path)}")

    def file(self, path: str, at: _At) -> None:
        if not path:
            return
        from checker.source.yaml import read_yaml

        source = read_file(self._package, path)
        if isinstance(source, str):
            self._unread.append(f"the bridge's file {display_path(path)} is not read: {source}")
            return
        self._files.add(local_file(self._package, path) or source.file)
        self.document(read_yaml(source), at)

    def document(self, document: YamlDocument, at: _At) -> None:
        for item in read_bridge_file(document):
            if isinstance(item, Passed):
                self._entries.append(at.entry(item))
            elif isinstance(item, BridgedService):
                self._services.append(item)
            else:
                self._faults.append(item)
                if item.kind is BridgeFaultKind.UNREADABLE:
                    self._unread.append(f"{document.source.file} is not valid YAML")


def _names_topic(word: Located[str]) -> bool:
    return not word.value.startswith("-") and ":=" not in word.value


def _image(word: Located[str]) -> Passed:
    ros_type, gz_type = (
        Located(text, word.span, stated=False)
        for text in ("sensor_msgs/msg/Image", "gz.msgs.Image")
    )
    return Passed(word, word, ros_type, gz_type, Direction.TO_ROS, word.span)


def _split(
    words: tuple[Located[str], ...],
) -> tuple[list[Located[str]], dict[str, Located[str]]]:
    """Part the words of a command line: the program's own, and parameters behind `--ros-args`."""
    own: list[Located[str]] = []
    given: dict[str, Located[str]] = {}
    for_ros = False
    for word in words:
        if word.value in (_ROS_ARGS, "--"):
            for_ros = word.value == _ROS_ARGS
        elif not for_ros:
            own.append(word)
        else:
            name, assigned, value = word.value.partition(":=")
            if assigned:
                given[name] = Located(value, word.span)
    return own, given


def _at(node: Node, given: dict[str, Located[str]]) -> _At:
    named = [Remap(name, word.value, word.span) for name, word in given.items()]
    name = node.name.value if node.name is not None else "ros_gz_bridge"
    expands = _expands(node.parameters, given)
    return _At(node.namespace, name, (*node.remaps, *named), expands, node)


def _expands(parameters: Parameters, given: dict[str, Located[str]]) -> bool:
    """Return whether the names of Gazebo's topics get the namespace of the node."""
    settings = [p.value for p in parameters if isinstance(p, Parameter) and p.name == _EXPAND]
    settings += [given[_EXPAND].value] if _EXPAND in given else []
    return bool(settings) and str(settings[-1]).lower() not in ("false", "0")
