"""Attributes of launch elements as roslaunch reads them: substitutions, conditions."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from functools import cache

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.graph import LaunchFault, LaunchFaultKind
from checker.launch.ros1.scope import Scope
from checker.launch.ros1.substitution import is_known, substitute
from checker.source.text import Located, Span
from checker.source.xml import Element

# The tags of roslaunch XML (`checker/data/roslaunch_tags.json`), and attributes gone astray.


_LEFT_OUTSIDE = re.compile(
    r"""\s*([A-Za-z][\w-]{0,40})\s{0,20}=\s{0,20}(["'])([^"'<>]{0,2000})\2"""
)


class LaunchTag(Record):
    """Attributes and children that roslaunch knows for one tag.

    Attributes:
        attributes: Names of its attributes, conditions among them.
        required: The attributes without which roslaunch stops.
        children: Tags that may be inside.
    """

    attributes: frozenset[str]
    required: tuple[str, ...]
    children: frozenset[str]


@cache
def launch_tags() -> Mapping[str, LaunchTag]:
    """Return the tags that roslaunch knows, by name."""
    known = table("roslaunch_tags")
    return {
        name: LaunchTag(
            frozenset(entry["attributes"]).union(() if name == "launch" else known["_conditions"]),
            tuple(entry["required"]),
            frozenset(entry["children"]),
        )
        for name, entry in known.items()
        if not name.startswith("_")
    }


def left_outside(element: Element) -> dict[str, Located[str]]:
    """Return the attributes that are behind a tag which was closed too early.

    In `<node> pkg="p" type="t" name="n">` the text behind the first `>` is what the tag should
    hold. Elements with their own attributes, or whose text is a value, have none.
    """
    if element.node.attrib or element.tag not in ("node", "include") or "=" not in element.raw_text:
        return {}
    start, text = element.position.start_end, element.raw_text
    attributes: dict[str, Located[str]] = {}
    at = 0
    while match := _LEFT_OUTSIDE.match(text, at):
        span = Span(element.source, start + match.start(3), start + match.end(3), element)
        exact = span.text == match.group(3)
        attributes.setdefault(
            match.group(1), Located(match.group(3), span if exact else element.span)
        )
        at = match.end()
    return attributes


MAX_STEPS = 100_000
CHARACTERS_PER_STEP = 100
"""Characters of substituted text that count as one step."""
_TRUTH = {"true": True, "1": True, "false": False, "0": False}
_WORD = re.compile(r"(?:\$\([^()]*\)|\S)+")


def truth_of(text: str) -> bool | None:
    """Read a truth value as roslaunch does; None for any other text."""
    return _TRUTH.get(text.strip().lower())


class Reader:
    """Reads attributes, collects faults, and counts steps.

    Attributes:
        faults: What was wrong so far.
        undecided: Conditions whose value is not known here.
    """

    def __init__(self) -> None:
        self.faults: list[LaunchFault] = []
        self.undecided: list[Located[str]] = []
        self._steps = MAX_STEPS

    def fault(self, kind: LaunchFaultKind, where: Element | Span, message: str) -> None:
        """Remember a fault."""
        self.faults.append(LaunchFault(kind, where.span, message))

    def charge(self, element: Element, steps: int) -> bool:
        """Count steps, and state whether there are any left; the last one is a fault, once."""
        before, self._steps = self._steps, self._steps - steps
        if before > 0 >= self._steps:
            message = f"the launch file takes more than {MAX_STEPS} steps to evaluate"
            self.fault(LaunchFaultKind.LIMIT, element, message)
        return self._steps > 0

    def text(self, element: Element, attribute: str, scope: Scope) -> Located[str] | None:
        """Return an attribute with its substitutions made; None if it is absent."""
        if element.get(attribute) is None:
            written = left_outside(element).get(attribute)
        else:
            written = element.attribute(attribute)
        if written is None or "$(" not in written.value:
            return written
        result = substitute(written.value, scope.args, scope.file.directory)
        for fault in result.faults:
            span = written.span
            if span.text == written.value:
                start, end = span.start + fault.start, span.start + fault.end
                span = Span(span.source, start, end, span.holder)
            self.fault(fault.kind, span, fault.message)
        self.charge(element, len(result.text) // CHARACTERS_PER_STEP)
        return Located(result.text, written.span)

    def value(self, element: Element, attribute: str, scope: Scope, default: str = "") -> str:
        """Return the text of an attribute without its place."""
        text = self.text(element, attribute, scope)
        return default if text is None else text.value

    def is_enabled(self, element: Element, scope: Scope) -> bool | None:
        """Return whether `if` and `unless` enable an element; None where a value is unknown."""
        for attribute, enabling_truth in (("if", True), ("unless", False)):
            condition = self.text(element, attribute, scope)
            if condition is None:
                continue
            truth = truth_of(condition.value)
            if truth is None and not is_known(condition.value):
                self.undecided.append(condition)
                return None
            if truth is None:
                message = f"{attribute}={condition.value!r} is not true, false, 1 or 0"
                self.fault(LaunchFaultKind.CONDITION, condition.span, message)
            if truth is not enabling_truth:
                return False
        return True


def split_words(written: Located[str], scope: Scope) -> Iterator[Located[str]]:
    """Yield the words of an attribute, substituted, each with the text it was written as.

    Faults of the substitutions are stated where the attribute is read as a whole.
    """
    text, span = written.value, written.span
    # Character references and line endings are written longer than they read.
    exact = len(span.text) == len(text) and span.text.split() == text.split()
    pieces = _WORD.finditer(text)
    if text.startswith("$(eval "):
        exact, pieces = False, re.finditer(r".+", text, re.DOTALL)
    for piece in pieces:
        place = span
        if exact:
            place = Span(span.source, span.start + piece.start(), span.start + piece.end())
        result = substitute(piece.group(), scope.args, scope.file.directory).text
        for word in _WORD.findall(result):
            yield Located(word, place)
