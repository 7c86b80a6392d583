"""Numbers with units in running text, in SI."""

from __future__ import annotations

import enum
import re
from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.record import Record
from checker.source.markdown import Passage
from checker.source.text import Span

NUMBER = r"\d{1,15}(?:,\d{3}){0,5}(?:\.\d{1,15})?|\.\d{1,15}"
MAX_SENTENCE = 2000
_NUMBER_WORDS = (
    *("one", "two", "three", "four", "five", "six"),
    *("seven", "eight", "nine", "ten", "eleven", "twelve"),
)
WORDS = {word: number for number, word in enumerate(_NUMBER_WORDS, start=1)}
_SENTENCE_END = re.compile(r"(?<!approx)(?<!ca)(?<!\bno)[.!?;]\s+", re.IGNORECASE)
_APPROXIMATE = re.compile(r"~|≈|\b(?:about|approx\w*|around|roughly|ca|circa|nearly)\b", re.I)
_CONFIGURATION = re.compile(
    r"\b(?:(?:sensor[\s_]+)?config(?:uration)?s?|SC)[\s_#]{1,3}(\d{1,2})"
    r"(?:\s*(-|to|through|and|an|,|&)\s*(\d{1,2})\b)?",
    re.IGNORECASE,
)


class QuantityKind(enum.Enum):
    """Quantity of a number in the sheet."""

    TOTAL_MASS = "mass of the whole robot, kg"
    MASS = "another mass, or a bound, kg"
    ENDURANCE = "endurance of the robot, s"
    ENDURANCE_LIMIT = "endurance that the model is limited to, s"
    TURNING_RADIUS = "turning radius, m"


class Quantity(Record, eq=False):
    """A number of the sheet.

    Attributes:
        kind: What it measures.
        value: The value in SI units.
        resolution: What one step of its last digit is worth, in SI units.
        unit_text: The unit as written.
        approximate: Whether the text states `about`, `~` or the like.
        configurations: Sensor configurations that its sentence names.
        span: Number and unit.
    """

    kind: QuantityKind
    value: float
    resolution: float
    unit_text: str
    approximate: bool
    configurations: frozenset[int]
    span: Span


class Sentence(Record):
    """A sentence of a passage: `text` is at `start` of the passage's text."""

    passage: Passage
    start: int
    text: str

    def part(self, start: int, end: int) -> Span:
        """Return the span of `text[start:end]`, with the tag that ends a raised digit."""
        span = self.passage.part(self.start + start, self.start + end)
        closing = span.source.text.startswith("</sup>", span.end)
        return replace(span, end=span.end + len("</sup>")) if closing else span


def sentences(passage: Passage) -> Iterator[Sentence]:
    """Split a passage at full stops, semicolons, exclamation and question marks.

    A sentence of more than 2000 characters is cut, so that the work stays in proportion.
    """
    start = 0
    ends = [match.end() for match in _SENTENCE_END.finditer(passage.text)]
    for end in (*ends, len(passage.text)):
        for first in range(start, end, MAX_SENTENCE):
            yield Sentence(passage, first, passage.text[first : min(end, first + MAX_SENTENCE)])
        start = end


def number_of(text: str) -> float:
    """Read a number as `NUMBER` matches it, with its sign, or a number word."""
    text = text.replace(",", "").replace("\N{MINUS SIGN}", "-").replace(" ", "").lower()
    return float(WORDS[text]) if text in WORDS else float(text)


def resolution_of(text: str) -> float:
    """Return what one step of the last written digit is worth: 0.01 for `3.14`."""
    _, _, decimals = text.partition(".")
    return float(10 ** -len(decimals)) if len(decimals) < 20 else 0.0


def is_approximate(words_before: str) -> bool:
    """Return whether the words in front of a number make it approximate."""
    return bool(_APPROXIMATE.search(words_before))


def configurations_in(text: str) -> frozenset[int]:
    """Return the sensor configurations that a text names: `sensor config 2`, `SC 3 and 4`."""
    named: set[int] = set()
    for first, joint, last in _CONFIGURATION.findall(text):
        named.add(int(first))
        if last and joint in {"-", "to", "through"}:
            named.update(range(int(first), int(last) + 1))
        elif last:
            named.add(int(last))
    return frozenset(named)
