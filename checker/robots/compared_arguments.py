"""Arguments of xacro that have no value or a wrong one, and texts that they may have."""

from __future__ import annotations

import re
from collections.abc import Collection, Mapping, Sequence
from itertools import islice

from msgspec.structs import replace

from checker.formats.xacro.expansion import Expander, Expansions, Outcome, Unread, Wanted
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.package.package import Package
from checker.robots.further_values import compared_texts
from checker.source.xml import XmlDocument

_NEEDED = re.compile(
    r"arg (?P<none>[\w.-]{1,100}) is neither given nor has a default\b"
    r"|needs another value of the argument '(?P<wrong>[\w.-]{1,100})'"
)
_ARGUMENTS_LIMIT = 3
"""Arguments of one file that get a value."""
_TEXTS_LIMIT = 6
"""Texts that are tried of one argument."""


def _needed_argument(outcome: Outcome) -> str:
    """Return the argument without which a file does not expand; empty if there is none."""
    if isinstance(outcome, Unread):
        found = _NEEDED.search(outcome.reason)
    elif isinstance(outcome, XacroFault) and outcome.kind is XacroFaultKind.ARGUMENT:
        found = _NEEDED.match(outcome.message)
    else:
        found = None
    return found["none"] or found["wrong"] if found else ""


def with_compared(
    package: Package,
    expander: Expander,
    wish: Wanted,
    fault: Outcome,
    may_set: Collection[str],
    allowed: Mapping[str, Sequence[str]],
) -> tuple[Wanted, XmlDocument, Mapping[str, str]] | None:
    """Expand a file with texts that launch files allow for its arguments, or it compares them with.

    Args:
        package: The package of the file.
        expander: Expands it.
        wish: What was to be expanded.
        fault: The result of it.
        may_set: Names of the arguments that may get a value; empty for any.
        allowed: The values that launch files allow for arguments, by name.

    Returns:
        What is expanded, the result, and the values; None if no text leads to a robot.
    """
    taken: dict[str, str] = {}
    for _ in range(_ARGUMENTS_LIMIT):
        name = _needed_argument(fault)
        if not name or (may_set and name not in may_set):
            return None
        file = fault.span.source.file if isinstance(fault, XacroFault) else wish.path
        paths = (file, *(it.path for it in package.index.with_suffix(".xacro")))
        documents = (package.xml(path) for path in dict.fromkeys(paths))
        compared = compared_texts((it for it in documents if isinstance(it, XmlDocument)), name)
        texts = dict.fromkeys((*allowed.get(name, ()), *compared))
        tried = [{**taken, name: text} for text in islice(texts, _TEXTS_LIMIT)]
        wanted = [replace(wish, args={**wish.args, **values}) for values in tried]
        outcomes = Expansions(package, wanted, expander).outcomes() if wanted else []
        for made, outcome, values in zip(wanted, outcomes, tried, strict=True):
            if isinstance(outcome, XmlDocument):
                return made, outcome, values
        further = [
            (it, values)
            for it, values in zip(outcomes, tried, strict=True)
            if _needed_argument(it) not in ("", name)
        ]
        if not further:
            return None
        fault, taken = further[0]
    return None
