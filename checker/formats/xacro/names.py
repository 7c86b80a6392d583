"""The names that xacro reads: those in expressions, and the parameters of macros."""

from __future__ import annotations

import keyword
import re

from checker.base.record import Record

EXPRESSION = re.compile(r"\$\{([^{}]{1,500})\}")
BRACES = re.compile(r"(?<!\$)\{([A-Za-z_]\w{0,80})\}")
"""A name in braces without a dollar sign, which xacro keeps."""
_TEXT = re.compile(r"'[^']{0,500}'|\"[^\"]{0,500}\"|\$\([^()]{0,200}\)")
"""Quoted text, and `$(arg …)`, which is replaced before anything is evaluated."""
_NAME = re.compile(r"(?<![\w.])[A-Za-z_]\w{0,100}(?!\w|\s{0,8}=[^=])")
PARAMETER = re.compile(
    r"""(?<!\S)(?P<block>\*{0,2})(?P<name>[A-Za-z_]\w{0,100})
    (?::?=(?P<default>(?:\^\|?)?(?:\$\{[^{}]{0,500}\}|\$\([^()]{0,500}\)
        |[^\s'"]{0,500}(?:(?:'[^']{0,500}'|"[^"]{0,500}")[^\s'"]{0,500}){0,9})))?(?!\S)""",
    re.VERBOSE,
)
FROM_OUTSIDE = "^"
"""Instead of a default, or before it: the value of the property of that name at the call."""


class MacroParameter(Record):
    """A parameter of a macro.

    Attributes:
        name: Without its stars.
        default: The default as written; None for a parameter that a call has to state.
        block: `*` for an element that the call contains, `**` for its content; else empty.
    """

    name: str
    default: str | None
    block: str

    @property
    def requirement(self) -> str:
        """Optional and required arguments of a call."""
        if self.block:
            return "an element inside the call"
        if self.default is None:
            return "required"
        if self.default.startswith(FROM_OUTSIDE):
            rest = self.default[1:].removeprefix("|")
            return "the property of the caller" + (f", else {rest}" if rest else "")
        return f"default {self.default}"


def parameters_of(text: str) -> tuple[MacroParameter, ...]:
    """Return the parameters that the attribute `params` of a macro names."""
    return tuple(
        MacroParameter(match["name"], match["default"], match["block"])
        for match in PARAMETER.finditer(text)
    )


def names_in(expression: str) -> set[str]:
    """Return the names that an expression reads, those that it binds itself among them."""
    names = _NAME.findall(_TEXT.sub("", expression))
    return {name for name in names if not keyword.iskeyword(name)}
