"""Placeholders, struck-through text and line numbers in the text of a sheet."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from checker.base.record import Record
from checker.source.markdown import Markdown, Passage
from checker.source.text import Located, Span

# `spawner.rb, lines 23-26`: claims about what is in which lines of a file.


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
        claim: The words in front (300 characters at most): the stated content of the lines.
        span: File and lines.
    """

    file: Located[str]
    ranges: tuple[tuple[int, int], ...]
    claim: str
    span: Span


def line_references(passages: Iterable[Passage]) -> Iterator[LineReference]:
    """Yield the claims about lines."""
    for passage in passages:
        for match in _REFERENCE.finditer(passage.text):
            ranges = tuple(
                (int(first), int(last or first)) for first, last in _RANGE.findall(match.group(2))
            )
            yield LineReference(
                Located(match.group(1), passage.part(*match.span(1))),
                ranges,
                " ".join(
                    passage.text[max(0, match.start() - CLAIM_LENGTH) : match.start()].split()
                ),
                passage.part(*match.span()),
            )


STRUCK_LIMIT = 5000
"""Characters of struck-through text."""

_PLACEHOLDER = re.compile(
    r"\b(?:TODO|TBD|TBA|FIXME)\b"
    r"|\\?<?\b[Ff][Ii][Xx][_-][Mm][Ee]\b\\?>?"
    r"|https?://[^\s)>\]]{0,300}/x{3,}(?![\w-])"
    # `\<Robot Name\>`, `<Explanation of Diversions\>`; `/<Robot Name>/cmd_vel` is part of a path.
    r"|(?<!/)\\?<[A-Z]\w*(?: [\w()]+){1,8}\\?>(?!/)"
    r"|\\?<[A-Z][\w ]{0,60}\(s\)[^<>\n]{0,200}\\?>"
)
_NO_TARGET = re.compile(r"\[([^\]\[\n]{1,200})\]\(\s*\)")
_STRUCK = re.compile(
    r"(?<!~)~~(?!~)|<(?P<close>/?)(?P<tag>s|del|strike)>",
    re.IGNORECASE,
)


class Leftover(Record, eq=False):
    """Something that was to be replaced or removed.

    Attributes:
        words: The words as written.
        span: Their place.
    """

    words: str
    span: Span


def placeholders(markdown: Markdown) -> Iterator[Leftover]:
    """Yield placeholders of text and of links; those in comments and fenced code are none."""
    for match in _PLACEHOLDER.finditer(markdown.text):
        yield Leftover(match.group(), Span(markdown.source, *match.span()))


def links_without_target(markdown: Markdown) -> Iterator[Leftover]:
    """Yield links such as `[datasheet]()`."""
    for match in _NO_TARGET.finditer(markdown.text):
        yield Leftover(match.group(1), Span(markdown.source, *match.span()))


def struck_through(markdown: Markdown) -> Iterator[Leftover]:
    """Yield text between `~~` and `~~`, `<s>` and `</s>`, `<del>` and `</del>`."""
    opening: re.Match[str] | None = None
    for mark in _STRUCK.finditer(markdown.text):
        if opening is not None and _ends(opening, mark):
            start, end = opening.end(), mark.start()
            opening = None
            if 0 < end - start <= STRUCK_LIMIT:
                words = " ".join(markdown.text[start:end].split())
                yield Leftover(words, Span(markdown.source, start, end))
        elif not mark["close"]:
            opening = mark


def _ends(opening: re.Match[str], mark: re.Match[str]) -> bool:
    if not opening["tag"]:
        return not mark["tag"]
    return bool(mark["close"]) and (mark["tag"] or "").lower() == opening["tag"].lower()
