"""Robots that ROS 2 launch files load: the files, and the arguments that xacro is given."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Mapping
from itertools import pairwise

from msgspec.structs import replace

from checker.base.record import Record
from checker.formats.xacro.files import ROOT, path_of
from checker.launch.ros1.launch_file import Load, read_command
from checker.launch.ros2.graph import LaunchGraph, Node, Parameter, is_known, share_path
from checker.launch.ros2.named_paths import is_missing, lies_elsewhere
from checker.launch.ros2.package_files import local_file
from checker.launch.ros2.values import CONTENT, REPLACING
from checker.package.package import Package
from checker.source.text import Span

_COMMAND = "$(command "
_VARIABLE = re.compile(r"\$\(var ([\w.-]{1,200})\)")
_ONE_WORD = re.compile(r"\$\(var:([\w.-]{1,200})\)")
_SUFFIXES = (".urdf", ".xacro", ".xml", ".sdf")


class LoadedDescription(Record, eq=False):
    """A robot that a node is given.

    Attributes:
        load: The file, and the arguments that are known.
        unknown: Names of arguments whose values are only known at launch.
        choices: The values that the launch file allows for these; none if any text is allowed.
        offered: The same of arguments that have the default of one of its own, by name.
        node: The node that gets it.
        parameter: The parameter that contains it; None if it is among the arguments.
        span: The place where the file is named.
        replacing: Whether the launch file replaces parts of the text of the file.
        misplaced: Whether the file is not at the path that the launch file names.
    """

    load: Load
    unknown: tuple[str, ...]
    choices: Mapping[str, tuple[str, ...]]
    offered: Mapping[str, tuple[str, ...]]
    node: Node
    parameter: Parameter | None
    span: Span
    replacing: bool = False
    misplaced: bool = False


def loaded_descriptions(package: Package, graph: LaunchGraph) -> Iterator[LoadedDescription]:
    """Yield the robots that a launch file loads, those that start by default first.

    Args:
        package: The package being checked.
        graph: The graph of its launch file.
    """
    allowed = {a.name: a.choices for a in graph.arguments if a.choices and a.default is None}
    defaults = {a.name: a for a in graph.arguments if a.choices and a.default is not None}
    for node in sorted(graph.nodes_and_spawns, key=lambda node: _RANKS[node.starts]):
        for text, parameter, span in _texts(node):
            for load, given, misplaced in _described(package, text):
                choices = {
                    name: allowed[variable[1]]
                    for name, value in given.items()
                    if (variable := _ONE_WORD.fullmatch(value)) and variable[1] in allowed
                }
                offered = {
                    name: own.choices
                    for name, value in load.args.items()
                    if (own := defaults.get(name)) and own.default and own.default.value == value
                }
                replacing = text.endswith(f"{REPLACING})")
                yield LoadedDescription(
                    load,
                    tuple(given),
                    choices,
                    offered,
                    node,
                    parameter,
                    span,
                    replacing,
                    misplaced,
                )


def _texts(node: Node) -> Iterator[tuple[str, Parameter | None, Span]]:
    """Yield the texts of a node that may contain a description, and where they are."""
    for parameter in node.parameters:
        if isinstance(parameter, Parameter) and isinstance(parameter.value, str):
            yield parameter.value, parameter, parameter.span
    for option, word in pairwise(node.arguments):
        yield f"{CONTENT}{word.value})" if option.value == "-file" else word.value, None, word.span


_RANKS = {True: 0, None: 1, False: 2}


def _described(package: Package, text: str) -> Iterator[tuple[Load, dict[str, str], bool]]:
    """Yield the file of a text, the arguments that are not known, and whether it is elsewhere."""
    if text.startswith(_COMMAND) and text.endswith(")"):
        command = text.removeprefix(_COMMAND)[:-1]
        for load in read_command(command):
            path, misplaced = _as_listed(package, load.path)
            if path is not None:
                yield replace(load, path=path), _unknown(command), misplaced
    elif text.startswith(CONTENT) and text.endswith(")"):
        named = text.removeprefix(CONTENT)[:-1].removesuffix(REPLACING)
        path, misplaced = _as_listed(package, named)
        if path is not None and path.lower().endswith(_SUFFIXES):
            yield Load(path, {}, by_xacro=False), {}, misplaced


def _as_listed(package: Package, path: str) -> tuple[str | None, bool]:
    """Return how xacro sees a file that is installed at a path, and whether it is elsewhere.

    One that is not installed there is the only file of that name in its package: LCH001 says so.
    The path is None if it is not available.
    """
    target = share_path(path)
    if target is None:
        return None, False
    local, misplaced = local_file(package, path), False
    if local is None and is_missing(package, target):
        local = local_file(package, f"{ROOT}/{target.package}/{lies_elsewhere(package, target)}")
        misplaced = True
    return None if local is None else path_of(package, local), misplaced


def _unknown(command: str) -> dict[str, str]:
    """Return the arguments with substitutions in their values; `$(var x)` as `$(var:x)`."""
    try:
        words = shlex.split(_VARIABLE.sub(r"$(var:\1)", command))
    except ValueError:  # a quotation mark that nothing closes
        return {}
    parts = (word.partition(":=") for word in words)
    return {name: value for name, assigned, value in parts if assigned and not is_known(value)}
