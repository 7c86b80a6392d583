"""The description of a rule's options: the section `Options:` in the docstring of its function."""

from __future__ import annotations

import inspect
import re
from collections.abc import Mapping

from checker.base.record import Record
from checker.rule import Rule

_HEADING = re.compile(r"^Options:\n", re.MULTILINE)
_ENTRY = re.compile(r"^ {4}(\w+): (.*(?:\n {5,}.*)*)", re.MULTILINE)
"""A name, and what is behind it on its own line and on those below that are further in."""


class Option(Record):
    """An option of a rule.

    Attributes:
        name: The name as in a settings file.
        default: The default as in a settings file.
        words: Its effect, with its unit; empty if the rule does not describe it.
    """

    name: str
    default: str
    words: str


def options_of(rule: Rule) -> tuple[Option, ...]:
    """Return the options of a rule, in its order."""
    words = option_texts(rule)
    return tuple(
        Option(name, as_toml(default), words.get(name, ""))
        for name, default in rule.options.items()
    )


def option_texts(rule: Rule) -> Mapping[str, str]:
    """Return a rule's descriptions of options, by their names."""
    _, section = _parts(rule)
    return {name: " ".join(words.split()) for name, words in _ENTRY.findall(section)}


def work_of(rule: Rule) -> str:
    """Return what a rule does in the words of its function, without its options."""
    before, _ = _parts(rule)
    return before.strip()


def _parts(rule: Rule) -> tuple[str, str]:
    """Return the docstring of a rule's function up to its section of options, and that section."""
    before, *section = _HEADING.split(inspect.getdoc(rule.check) or "", maxsplit=1)
    return before, "".join(section)


def as_toml(value: object) -> str:
    """Return a value as a settings file has it."""
    match value:
        case bool():
            return str(value).lower()
        case str():
            return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
        case tuple():
            return f"[{', '.join(map(as_toml, value))}]"
        case _:
            return str(value)
