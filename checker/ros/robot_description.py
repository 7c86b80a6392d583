"""The robot's description: the parameter `robot_description`, and the command that makes it."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.launch.ros1.graph import LaunchGraph, Param
from checker.launch.ros1.launch_file import target_of
from checker.source.text import Span
from checker.source.xml import Element, XmlDocument

NAME = "robot_description"
_WORD = re.compile(r"""'([^']*)'|"([^"]*)"|((?:\$\([^()]*\)|[^\s'"])+)""")
_COMPUTED = re.compile(r"\$\([^()]*\)/?|\$\{[^{}]*\}/")
"""Possible start of a name: `$(arg prefix)`, `${name}/`; `${side}_wheel` is computed whole."""


class DescriptionFile(Record):
    """A file that the command names.

    Attributes:
        package: The package of `$(find …)`; empty for a path from the package's own folder.
        path: Within that package.
    """

    package: str
    path: str


class RobotDescription(Record, eq=False):
    """A parameter that contains the robot's description.

    Attributes:
        param: The parameter.
        files: Files that the command names by `$(find …)` or `$(dirname)`, its program among them
            unless that belongs to another package.
        arguments: The arguments that it passes as `name:=value`.
        uses_xacro: Whether the command runs xacro.
    """

    param: Param
    files: tuple[DescriptionFile, ...]
    arguments: Mapping[str, str]
    uses_xacro: bool

    @property
    def span(self) -> Span:
        """The start tag of the parameter."""
        return self.param.span

    @property
    def namespace(self) -> str:
        """Namespace before `robot_description`: `/X1`, or `/`."""
        return posixpath.dirname(self.param.name)


def robot_descriptions(launch: LaunchGraph) -> list[RobotDescription]:
    """Return the descriptions that a launch graph sets, private ones of nodes left out."""
    private = {node.full_name for node in launch.nodes}
    return [
        _description(param)
        for param in launch.params
        if posixpath.basename(param.name) == NAME and posixpath.dirname(param.name) not in private
    ]


def _description(param: Param) -> RobotDescription:
    if param.kind != "command":
        files = _files([param.value]) if param.kind in ("textfile", "load") else ()
        return RobotDescription(param, tuple(files), {}, uses_xacro=False)
    words = [next(filter(None, match.groups()), "") for match in _WORD.finditer(param.value)]
    arguments: dict[str, str] = {}
    named = []
    for word in words:
        name, assigned, value = word.partition(":=")
        if assigned:
            arguments[name] = value
        else:
            named.append(word)
    programs = {posixpath.basename(word) for word in named}
    uses_xacro = bool(programs & {"xacro", "xacro.py"})
    return RobotDescription(param, tuple(_files(named)), arguments, uses_xacro)


def _files(words: list[str]) -> Iterator[DescriptionFile]:
    for word in words:
        package, path = target_of(word)
        if not package and path.startswith("../"):
            package, _, path = path.removeprefix("../").partition("/")
        if path and package != "xacro":
            yield DescriptionFile(package, path)


def fixed_frames(document: XmlDocument) -> dict[str, Element]:
    """Return the links that fixed joints of a URDF or xacro file attach, by name.

    Names that only xacro can compute are left out, prefixes such as `$(arg prefix)` are cut.
    """
    frames: dict[str, Element] = {}
    for joint in document.root.descendants("joint"):
        child = joint.child("child")
        if joint.get("type") != "fixed" or child is None:
            continue
        name = _plain(child.get("link") or "")
        if name:
            frames.setdefault(name, joint)
    return frames


def _plain(name: str) -> str:
    """Return a name without the prefix that xacro computes; empty when more is computed."""
    at = 0
    while match := _COMPUTED.match(name, at):
        at = match.end()
    rest = name[at:]
    return "" if "$" in rest else rest.rpartition("/")[2]
