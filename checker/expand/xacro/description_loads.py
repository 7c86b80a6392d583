"""What launch files load as `robot_description`: which file, and with which arguments."""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Mapping
from itertools import pairwise

from checker.base.record import Record
from checker.expand.launch.graph import LaunchGraph
from checker.expand.launch.substitution import is_known
from checker.expand.xacro.paths import ROOT

_FIND = re.compile(r"\$\(find\s{1,8}([\w.-]{1,200})\s{0,8}\)")
_SUFFIXES = (".urdf", ".xacro", ".xml")
_COMMAND_LIMIT = 4_000
"""Characters of a command that is read."""


class Load(Record):
    """A file that a launch file loads.

    Attributes:
        path: As xacro sees it.
        args: Arguments that xacro is given.
        by_xacro: Whether xacro reads it; otherwise it is loaded as it stands.
    """

    path: str
    args: Mapping[str, str]
    by_xacro: bool


def loads(graph: LaunchGraph) -> Iterator[Load]:
    """Yield what a launch file loads into parameters, or hands to a node with `-file`."""
    for param in graph.params:
        if param.kind == "command":
            yield from read_command(param.value)
        elif param.kind == "textfile":
            yield from _plain(param.value)
    for node in graph.nodes:
        words = _words(node.args)
        for option, value in pairwise(words):
            if option == "-file":
                yield from _plain(value)


def read_command(command: str) -> Iterator[Load]:
    """Yield the file that a command prints: `xacro FILE arg:=value`, or `cat FILE`."""
    program, *words = _words(command) or [""]
    file = next((word for word in words if _is_description(word)), None)
    if file is None:
        return
    pairs = (word.partition(":=") for word in words)
    args = {name: value for name, assigned, value in pairs if assigned and is_known(value)}
    tools = {each.rpartition("/")[2].removesuffix(".py") for each in (program, *words)}
    yield Load(file, args, by_xacro="xacro" in tools)


def _plain(text: str) -> Iterator[Load]:
    file = _placed(text.strip())
    if _is_description(file):
        yield Load(file, {}, by_xacro=False)


def _is_description(word: str) -> bool:
    return word.startswith(f"{ROOT}/") and word.lower().endswith(_SUFFIXES)


def _words(command: str) -> list[str]:
    try:
        return shlex.split(_placed(command[:_COMMAND_LIMIT]))
    except ValueError:  # a quotation mark that nothing closes
        return []


def _placed(text: str) -> str:
    return _FIND.sub(lambda found: f"{ROOT}/{found[1]}", text)
