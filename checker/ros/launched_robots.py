"""The robot that a launch file of ROS 1 describes or spawns, also that of another package."""

from __future__ import annotations

from collections.abc import Iterator

from checker.formats.urdf.reader import read_urdf
from checker.formats.xacro.expansion import Expander, Expansions, Wanted
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.package_launch import LaunchFiles
from checker.launch.ros1.substitution import is_known
from checker.model.robot import Robot
from checker.package.package import Package
from checker.ros.control.nodes import read_model
from checker.ros.robot_description import robot_descriptions
from checker.source.xml import XmlDocument

_SUFFIXES = (".urdf", ".xacro")


def launched_robot(package: Package, graph: LaunchGraph, expander: Expander) -> Robot | None:
    """Return the robot of a launch file; None if it has several, or it cannot be read.

    Args:
        package: The package being checked.
        graph: The graph of the launch file.
        expander: What expands xacro.
    """
    wanted = {it.path: it for it in _wanted(package, graph)}
    if len(wanted) != 1:
        return None
    (outcome,) = Expansions(package, [*wanted.values()], expander).outcomes()
    if not isinstance(outcome, XmlDocument) or outcome.root.tag != "robot":
        return None
    return read_urdf(outcome)


def _wanted(package: Package, graph: LaunchGraph) -> Iterator[Wanted]:
    files = LaunchFiles(package)
    for description in robot_descriptions(graph):
        known = {k: v for k, v in description.arguments.items() if is_known(v)}
        for file in description.files:
            path = files.path_of(f"$(find {file.package})/{file.path}" if file.package else "")
            local = file.path if not file.package else path
            if local is not None and local.endswith(_SUFFIXES):
                yield Wanted(local, known)
    for model in map(read_model, graph.nodes):
        named = model.options.get("-file") if model is not None else None
        path = files.path_of(named.value) if named is not None else None
        if path is not None and path.endswith(_SUFFIXES):
            yield Wanted(path, {})
