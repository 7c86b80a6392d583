"""Reasons why xacro files do not expand."""

from __future__ import annotations

import enum

from checker.base.record import Record
from checker.source.text import Span


class XacroFaultKind(enum.StrEnum):
    """Kind of the fault for which a file gives no robot.

    `EMPTY`: it is empty. `MALFORMED`: it is not well-formed XML. `EXPANSION`: xacro refuses it.
    `ENVIRONMENT`: it needs an environment variable. `ARGUMENT`: it needs an argument that is not
    given. `PREFIX`: tags of xacro lack `xacro:`. `RECURSION`: a macro or a file uses itself.
    `LIMIT`: expanding it takes more than is allowed. `PART`: it needs names of a robot, and
    no robot includes it.
    """

    EMPTY = "empty"
    MALFORMED = "malformed"
    EXPANSION = "expansion"
    ENVIRONMENT = "environment"
    ARGUMENT = "argument"
    PREFIX = "prefix"
    RECURSION = "recursion"
    LIMIT = "limit"
    PART = "part"


class XacroFault(Record, eq=False):
    """Fault for which a file does not expand, with its place.

    Attributes:
        kind: What sort of fault it is.
        file: The file to expand; the fault may be in one that it includes.
        span: Its place.
        message: The end of a sentence.
        hint: The way to correct it; may be empty.
        loaded: Whether a launch file of the package loads the file.
    """

    kind: XacroFaultKind
    file: str
    span: Span
    message: str
    hint: str = ""
    loaded: bool = True
