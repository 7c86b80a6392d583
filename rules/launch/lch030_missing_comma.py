"""Two arguments that Python joins to one, since the comma between them is missing.

`['gzserver', '--verbose' '-s', 'libgazebo_ros_init.so']` has the words `--verbose-s` and
`libgazebo_ros_init.so`: the program ends at an option that it does not have, or ignores it together
with the value that follows.

It is reported for string literals side by side in `cmd` and `arguments`, if the second is an
option, or the first is one and the second its value. A long text over several lines is not
reported where the joint has a space, `=`, `:` or `,`.

Fix: write the comma. If one word is meant, write it as one literal.
Source: Python language reference, "String literal concatenation".
"""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from itertools import pairwise

from checker.launch.ros2.graph import LaunchGraph, Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_OPTION = re.compile(r"--?[A-Za-z](?:[\w-]*\w)?")
_CONTINUED = (" ", "\t", "\n", "=", ":", ",", "-", "/")
"""Ends of a text, or its starts, that another one goes on with."""
_BLANK = {tokenize.NL, tokenize.NEWLINE, tokenize.COMMENT, tokenize.ENDMARKER}


@rule("LCH030", "missing-comma", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report words of command lines that two literals make, one of them an option."""
    for graph in launch.entries:
        for word in _words(graph):
            for first, second in pairwise(_literals(word)):
                if _are_two(first, second):
                    yield finding(
                        word,
                        f"the program gets {word.value!r} as one argument, since no comma is "
                        f"between the literals: write {first!r}, {second!r}",
                    )


def _words(graph: LaunchGraph) -> Iterator[Located[str]]:
    for node in graph.nodes:
        yield from node.arguments
    for process in graph.processes:
        yield from process.words


def _literals(word: Located[str]) -> list[str]:
    """Return the values of the string literals that a word of a launch file in Python is made of.

    Nothing if it is made of anything else, such as an f-string.
    """
    if not word.span.source.file.endswith(".py"):
        return []
    try:
        tokens = [*tokenize.generate_tokens(io.StringIO(f"({word.span.text})").readline)]
        written = [it for it in tokens if it.type not in _BLANK][1:-1]
        if any(it.type != tokenize.STRING for it in written):
            return []
        values = [ast.literal_eval(it.string) for it in written]
    except (tokenize.TokenError, SyntaxError, ValueError):
        return []
    return [value for value in values if isinstance(value, str)]


def _are_two(first: str, second: str) -> bool:
    """Return whether two literals are meant as an option and another argument."""
    if first.endswith(_CONTINUED) or not first or not second:
        return False
    if _OPTION.match(second):
        return True
    return _OPTION.fullmatch(first) is not None and not second.startswith((*_CONTINUED, ".", "_"))


_CREATE = "        Node(package='ros_gz_sim', executable='create', arguments=[@]),"
_COMMAND = "        ExecuteProcess(cmd=['gz', 'sim', @]),"
_MARK = "  # ^ LCH030"


def _started(words: str, start: str = _CREATE, mark: str = "") -> dict[str, object]:
    return {"@ros2": f"{start.replace('@', words)}{mark}"}


GOOD = [
    _started("'-name', 'arm'"),
    _started("'-string', '<sdf>' '</sdf>'"),
    _started("'-file', '/models/' 'arm.sdf'"),
    _started("'--world=' '-'"),
    _started("'-r -v 4 ' '--headless-rendering'", _COMMAND),
    _started("f'-r' '-s'", _COMMAND),
]
BAD = [
    _started("'-name' 'arm'", mark=_MARK),
    _started("'-name', 'arm' '-z', '0.5'", mark=_MARK),
    _started("'-r' \"-s\"", _COMMAND, _MARK),
    {
        "@ros2": """        ExecuteProcess(cmd=['gz', 'sim', '--verbose'  # ^ LCH030
                            '-s', 'empty.sdf']),"""
    },
]
