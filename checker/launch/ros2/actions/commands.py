"""Commands that do the same as a node or an included file.

`gz service -s /world/hall/create --req 'sdf_filename: "rover.sdf", name: "rover"'` spawns as
`create -file rover.sdf -name rover` does, and `ros2 control load_controller --set-state active arm`
starts a controller as `spawner arm` does. `ros2 run` starts a node, `ros2 launch` a launch file.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise, takewhile

from checker.launch.ros2.graph import GAZEBO, Node, Process
from checker.launch.ros2.values import Made, PlacedText
from checker.model.ros_parameters import MANAGER
from checker.source.text import Located

Words = Sequence[Located[str]]

_SHELLS = ("bash", "sh", "/bin/bash", "/bin/sh")
_OPERATORS = ";&|"
_REDIRECTION = re.compile(r"\d?[<>]")
_CLIENTS = (("gz", "service"), ("ign", "service"))
_CREATE = re.compile(r"/create(?:/blocking)?\Z")
_REQUESTS = ("--req", "-r")
_FIELD = re.compile(
    r"""\b(sdf_filename|sdf|name)\s{0,20}:\s{0,20}(?:"((?:[^"\\]|\\.)*)"|'((?:[^'\\]|\\.)*)')"""
)
_OPTIONS = {"sdf_filename": "-file", "sdf": "-string", "name": "-name"}
_RENAMES = re.compile(r"\ballow_renaming\s{0,20}:\s{0,20}(?:true|1)\b")
_MANAGERS = ("-c", "--controller-manager")
_STATE = "--set-state"
_WITH_VALUE = (*_MANAGERS, _STATE, "--spin-time", "--switch-timeout")
_ACTIVE = ("active", "start")
"""The state of a controller that runs; the latter until Galactic."""
_LOADED = (*_ACTIVE, "inactive", "configure")
_ACTIVATE = ("--activate", "--start", "--activate-controllers", "--start-controllers")
_PREFIX = "--launch-prefix"


def commands_of(words: Words, *, as_line: bool) -> Iterator[Words]:
    """Yield the words of each command that a process runs.

    Args:
        words: The words of the process.
        as_line: Whether a shell gets them as one line.
    """
    if len(words) == 3 and words[0].value in _SHELLS and words[1].value.endswith("c"):
        words, as_line = words[2:], True
    if not as_line:
        yield from (words,) if words else ()
        return
    command: list[Located[str]] = []
    for word in words:
        for text in _split(word.value):
            if text.strip(_OPERATORS):
                command.append(Located(text, word.span, stated=word.stated))
            elif command:
                yield command
                command = []
    if command:
        yield command


def _split(line: str) -> list[str]:
    """Return the words and operators of a line for a shell."""
    lexer = shlex.shlex(line, posix=True, punctuation_chars=_OPERATORS)
    lexer.whitespace_split, lexer.commenters = True, ""
    try:
        return [*lexer]
    except ValueError:  # a quotation mark that nothing closes
        return []


def after_ros2(words: Words, verb: str) -> Words:
    """Return the words behind `ros2 VERB` in a command; nothing if it is another one."""
    words = [*takewhile(lambda word: not _REDIRECTION.match(word.value), words)]
    pairs = [*pairwise(word.value for word in words)]
    return words[pairs.index(("ros2", verb)) + 2 :] if ("ros2", verb) in pairs else ()


def run_node(words: Words, process: Process) -> Made | None:
    """Return the action that starts the same node as `ros2 run PACKAGE PROGRAM …`."""
    package, executable, *arguments = after_ros2(words, "run") or (None, None)
    if package is None or executable is None or package.value.startswith("-"):
        return None
    values = {"package": _text(package), "executable": _text(executable)}
    return Made("Node", {**values, "arguments": [*map(_text, arguments)]}, process.span)


def launched_file(words: Words) -> tuple[Words, list[tuple[PlacedText, PlacedText]]]:
    """Return package and file, or the path, of `ros2 launch …`, and the arguments that it gives."""
    given = _operands(after_ros2(words, "launch"), (_PREFIX,))
    pairs = [(word, word.value.partition(":=")) for word in given if ":=" in word.value]
    arguments = [
        (PlacedText(name, word.span), PlacedText(value, word.span))
        for word, (name, _, value) in pairs
    ]
    return [word for word in given if ":=" not in word.value][:2], arguments


def _operands(words: Words, with_value: Collection[str]) -> Words:
    """Return the words that are neither options nor values of those that have one."""
    before = ("", *(word.value for word in words))
    return [
        word
        for word, option in zip(words, before, strict=False)
        if not word.value.startswith("-") and option not in with_value
    ]


def _text(word: Located[str]) -> PlacedText:
    return PlacedText(word.value, word.span)


def same_node(words: Words, process: Process) -> Node | None:
    """Return the node that does the same as a command of another program; None if none does."""
    if any(pair in _CLIENTS for pair in pairwise(word.value for word in words)) and any(
        _CREATE.search(word.value) for word in words
    ):
        asked = (word for option, word in pairwise(words) if option.value in _REQUESTS)
        options = [option for word in asked for option in _options(word)]
        return _node(process, GAZEBO[0], "create", options)
    control = after_ros2(words, "control")
    names = [*_started_controllers(control)]
    if not names:
        return None
    managers = [pair for pair in pairwise(control) if pair[0].value in _MANAGERS]
    return _node(process, MANAGER, "spawner", [*names, *(word for it in managers for word in it)])


def _started_controllers(words: Words) -> Iterator[Located[str]]:
    """Yield the controllers that a command of `ros2 control` starts, as arguments of a spawner."""
    given = _operands(words, _WITH_VALUE)
    match [word.value for word in given]:
        case ["load_controller", _, *_]:
            states = [word.value for option, word in pairwise(words) if option.value == _STATE]
            yield from given[1:2] if states and states[-1] in _LOADED else ()
        case ["set_controller_state", _, state] if state in _ACTIVE:
            yield given[1]
        case ["switch_controllers", *_]:
            group = ""
            for word in words:
                group = word.value if word.value.startswith("-") else group
                if group in _ACTIVATE and word.value != group:
                    yield word


def _options(request: Located[str]) -> Iterator[Located[str]]:
    """Yield the options of `create` that say the same as a request."""
    for name, double, single in _FIELD.findall(request.value):
        yield Located(_OPTIONS[name], request.span)
        yield Located(double or single, request.span)
    if _RENAMES.search(request.value):
        yield Located("-allow_renaming", request.span)


def _node(process: Process, package: str, executable: str, arguments: Words) -> Node:
    return Node(
        package=Located(package, process.span, stated=False),
        executable=Located(executable, process.span, stated=False),
        arguments=tuple(arguments),
        conditions=process.conditions,
        after=process.after,
        exit_of=process.exit_of,
        span=process.span,
    )
