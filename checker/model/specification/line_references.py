"""`spawner.rb, lines 23-26`: claims about what stands in which lines of a file."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from checker.base.record import Record
from checker.source.markdown import Passage
from checker.source.text import Located, Span

_REFERENCE = re.compile(
    r"(?<![\w/.-])([\w./-]{1,200}\.(?:sdf|rb|launch|xacro|urdf|ya?ml|config|xml))\b"
    r"[\s,()\w]{0,40}?\blines?\s+(\d{1,6}(?:\s*(?:-|–|to|and|,|&)\s*\d{1,6})*)",
    re.IGNORECASE,
)
CLAIM_LENGTH = 300
_RANGE = re.compile(r"(\d+)(?:\s*(?:-|–|to)\s*(\d+))?", re.IGNORECASE)


class LineReference(Record, eq=False):
    """A claim about lines of a file.

    Attributes:
        file: The file as written.
        ranges: First and last line of each stretch, both counted.
        claim: The words in front (300 characters at most): what the lines are said to hold.
        span: File and lines.
    """

    file: Located[str]
    ranges: tuple[tuple[int, int], ...]
    claim: str
    span: Span


def line_references(passages: Iterable[Passage]) -> Iterator[LineReference]:
    """Yield the claims about lines."""
    for passage in passages:
        for found in _REFERENCE.finditer(passage.text):
            ranges = tuple(
                (int(first), int(last or first)) for first, last in _RANGE.findall(found.group(2))
            )
            yield LineReference(
                Located(found.group(1), passage.part(*found.span(1))),
                ranges,
                " ".join(
                    passage.text[max(0, found.start() - CLAIM_LENGTH) : found.start()].split()
                ),
                passage.part(*found.span()),
            )
