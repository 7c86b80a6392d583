"""What tinyxml2, and hence Gazebo, forgives though XML forbids it.

Each function blanks the forgiven characters out, so that offsets stay the same, and reports them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.source.positions import XmlFault
from checker.source.text import SourceText, Span

_LATE_DECLARATION = re.compile(r"\s+(<\?xml\s[^>]*?\?>)")
_HYPHENS = re.compile(r"-{2,}|-\Z")
_TWO_HYPHENS = ("'--' inside a comment", "XML forbids two hyphens in a comment; write one")
_REPORTED = 100


def mend_declaration(source: SourceText) -> tuple[str, list[XmlFault]]:
    """Forgive blanks before the XML declaration."""
    text = source.text
    late = _LATE_DECLARATION.match(text)
    if late is None:
        return text, []
    fault = XmlFault(
        Span(source, *late.span(1)),
        "the XML declaration is not at the very start of the file",
        "remove the space or lines before it",
    )
    # Line ends stay: lxml counts lines.
    blank = re.sub(r"[^\r\n]", " ", late.group())
    return blank + text[late.end() :], [fault]


def mend_comments(source: SourceText, text: str) -> tuple[str, list[XmlFault]]:
    """Forgive `--` inside comments; the first ones are reported."""
    faults: list[XmlFault] = []
    parts: list[str] = []
    at = 0
    for start, end in _comment_bodies(text):
        for hyphens in _HYPHENS.finditer(text[start:end]):
            first, last = start + hyphens.start(), start + hyphens.end()
            parts += [text[at:first], " " * (last - first)]
            at = last
            if len(faults) < _REPORTED:
                faults.append(XmlFault(Span(source, first, last), *_TWO_HYPHENS))
    return "".join([*parts, text[at:]]), faults


def _comment_bodies(text: str) -> Iterator[tuple[int, int]]:
    """Yield where the inside of each comment begins and ends; CDATA is passed over."""
    at = text.find("<!")
    while at >= 0:
        for opening, closing in (("<!--", "-->"), ("<![CDATA[", "]]>")):
            if text.startswith(opening, at):
                start = at + len(opening)
                end = text.find(closing, start)
                if end < 0:
                    return
                if opening == "<!--":
                    yield start, end
                at = end
                break
        at = text.find("<!", at + 1)
