"""Numbers, vectors, colours and booleans out of XML text, each with its own place."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

from checker.model.faults import Fault, FaultKind
from checker.source.text import Located, Span, blank_markup
from checker.source.xml import Element

_NUMBER = re.compile(r"[+-]?(?:\d++\.?\d*+|\.\d++)(?:[eE][+-]?\d++)?\Z", re.ASCII)
_INFINITE = {"inf", "+inf", "-inf", "infinity", "-infinity"}
_WORD = re.compile(r"[^ \t\r\n]+")
_TRUE = {"1", "true"}
_FALSE = {"0", "false"}


def parse_number(text: str) -> float | None:
    """Read a decimal number (`-1.5e3`, `inf`); None for anything else, and for an overflow."""
    if _NUMBER.match(text):
        value = float(text)
        return None if math.isinf(value) else value
    return float(text) if text.lower() in _INFINITE else None


def stated_number(parent: Element, tag: str) -> Located[float] | None:
    """Return the number in the child `tag`; None if there is none that reads as one."""
    child = parent.child(tag)
    value = parse_number(child.text.value) if child is not None else None
    return None if child is None or value is None else Located(value, child.text.span)


class ValueReader:
    """Reads values and collects what does not read as its type.

    A value that cannot be read counts as its default, so that reading continues.
    """

    def __init__(self) -> None:
        self.faults: list[Fault] = []

    def fault(self, kind: FaultKind, span: Span, message: str) -> None:
        """Remember a fault."""
        self.faults.append(Fault(kind, span, message))

    def numbers_in(self, text: Located[str], *, commas: bool = False) -> tuple[Located[float], ...]:
        """Split a text at its blanks and read each word as a number, also before a comma if so."""
        if not text.stated:
            return ()
        read = []
        for word, span in _words(text):
            value = parse_number(word.removesuffix(",") if commas else word)
            if value is None:
                self.fault(FaultKind.VALUE, span, f"{short(word)!r} is not a number")
            read.append(Located(0.0 if value is None else value, span))
        return tuple(read)

    def number(self, parent: Element | None, tag: str, default: float) -> Located[float]:
        """Read the number in the child `tag`; the default, placed at the parent, when absent."""
        return self.numbers(parent, tag, (default,))[0]

    def numbers(
        self, parent: Element | None, tag: str, default: Sequence[float]
    ) -> tuple[Located[float], ...]:
        """Read the numbers in the child `tag`, as many as the default has."""
        child = parent.child(tag) if parent is not None else None
        if child is None:
            if parent is None:
                raise ValueError(f"there is no <{tag}>")
            return tuple(Located(value, parent.span, stated=False) for value in default)
        return self.numbers_of(child, default)

    def numbers_of(
        self, element: Element, default: Sequence[float], *, commas: bool = False
    ) -> tuple[Located[float], ...]:
        """Read the numbers that an element's text contains, as many as the default has."""
        read = self.numbers_in(element.text, commas=commas)
        return self._expect(element.text, read, default, f"<{element.tag}>")

    def attribute_numbers(
        self, element: Element, name: str, default: Sequence[float]
    ) -> tuple[Located[float], ...]:
        """Read the numbers in an attribute, as many as the default has."""
        text = element.attribute(name)
        if text is None:
            return tuple(Located(value, element.span, stated=False) for value in default)
        return self._expect(text, self.numbers_in(text), default, name)

    def _expect(
        self,
        text: Located[str],
        read: tuple[Located[float], ...],
        default: Sequence[float],
        label: str,
    ) -> tuple[Located[float], ...]:
        if len(read) == len(default):
            return read
        count = f"{len(default)} number{'s' if len(default) > 1 else ''}"
        self.fault(FaultKind.VALUE, text.span, f"{label} has {len(read)} values, expected {count}")
        padded = [*read[: len(default)]]
        padded += [Located(value, text.span, stated=False) for value in default[len(padded) :]]
        return tuple(padded)

    def finite(self, numbers: tuple[Located[float], ...]) -> tuple[Located[float], ...]:
        """Take lengths and angles as they are, and 0 for one that is infinite."""
        return tuple(self._finite(number) for number in numbers)

    def _finite(self, number: Located[float]) -> Located[float]:
        if math.isfinite(number.value):
            return number
        self.fault(FaultKind.VALUE, number.span, "a pose has finite numbers only")
        return Located(0.0, number.span)

    def boolean(self, parent: Element, tag: str, default: bool) -> Located[bool]:
        """Read `true`, `false`, `1` or `0` in the child `tag`."""
        child = parent.child(tag)
        if child is None:
            return Located(default, parent.span, stated=False)
        word = child.text.value.lower()
        if word in _TRUE or word in _FALSE:
            return Located(word in _TRUE, child.text.span)
        self.fault(
            FaultKind.VALUE,
            child.text.span,
            f"<{tag}> is {short(child.text.value)!r}, expected true or false",
        )
        return Located(default, child.text.span, stated=False)

    def text(self, parent: Element, tag: str, default: str = "") -> Located[str]:
        """Read the text of the child `tag`."""
        child = parent.child(tag)
        if child is None:
            return Located(default, parent.span, stated=False)
        return child.text

    def name(self, element: Element) -> Located[str]:
        """Read the `name` attribute; empty if there is none."""
        return element.attribute("name") or Located("", element.span, stated=False)


def numbers_of_words(text: str) -> list[float | None]:
    """Read each word of a text as a number, without its place; None for a word that is none."""
    return [parse_number(word) for word in _WORD.findall(text)]


def _words(text: Located[str]) -> list[tuple[str, Span]]:
    """Return the words of a text with their places.

    Entities, and comments amid a word, make the value differ from what is written: then each word
    is at the whole text's place.
    """
    span = text.span
    written = blank_markup(span.text)
    if written != text.value and _WORD.findall(written) != (words := _WORD.findall(text.value)):
        return [(word, span) for word in words]
    source, first, holder = span.source, span.start, span.holder
    return [
        (word.group(), Span(source, first + word.start(), first + word.end(), holder))
        for word in _WORD.finditer(written)
    ]


def short(text: str) -> str:
    """Return a text, or its beginning when it is longer than a message can show."""
    return text if len(text) <= 40 else text[:37] + "..."
