"""The calls that a CMake file makes: variables put in, loops over words unrolled.

What is inside `if()` is marked conditional. What is not known, such as
`${CATKIN_PACKAGE_SHARE_DESTINATION}`, is kept as written.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.source.cmake_tokens import Argument, ArgumentKind, CMakeFault, Command
from checker.source.text import Located, Span

MAX_STEPS = 20_000
MAX_DEPTH = 20
MAX_LENGTH = 10_000
WORDS_PER_STEP = 10
CHARACTERS_PER_STEP = 1000
_REFERENCE = re.compile(r"(?<!\\)\$\{([^${}]*)\}")
_HERE = ("CMAKE_SOURCE_DIR", "CMAKE_CURRENT_SOURCE_DIR", "CMAKE_CURRENT_LIST_DIR")
_BLOCKS = {
    "if": "endif",
    "while": "endwhile",
    "function": "endfunction",
    "macro": "endmacro",
    "foreach": "endforeach",
}


class Call(Record, eq=False):
    """A command with its variables put in.

    Attributes:
        name: The name in lower case.
        arguments: Words after expansion; each knows the argument it comes from.
        conditional: Whether it is inside `if()`, a loop that is not unrolled, or a function.
        span: The whole call.
    """

    name: str
    arguments: tuple[Located[str], ...]
    conditional: bool
    span: Span


def evaluate(commands: Sequence[Command], faults: list[CMakeFault]) -> tuple[Call, ...]:
    """Return the calls in order; faults are added to `faults`."""
    evaluation = _Evaluation(commands, faults)
    evaluation.run(0, len(commands), conditional=False)
    return tuple(evaluation.calls)


class _Evaluation:
    """Runs commands in order, with the variables that the file sets."""

    def __init__(self, commands: Sequence[Command], faults: list[CMakeFault]) -> None:
        self.calls: list[Call] = []
        self._commands = commands
        self._faults = faults
        self._ends = _block_ends(commands, faults)
        self._variables: dict[str, str] = dict.fromkeys(_HERE, ".")
        self._steps = MAX_STEPS
        self._ended = False

    def run(self, start: int, end: int, *, conditional: bool, depth: int = 0) -> None:
        """Run the commands from `start` up to, not including, `end`."""
        unsure: list[int] = []
        index = start
        while index < end and self._steps > 0:
            self._steps -= 1
            command = self._commands[index]
            name = command.name.value
            while unsure and index >= unsure[-1]:
                unsure.pop()
            block_end = self._ends.get(index)
            if name == "foreach" and block_end is not None:
                self._loop(index, block_end, conditional=conditional or bool(unsure), depth=depth)
                index = block_end
            else:
                if block_end is not None:
                    unsure.append(block_end)
                self._call(command, conditional=conditional or bool(unsure))
            index += 1
        if self._steps <= 0 and not self._ended:
            self._ended = True
            span = self._commands[start].span
            self._faults.append(CMakeFault(span, f"takes more than {MAX_STEPS} steps to evaluate"))

    def _call(self, command: Command, *, conditional: bool) -> None:
        words = tuple(self._words(command.arguments))
        self._steps -= (len(command.arguments) + len(words)) // WORDS_PER_STEP
        self._steps -= sum(len(word.value) + 1 for word in words) // CHARACTERS_PER_STEP
        call = Call(command.name.value, words, conditional, command.span)
        self.calls.append(call)
        if not words:
            return
        first, *others = (word.value for word in words)
        if call.name == "project":
            self._variables |= {"PROJECT_NAME": first, "CMAKE_PROJECT_NAME": first}
            self._variables["PROJECT_SOURCE_DIR"] = "."
        elif call.name == "set":
            values = others[: others.index("CACHE")] if "CACHE" in others else others
            self._assign(first, ";".join(values), conditional=conditional)
        elif call.name == "list" and first == "APPEND" and others:
            before = self._variables.get(others[0], "")
            values = [before, *others[1:]] if before else others[1:]
            self._assign(others[0], ";".join(values), conditional=conditional)
        elif call.name == "unset":
            self._variables.pop(first, None)

    def _assign(self, name: str, value: str, *, conditional: bool) -> None:
        """Set a variable; it is not known when that may not happen, or when it grows too long."""
        if conditional or len(value) > MAX_LENGTH:
            self._variables.pop(name, None)
        else:
            self._variables[name] = value

    def _loop(self, start: int, end: int, *, conditional: bool, depth: int) -> None:
        """Unroll `foreach(x a b c)`; the body of any other loop runs once, x not known."""
        command = self._commands[start]
        if depth > MAX_DEPTH:
            message = f"loops are nested more than {MAX_DEPTH} levels deep"
            self._faults.append(CMakeFault(command.name.span, message))
            return
        words = list(self._words(command.arguments))
        if not words:
            return
        name = words[0].value
        items = self._items(words[1:])
        unknown = items is None
        outer = self._variables.pop(name, None)
        for item in [None] if items is None else items:
            if item is not None:
                self._variables[name] = item
            self.run(start + 1, end, conditional=conditional or unknown, depth=depth + 1)
            if self._steps <= 0:
                break
        self._variables.pop(name, None)
        if outer is not None:
            self._variables[name] = outer

    def _items(self, words: Sequence[Located[str]]) -> list[str] | None:
        """Return the items of a loop; None if it is not known."""
        items = [word.value for word in words]
        match items:
            case ["RANGE", *_]:
                return None
            case ["IN", "LISTS", *names] if all(name in self._variables for name in names):
                items = [item for name in names for item in self._variables[name].split(";")]
            case ["IN", "ITEMS", *rest]:
                items = rest
            case ["IN", *_]:
                return None
        return None if any("$" in item for item in items) else items

    def _words(self, arguments: Sequence[Argument]) -> Iterator[Located[str]]:
        for argument in arguments:
            if argument.kind is ArgumentKind.BRACKET:
                yield argument.text
                continue
            value = self._expand(argument.text.value)
            split = value.split(";") if argument.kind is ArgumentKind.UNQUOTED else [value]
            for word in split:
                if word or argument.kind is ArgumentKind.QUOTED:
                    yield Located(word, argument.text.span)

    def _expand(self, text: str) -> str:
        """Put in known variables, from the inside out; the file's own folder is left out."""
        for _ in range(5):
            expanded = self._expand_once(text)
            if expanded == text:
                break
            text = expanded
        return text.removeprefix("./") if text != "./" else text

    def _expand_once(self, text: str) -> str:
        parts: list[str] = []
        last = length = 0
        for reference in _REFERENCE.finditer(text):
            value = self._variables.get(reference[1], reference[0])
            parts += [text[last : reference.start()], value]
            last = reference.end()
            length += len(value)
            if length > MAX_LENGTH:
                return text
        return "".join((*parts, text[last:]))


def _block_ends(commands: Sequence[Command], faults: list[CMakeFault]) -> dict[int, int]:
    """Return where each block ends, by the index of its first command."""
    closers = set(_BLOCKS.values())
    ends: dict[int, int] = {}
    opened: list[int] = []
    for index, command in enumerate(commands):
        name = command.name.value
        if name in _BLOCKS:
            opened.append(index)
        elif name in closers:
            if opened and _BLOCKS[commands[opened[-1]].name.value] == name:
                ends[opened.pop()] = index
            else:
                faults.append(
                    CMakeFault(command.name.span, f"{name}() has no matching opening command")
                )
    for index in opened:
        name = commands[index].name.value
        faults.append(CMakeFault(commands[index].name.span, f"{name}() has no {_BLOCKS[name]}()"))
        ends[index] = len(commands)
    return ends
