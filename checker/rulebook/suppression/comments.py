"""Comments that set findings aside: `<!-- subt-check: ignore[SEN005] reason -->`, and with `#`.

They are found by reading the text alone, so that one inside of a string counts too.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice

from checker.base.record import Record
from checker.base.words import shortened
from checker.finding import Place
from checker.package.formats import xml_suffixes
from checker.rulebook.suppression.entries import REASON_LIMIT
from checker.source.text import SourceText

STEM = "subt-check"
"""Word in every mark, in small letters or capitals."""
_XML_TOO = (".gazebo", ".ign", ".md")
_WITH_HASH = (".rb", ".erb", ".yaml", ".yml", ".txt", ".cmake", ".py", ".toml", ".rviz", ".sh")
COMMENTS_LIMIT = 1_000
"""Greatest number in one file; the rest has no effect."""
NAMES_LIMIT = 20
"""Greatest number in one comment."""

_LENGTH_LIMIT = 4_000
_START = re.compile(
    r"(<!--\s{0,200}|#[ \t]{0,200})subt-check[ \t]*(:|(?=\s{0,9}ignore\s{0,9}\[))", re.IGNORECASE
)
"""Without the colon, the text that follows shows that it is meant as a mark."""
_CONTENT = re.compile(r"\s*(\w+)\s*(?:\[([^\]]*)\])?(.*)", re.DOTALL)


class Comment(Record):
    """A comment that suppresses findings.

    Attributes:
        place: The place.
        names: Ids or names of rules; none if the comment has another form.
        fault: What is wrong with its form, as a part of a sentence; empty if nothing is.
        reason: The reason; empty if it does not state it.
        lines: The lines of the file, counted from 1: findings there are set aside.
    """

    place: Place
    names: tuple[str, ...]
    reason: str
    lines: tuple[int, ...]
    fault: str = ""


def has_xml_comments(name: str) -> bool:
    """Return whether only the form of XML is a comment in a file, by its name."""
    return name.lower().endswith((*xml_suffixes(), *_XML_TOO))


def has_comments(name: str) -> bool:
    """Return whether comments in a file can set findings aside, by its name."""
    return has_xml_comments(name) or name.lower().endswith(_WITH_HASH)


def comments_of(source: SourceText) -> tuple[Comment, ...]:
    """Return the comments of a file, in their order."""
    marks = list(islice(_marks(source), COMMENTS_LIMIT))
    below = _lines_below(source, [(mark.start(), end) for mark, end in marks])
    return tuple(comment for mark, end in marks if (comment := _parsed(source, mark, end, below)))


def _marks(source: SourceText) -> Iterator[tuple[re.Match[str], int]]:
    """Yield the beginning of each comment that carries the mark, and where the comment ends."""
    only_xml = has_xml_comments(source.file)
    for match in _START.finditer(source.text):
        end = _end(source.text, match)
        if end > 0 and not (only_xml and match[0].startswith("#")):
            yield match, end


def _end(text: str, match: re.Match[str]) -> int:
    """Return where a comment ends, or -1 when it does not end soon."""
    limit = match.end() + _LENGTH_LIMIT
    if match[0].startswith("<!--"):
        end = text.find("-->", match.end(), limit)
        return end + 3 if end >= 0 else -1
    end = text.find("\n", match.end(), limit)
    return end if end >= 0 else min(limit, len(text))


def _lines_below(source: SourceText, stretches: list[tuple[int, int]]) -> dict[int, int]:
    """Return the line that comments alone on theirs are about, by their first lines.

    Of comments one below the other, all are about the line below the last.
    """
    below: dict[int, int] = {}
    for start, end in reversed(stretches):
        if _is_alone(source.text, start, end):
            following = source.position(end)[0] + 1
            below[source.position(start)[0]] = below.get(following, following)
    return below


def _is_alone(text: str, start: int, end: int) -> bool:
    """Return whether the lines of a comment contain only comments."""
    first = text.rfind("\n", max(0, start - _LENGTH_LIMIT), start) + 1
    last = text.find("\n", end, end + _LENGTH_LIMIT)
    last = len(text) if last < 0 else last
    if start - first > _LENGTH_LIMIT or last - end > _LENGTH_LIMIT:
        return False
    if text[start] == "#":
        return not text[first:start].strip()
    before, *comments = text[first:last].split("<!--")
    behind = [comment.partition("-->") for comment in comments]
    return not before.strip() and all(ended and not rest.strip() for _, ended, rest in behind)


def _parsed(
    source: SourceText, mark: re.Match[str], end: int, below: dict[int, int]
) -> Comment | None:
    """Return what a comment states; None if it is about something else."""
    content = _CONTENT.match(source.text[mark.end() : end].removesuffix("-->"))
    if content is None:
        return None
    word, bracket, reason = content.groups()
    ignores = word.lower() == "ignore"
    if bracket is None and not ignores:
        return None
    place = source.place(mark.start(), end)
    lines = tuple(sorted({place.line, place.end_line, below.get(place.line, place.line)}))
    if not mark[2]:
        return Comment(place, (), "", lines, "a colon is missing after subt-check")
    words = [name.strip() for name in (bracket or "").split(",")] if ignores else []
    names = tuple(dict.fromkeys(filter(None, words)))[:NAMES_LIMIT]
    why = shortened(" ".join(reason.split()), REASON_LIMIT) if re.search(r"\w", reason) else ""
    return Comment(place, names, why, lines, "" if names else "it contains no ignore[RULE]")
