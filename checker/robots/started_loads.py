"""Robots that launch files load: those of the package, and those of others that name it."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from msgspec.structs import replace

from checker.formats.xacro.files import local_path, path_of
from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.launch_file import loads
from checker.launch.ros1.package_launch import SAMPLE_ARGUMENTS, LaunchFiles
from checker.launch.ros2.graph import LaunchGraph, Ros2Launch
from checker.launch.ros2.package_launch import is_ros2_only, launches_naming
from checker.package.mentions import has_word
from checker.package.package import Package
from checker.robots.candidates import StartedLoad
from checker.robots.other_robots import TRIED_LIMIT
from checker.robots.shown_only import SPAWNS
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_LAUNCH_SUFFIXES = (".launch", ".launch.xml")
_LAUNCH_LIMIT = 100
_LOADS = re.compile(r"\.(?:urdf|xacro)\b|robot_description")


def started_loads(package: Package, ros2: Ros2Launch | None) -> Iterator[StartedLoad]:
    """Yield what launch files load; those of the package come first, then others of ROS 2.

    Of both, those that spawn a robot in a simulator come before those for RViz or hardware. Last
    come the files that other choices of arguments lead to.

    Args:
        package: The package being checked.
        ros2: What its own launch files of ROS 2 start, if it has any.
    """
    graphs = sorted(ros2.entries if ros2 is not None else (), key=_spawns, reverse=True)
    own = [(graph, load) for graph in graphs for load in _loaded(package, graph, "")]
    theirs = [
        (graph, load)
        for other, graph in sorted(
            launches_naming(package), key=lambda it: _spawns(it[1]), reverse=True
        )
        for load in _loaded(other, graph, f"../{other.name}/")
    ]
    yield from (load for _, load in own)
    yield from _classic_loads(package)
    yield from (load for _, load in theirs)
    yield from _plain_loads_of_others(package)
    others = (each for pair in (*own, *theirs) for each in _of_other_choices(package, *pair))
    yield from islice({each.load.path: each for each in others}.values(), TRIED_LIMIT)


def _spawns(graph: LaunchGraph) -> bool:
    return any(node.executable.value in SPAWNS for node in graph.nodes_and_spawns)


def _loaded(package: Package, graph: LaunchGraph, folder: str) -> Iterator[StartedLoad]:
    from checker.launch.ros2.descriptions import loaded_descriptions

    for described in loaded_descriptions(package, graph):
        missing = dict.fromkeys(described.unknown, f"{folder}{described.node.file}")
        allowed = described.choices, described.offered
        yield StartedLoad(
            described.load, True, missing, *allowed, _spawns(graph), described.misplaced
        )


def _of_other_choices(
    package: Package, graph: LaunchGraph, started: StartedLoad
) -> Iterator[StartedLoad]:
    """Yield what is loaded if a path contains the default of an argument that has choices."""
    path = local_path(package, started.load.path) or ""
    for argument in graph.arguments:
        default = argument.default.value if argument.default is not None else ""
        for choice in argument.choices if default else ():
            other = path.replace(default, choice)
            if other != path and package.exists(other):
                load = replace(started.load, path=path_of(package, other))
                yield replace(started, load=load)


def _classic_loads(package: Package, name: str = "") -> list[StartedLoad]:
    """Return what launch files of ROS 1 load; with a name only those that contain this word."""
    launch_files = package.index.with_suffix(*_LAUNCH_SUFFIXES)[:_LAUNCH_LIMIT]
    paths = [file.path for file in launch_files if _loads_something(package, file.path, name)]
    files, documents = LaunchFiles(package), map(package.xml, paths)
    runs = not is_ros2_only(package)
    return [
        StartedLoad(load, runs, dict.fromkeys(load.unknown, document.source.file))
        for document in documents
        if isinstance(document, XmlDocument)
        for load in loads(expand_launch(document, SAMPLE_ARGUMENTS, files))
    ]


def _plain_loads_of_others(package: Package) -> Iterator[StartedLoad]:
    """Yield the files of a package that launch files of ROS 1 of others load as they are."""
    name = package.declared_name
    found = [load for other in package.other_packages for load in _classic_loads(other, name)]
    expanded = {it.load.path for it in found if it.load.by_xacro}
    yield from (it for it in found if it.load.as_it_is and it.load.path not in expanded)


def _loads_something(package: Package, path: str, name: str) -> bool:
    source = package.read(path)
    if not isinstance(source, SourceText) or _LOADS.search(source.text) is None:
        return False
    return not name or has_word(source.text, name)
