"""The Gazebo servers that ROS 2 launch files start, and the worlds that they load."""

from __future__ import annotations

import posixpath
import shlex
from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.formats.sdf.includes import ModelIncludes
from checker.formats.sdf.world import read_worlds
from checker.launch.ros2.graph import (
    CLASSIC_PACKAGE,
    GAZEBO,
    SHARE,
    Include,
    LaunchGraph,
    Node,
    Parameter,
    Process,
    is_known,
    share_path,
)
from checker.launch.ros2.package_files import local_file
from checker.model.world import World
from checker.package.package import Package
from checker.ros.resource_path import resource_path
from checker.source.text import Located, Span
from checker.source.xml import XmlDocument

_STARTS_SERVER = ("gz_sim.launch", "gz_server.launch", "ign_gazebo.launch", "ros_gz_sim.launch")
_STARTS_WINDOW = "gz_gui.launch"
"""Launch files of Gazebo's own packages that start it; all but the last one load a world."""
_SERVERS = ("gzserver", "ros_gz_sim::GzServer")
_WORLD_FILE = "world_sdf_file"
_COMMANDS = (("gz", "sim"), ("ign", "gazebo"))
CLASSIC_COMMANDS = ("gzserver", "gazebo")
_STARTS_CLASSIC = ("gazebo.launch", "gzserver.launch")
_WORLD_SUFFIXES = (".sdf", ".world")
_EMPTY = "empty.sdf"
"""A world of Gazebo's own."""
_ENGINE = "--physics-engine"
_UNKNOWN = "the world is not known"


class GazeboServer(Record, eq=False):
    """A start of Gazebo.

    Attributes:
        span: The place where its world is named, else if it is started.
        starts: Whether it counts with the defaults of all arguments; None if not known.
        worlds: The worlds that it loads.
        own_world: The file of Gazebo's own that it loads; else empty.
        unknown: The reason why its world is not known; else empty.
        engine: The physics engine that its command line names; else empty.
    """

    span: Span
    starts: bool | None
    worlds: tuple[World, ...] = ()
    own_world: str = ""
    unknown: str = ""
    engine: str = ""


def read_servers(package: Package, graph: LaunchGraph) -> Iterator[GazeboServer]:
    """Yield the servers that a launch file starts; those that a condition leaves out are none.

    Args:
        package: The package being checked.
        graph: The graph of the launch file.
    """
    for include in graph.includes:
        if is_gazebo_include(include) and include.starts is not False:
            yield from _included(package, graph, include)
    for process in graph.processes:
        if is_gazebo(process) and process.starts is not False:
            words, span = process.words[2:], process.span
            yield from _commanded(package, graph, words, span, process.starts)
    for node in graph.nodes:
        server = node.package.value in GAZEBO and node.executable.value in _SERVERS
        if server and node.starts is not False:
            yield _server_of_node(package, graph, node)


def is_gazebo(process: Process) -> bool:
    """Return whether a command starts Gazebo."""
    return tuple(word.value for word in process.words[:2]) in _COMMANDS


def is_gazebo_include(include: Include) -> bool:
    """Return whether an include is one of the launch files that start Gazebo."""
    return _file(include).startswith((*_STARTS_SERVER, _STARTS_WINDOW))


def starts_classic(graph: LaunchGraph) -> bool:
    """Return whether a launch file certainly starts Gazebo Classic."""
    commands = (each for each in graph.processes if each.words[:1] and each.starts is True)
    return includes_classic(graph) or any(
        process.words[0].value in CLASSIC_COMMANDS for process in commands
    )


def includes_classic(graph: LaunchGraph) -> bool:
    """Return whether a launch file of gazebo_ros starts it, which reads `<gazebo_ros>`."""
    started = (share_path(it.target.value) for it in graph.includes if it.starts is True)
    return any(
        found.package == CLASSIC_PACKAGE
        and found.path.rpartition("/")[2].startswith(_STARTS_CLASSIC)
        for found in started
        if found is not None
    )


def _file(include: Include) -> str:
    """Return the name of an included launch file of Gazebo's own; empty for any other."""
    found = share_path(include.target.value)
    if found is None or found.package not in GAZEBO:
        return ""
    return found.path.rpartition("/")[2]


def _included(package: Package, graph: LaunchGraph, include: Include) -> Iterator[GazeboServer]:
    if _file(include).startswith(_STARTS_WINDOW):
        return
    words = [*_words(include.arguments)]
    span = next((word.span for word in words if _is_world(word)), include.span)
    yield from _commanded(package, graph, words, span, include.starts)


def _words(arguments: Mapping[str, Located[str]]) -> Iterator[Located[str]]:
    for name in ("gz_args", "ign_args", _WORLD_FILE):
        if name in arguments:
            given = arguments[name]
            try:
                words = shlex.split(given.value)
            except ValueError:  # a quotation mark that nothing closes
                return
            yield from (Located(word, given.span) for word in words)


def _is_world(word: Located[str]) -> bool:
    return word.value.lower().endswith(_WORLD_SUFFIXES)


def _commanded(
    package: Package,
    graph: LaunchGraph,
    words: Sequence[Located[str]],
    span: Span,
    starts: bool | None,
) -> Iterator[GazeboServer]:
    """Yield the server of a command line; `-g` starts a window alone."""
    if any(word.value == "-g" for word in words):
        return
    named = [word for word in words if _is_world(word)]
    texts = [word.value for word in words]
    engine = texts[texts.index(_ENGINE) + 1] if _ENGINE in texts[:-1] else ""
    server = _loading(package, graph, named[0].value if named else "", span, starts)
    yield replace(server, engine=engine)


def _server_of_node(package: Package, graph: LaunchGraph, node: Node) -> GazeboServer:
    """Return the server that a node is, by its parameters."""
    given = [it for it in node.parameters if isinstance(it, Parameter) and it.name == _WORLD_FILE]
    last = given[-1] if given else None
    if last is None or not isinstance(last.value, str):
        return GazeboServer(node.span, node.starts, unknown=_UNKNOWN)
    return _loading(package, graph, last.value, last.span, node.starts)


def _loading(
    package: Package, graph: LaunchGraph, path: str, span: Span, starts: bool | None
) -> GazeboServer:
    if path == _EMPTY:
        return GazeboServer(span, starts, own_world=path)
    local = _found(package, graph, path) if path and is_known(path) else None
    document = package.xml(local) if local is not None else None
    if not isinstance(document, XmlDocument):
        return GazeboServer(span, starts, unknown=_UNKNOWN)
    worlds = tuple(read_worlds(document, ModelIncludes(package)))
    return GazeboServer(span, starts, worlds)


def _found(package: Package, graph: LaunchGraph, path: str) -> str | None:
    """Return a world as the package lists it: at its path, or below the resource path."""
    if posixpath.isabs(path):
        return local_file(package, path)
    folders = (it.folder for it in resource_path(package, graph).folders if it.folder)
    found = (local_file(package, posixpath.join(SHARE, folder, path)) for folder in folders)
    return next(filter(None, found), None)
