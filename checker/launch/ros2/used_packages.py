"""Packages that the ROS 2 launch files of a package use: each is needed where they are launched."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.launch.ros2.graph import (
    LaunchGraph,
    NodeKind,
    Parameter,
    ParameterFile,
    Ros2Launch,
    is_known,
    share_path,
)
from checker.launch.ros2.package_launch import built_by_ament
from checker.package.dependencies import Use, uses_in_build, uses_in_ros2, uses_of
from checker.package.package import Package
from checker.source.text import Span

_COMMAND = "$(command xacro "
_READS = (_COMMAND, "$(file-content ")
_OF_MOVEIT = ".setup_assistant"
"""What MoveItConfigsBuilder looks for in the package of its configuration, there or not."""
_XACRO = re.compile(r"(?<![.\w])xacro\b")
"""The program, and no suffix: what reads a MoveIt configuration runs xacro by itself."""
_WORD = re.compile(r"[\w-]{1,200}")


def every_use(package: Package, launch: Ros2Launch | None) -> Iterator[Use]:
    """Yield all packages that a package uses, whether it is of ROS 1 or of ROS 2."""
    ament = built_by_ament(package)
    if ament:
        yield from uses_in_build(package)
    yield from uses_of(package, of_ros_1=not ament)
    if launch is not None:
        yield from used_packages(launch)
    if ament:
        yield from uses_in_ros2(package)


def used_packages(launch: Ros2Launch) -> Iterator[Use]:
    """Yield the packages of nodes, components, included files and paths, in the package's files.

    What a condition leaves out is among them; what other packages' files use is theirs to declare.
    """
    for graph in launch.entries:
        for name, span, how, path in _package_names(graph):
            if name and is_known(name) and not span.source.file.startswith("../"):
                yield Use(name, span.place(), how, path)


def _package_names(graph: LaunchGraph) -> Iterator[tuple[str, Span, str, str]]:
    for node in graph.nodes:
        what = "component" if node.kind is NodeKind.COMPONENT else "node"
        yield node.package.value, node.package.span, f"{what} {node.executable.value}", ""
        for parameter in node.parameters:
            yield from _of_parameter(parameter)
    paths = [include.target for include in graph.includes] + [use.text for use in graph.files]
    for text in paths:
        yield from _of_path(text.value, text.span)


def _of_parameter(parameter: Parameter | ParameterFile) -> Iterator[tuple[str, Span, str, str]]:
    if isinstance(parameter, ParameterFile):
        yield from _of_path(parameter.path, parameter.span)
        return
    text = parameter.value if isinstance(parameter.value, str) else ""
    if text.startswith(_COMMAND) and _XACRO.search(parameter.span.source.text):
        yield "xacro", parameter.span, "command xacro", ""
    for word in text.split() if text.startswith(_READS) else ():
        yield from _of_path(word.rstrip(")"), parameter.span)


def _of_path(text: str, span: Span) -> Iterator[tuple[str, Span, str, str]]:
    if (path := share_path(text)) is not None:
        how = "its MoveIt configuration" if path.path == _OF_MOVEIT else f"file {path.path}"
        yield path.package, _naming(path.package, span), how, path.path


def _naming(package: str, span: Span) -> Span:
    """Return the place of a package's name in the text of a span; the span if it is not there."""
    words = _WORD.finditer(span.text)
    found = next((it for it in words if it.group() == package), None)
    if found is None:
        return span
    return Span(span.source, span.start + found.start(), span.start + found.end(), span.holder)
