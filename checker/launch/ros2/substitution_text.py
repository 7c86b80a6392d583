"""Substitutions as XML and YAML launch files write them: `$(var x)`, `$(find-pkg-share p)`."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from types import MappingProxyType

from checker.launch.ros2.graph import LaunchFaultKind
from checker.launch.ros2.values import Allowance, LaunchLimit, Made, PlacedText, Value
from checker.source.text import Located, Span

Report = Callable[[LaunchFaultKind, Span, str, str], None]

ROS_1 = frozenset({"arg", "find", "optenv"})
"""Substitutions of roslaunch that ROS 2 does not have."""
_OPENING = re.compile(r"\$\(\s{0,20}([\w-]{1,80})")
_LEVELS = 20


class AttributeText:
    """The text of one attribute, and the place of each character of it."""

    def __init__(self, text: Located[str], allowance: Allowance, report: Report) -> None:
        """Take a text."""
        self._text = text.value
        self._span = text.span
        self._exact = text.span.text == text.value
        self._allowance = allowance
        self._report = report

    def value(self) -> Value:
        """Return the text, or the parts that make it."""
        parts, _ = self._parts(0, "", 0)
        self._allowance.spend_on_text(len(self._text))
        if not parts:
            return PlacedText("", self._span)
        return parts[0] if len(parts) == 1 else parts

    def _place(self, start: int, end: int) -> Span:
        if not self._exact:
            return self._span
        first = self._span.start
        return Span(self._span.source, first + start, first + end, self._span.holder)

    def _parts(self, at: int, ends: str, level: int) -> tuple[list[Value], int]:
        """Read up to one of some characters; return what was read, and where it ends."""
        if level > _LEVELS:
            raise LaunchLimit(f"nests substitutions more than {_LEVELS} levels deep")
        parts: list[Value] = []
        start = at
        letters: list[str] = []
        while at < len(self._text) and (self._text[at] not in ends or not ends):
            self._allowance.spend()
            opening = _OPENING.match(self._text, at)
            if opening is not None:
                if letters:
                    parts.append(PlacedText("".join(letters), self._place(start, at)))
                    letters = []
                made, at = self._substitution(opening, level)
                parts.append(made)
                start = at
            elif self._text[at] == "\\" and at + 1 < len(self._text):
                letters.append(self._text[at + 1])
                at += 2
            else:
                letters.append(self._text[at])
                at += 1
        if letters:
            parts.append(PlacedText("".join(letters), self._place(start, at)))
        return parts, at

    def _substitution(self, opening: re.Match[str], level: int) -> tuple[Value, int]:
        name, at = opening[1], opening.end()
        arguments: list[Value] = []
        text = self._text
        while at < len(text) and text[at] != ")":
            if text[at].isspace():
                at += 1
                continue
            if text[at] in "'\"":
                parts, at = self._parts(at + 1, text[at], level + 1)
                at += 1
            else:
                parts, at = self._parts(at, " \t\r\n)", level + 1)
            arguments.append(parts[0] if len(parts) == 1 else parts)
        closed = at < len(text)
        end = at + 1 if closed else at
        span = self._place(opening.start(), end)
        if not closed:
            message = f"the substitution {text[opening.start() : end][:60]!r} is not closed"
            self._report(LaunchFaultKind.SUBSTITUTION, span, message, name)
        return self._call_value(name, arguments, span, text[opening.start() : end]), end

    def _call_value(self, name: str, arguments: list[Value], span: Span, written: str) -> Value:
        form = _FORMS.get(name)
        if form is None:
            message = f"$({name} …) is not a substitution of ROS 2"
            if name in ROS_1:
                self._report(LaunchFaultKind.SUBSTITUTION, span, message, name)
            return PlacedText(written, span)
        class_name, names = form
        if name in ("any", "all"):
            return Made(class_name, {}, span, rest=tuple(arguments))
        return Made(class_name, dict(zip(names, arguments, strict=False)), span)


_FORMS: Mapping[str, tuple[str, tuple[str, ...]]] = MappingProxyType(
    {
        "var": ("LaunchConfiguration", ("variable_name", "default")),
        "env": ("EnvironmentVariable", ("name", "default_value")),
        "find-pkg-share": ("FindPackageShare", ("package",)),
        "find-pkg-prefix": ("FindPackagePrefix", ("package",)),
        "find-pkg": ("FindPackagePrefix", ("package",)),
        "exec-in-pkg": ("ExecutableInPackage", ("executable", "package")),
        "exec-in-package": ("ExecutableInPackage", ("executable", "package")),
        "find-exec": ("FindExecutable", ("name",)),
        "command": ("Command", ("command", "on_stderr")),
        "eval": ("PythonExpression", ("expression", "python_modules")),
        "dirname": ("ThisLaunchFileDir", ()),
        "filename": ("ThisLaunchFile", ()),
        "anon": ("AnonName", ("name",)),
        "if": ("IfElseSubstitution", ("condition", "if_value", "else_value")),
        "and": ("AndSubstitution", ("left", "right")),
        "or": ("OrSubstitution", ("left", "right")),
        "not": ("NotSubstitution", ("value",)),
        "any": ("AnySubstitution", ()),
        "all": ("AllSubstitution", ()),
        "bool": ("BooleanSubstitution", ("value",)),
        "equals": ("EqualsSubstitution", ("left", "right")),
        "not-equals": ("NotEqualsSubstitution", ("left", "right")),
        "file-content": ("FileContent", ("path",)),
        "log_dir": ("LaunchLogDir", ()),
        "launch_log_dir": ("LaunchLogDir", ()),
        "param": ("Parameter", ("name",)),
        "path-join": ("PathJoinSubstitution", ("substitutions",)),
    }
)
"""Their classes, and the names of what is in the parentheses."""


def split_words(text: Located[str], allowance: Allowance, report: Report) -> list[Value]:
    """Return the words of a command line, quoted ones and substitutions whole."""
    words: list[Value] = []
    for match in _words(text.value):
        start, end = match
        written = text.value[start:end]
        span = text.span
        if span.text == text.value:
            span = Span(span.source, span.start + start, span.start + end, span.holder)
        if len(written) > 1 and written[0] == written[-1] and written[0] in "'\"":
            written = written[1:-1]
        words.append(AttributeText(Located(written, span), allowance, report).value())
    return words


def _words(text: str) -> list[tuple[int, int]]:
    """Return where the words of a command line begin and end."""
    places: list[tuple[int, int]] = []
    start, depth, quote = -1, 0, ""
    for at, letter in enumerate(text):
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        elif letter == "(" and text[at - 1 : at] == "$":
            depth += 1
        elif letter == ")" and depth:
            depth -= 1
        blank = letter.isspace() and not depth and not quote
        if not blank and start < 0:
            start = at
        elif blank and start >= 0:
            places.append((start, at))
            start = -1
    return [*places, (start, len(text))] if start >= 0 else places
