"""Commands that put a model into Gazebo, read as the node that does the same.

`gz service -s /world/hall/create --req 'sdf_filename: "rover.sdf", name: "rover"'` spawns as
`create -file rover.sdf -name rover` does.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence
from itertools import pairwise

from checker.launch.ros2.graph import GAZEBO, Node, Process
from checker.source.text import Located

_SHELLS = ("bash", "sh", "/bin/bash", "/bin/sh")
_CLIENTS = (("gz", "service"), ("ign", "service"))
_CREATE = re.compile(r"/create(?:/blocking)?\Z")
_REQUESTS = ("--req", "-r")
_FIELD = re.compile(
    r"""\b(sdf_filename|sdf|name)\s{0,20}:\s{0,20}(?:"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)')"""
)
_OPTIONS = {"sdf_filename": "-file", "sdf": "-string", "name": "-name"}
_RENAMES = re.compile(r"\ballow_renaming\s{0,20}:\s{0,20}(?:true|1)\b")


def spawning_node(process: Process, *, as_line: bool) -> Node | None:
    """Return the node that puts the same model into Gazebo; None if a command puts none there.

    Args:
        process: The command.
        as_line: Whether a shell gets its words as one line.
    """
    words = [*_words(process.words, as_line=as_line)]
    pairs = [*pairwise(word.value for word in words)]
    for start, pair in enumerate(pairs):
        if pair[0] in GAZEBO and pair[1] == "create":
            return _node(process, words[start + 2 :])
        if pair in _CLIENTS and any(_CREATE.search(word.value) for word in words[start:]):
            asked = (word for option, word in pairwise(words) if option.value in _REQUESTS)
            return _node(process, [option for word in asked for option in _options(word)])
    return None


def _words(words: Sequence[Located[str]], *, as_line: bool) -> Iterator[Located[str]]:
    """Yield the words of a command, those of a line for a shell each on its own."""
    if len(words) == 3 and words[0].value in _SHELLS and words[1].value.endswith("c"):
        words, as_line = words[2:], True
    for word in words:
        try:
            inner = shlex.split(word.value) if as_line else [word.value]
        except ValueError:  # a quotation mark that nothing closes
            inner = []
        yield from (Located(text, word.span, stated=word.stated) for text in inner)


def _options(request: Located[str]) -> Iterator[Located[str]]:
    """Yield the options of `create` that say the same as a request."""
    for name, double, single in _FIELD.findall(request.value):
        yield Located(_OPTIONS[name], request.span)
        yield Located(double or single, request.span)
    if _RENAMES.search(request.value):
        yield Located("-allow_renaming", request.span)


def _node(process: Process, arguments: Sequence[Located[str]]) -> Node:
    return Node(
        package=Located(GAZEBO[0], process.span, stated=False),
        executable=Located("create", process.span, stated=False),
        arguments=tuple(arguments),
        conditions=process.conditions,
        after=process.after,
        span=process.span,
    )
