"""Markdown as passages of visible text, every character at its offset in the file.

Parts that the rendered page does not show as text (comments, code fences, struck-through
words, tags, link targets, markers) is blanked out, so offsets in a passage are offsets in the file.
"""

from __future__ import annotations

import enum
import re
from collections.abc import Iterable
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.source.text import SourceText, Span

if TYPE_CHECKING:
    from markdown_it.token import Token

MAX_LENGTH = 200_000
_TAG = re.compile(r"<(/?)([A-Za-z][\w-]*)[^<>\n]{0,500}>")
_HIDDEN = re.compile(r"https?://[^\s)>\]]+|\]\([^()\n]{0,1000}\)|[\[\]`\\]|\*\*|__")
_EMPHASIS = re.compile(r"(?<!\w)[*_](?=\w)|(?<=\w)[*_](?!\w)")
_UNDERLINE = re.compile(r"^[\s>]*#+|(?<![#=\s-])[#=\s-]++$")
_DASH = re.compile(r"&[mn]dash;")
_MARKER = re.compile(r"[\s>]*(?:[-*+]|\d{1,9}[.)])(?=\s)")
_STRUCK = (("~~", "~~"), ("<del>", "</del>"), ("<s>", "</s>"), ("<strike>", "</strike>"))


class PassageKind(enum.Enum):
    """Kind of a block of Markdown."""

    HEADING = "heading"
    PARAGRAPH = "paragraph"
    ITEM = "item"


class Passage(Record, eq=False):
    """One block of visible text.

    Attributes:
        kind: Heading, paragraph, or item of a list.
        level: The level of a heading, 1 to 6; for an item, the number of lists around it; else 0.
        text: Visible text, as long as the stretch of the file it was read from.
        span: The stretch.
    """

    kind: PassageKind
    level: int
    text: str
    span: Span

    @property
    def words(self) -> str:
        """The text with single blanks between its words."""
        return " ".join(self.text.split())

    def part(self, start: int, end: int) -> Span:
        """Return the span of `text[start:end]`."""
        return Span(self.span.source, self.span.start + start, self.span.start + end)


class Markdown(Record, eq=False):
    """A Markdown file as its passages, in order.

    Attributes:
        source: The file.
        passages: Its blocks of visible text.
        text: What was read of the file, comments and fenced code blanked out.
        fences: Fenced code, with its fences.
    """

    source: SourceText
    passages: tuple[Passage, ...]
    text: str = ""
    fences: tuple[Span, ...] = ()


def read_markdown(source: SourceText) -> Markdown:
    """Read a Markdown file; what is behind the first 200 000 characters is left out."""
    from markdown_it import MarkdownIt

    text = _blank_between(source.text[:MAX_LENGTH].replace("\r", " "), "<!--", "-->")
    # Indented text in these sheets is a slip of layout far more often than code.
    parser = MarkdownIt("commonmark").disable(["code", "inline"])
    tokens = parser.parse(text)
    starts = _line_starts(text)
    fences = [
        (starts[token.map[0]], starts[min(token.map[1], len(starts) - 1)])
        for token in tokens
        if token.type == "fence" and token.map
    ]
    text = _blank(text, fences)
    passages = tuple(_passages(source, _visible(text), starts, tokens))
    return Markdown(source, passages, text, tuple(Span(source, *fence) for fence in fences))


def _line_starts(text: str) -> list[int]:
    """Return the offset of each line, and the end of the text."""
    return [0, *(match.end() for match in re.finditer("\n", text)), len(text)]


def _passages(
    source: SourceText, text: str, starts: list[int], tokens: list[Token]
) -> Iterable[Passage]:
    depth = heading = 0
    opens_item = False
    for token in tokens:
        if token.type == "heading_open":
            heading = int(token.tag[1:])
        elif token.type in {"bullet_list_open", "ordered_list_open"}:
            depth += 1
        elif token.type in {"bullet_list_close", "ordered_list_close"}:
            depth -= 1
        elif token.type == "list_item_open":
            opens_item = True
        elif token.type in {"inline", "html_block"} and token.map:
            start, end = starts[token.map[0]], starts[min(token.map[1], len(starts) - 1)]
            block = text[start:end]
            kind = PassageKind.PARAGRAPH
            if heading:
                kind = PassageKind.HEADING
                block = _UNDERLINE.sub(_blanks, block)
            elif opens_item:
                kind = PassageKind.ITEM
                block = _MARKER.sub(_blanks, block, count=1)
            level = heading or (depth if kind is PassageKind.ITEM else 0)
            yield _passage(source, kind, level, block, start)
            heading, opens_item = 0, False


def _passage(source: SourceText, kind: PassageKind, level: int, block: str, start: int) -> Passage:
    """Make a passage of a block's visible text, without the blanks around it."""
    # Nothing visible, as in a list of bare links: the place is what is written there.
    shown = block if block.strip() else source.text[start : start + len(block)]
    start += len(shown) - len(shown.lstrip())
    end = start + len(shown.strip())
    text = block.strip() or " " * (end - start)
    return Passage(kind, level, text, Span(source, start, end))


def _visible(text: str) -> str:
    """Blank out everything that does not show as text; raised digits keep a `^` in front."""
    for start, end in _STRUCK:
        text = _blank_between(text, start, end)
    text = _TAG.sub(_blank_tag, text)
    text = _DASH.sub(lambda match: "-".ljust(len(match.group())), text)
    return _EMPHASIS.sub(" ", _HIDDEN.sub(_blanks, text))


def _blank_tag(match: re.Match[str]) -> str:
    raised = match.group(2).lower() == "sup" and not match.group(1)
    return ("^" if raised else "").rjust(len(match.group()))


def _blanks(match: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", match.group())


def _blank_between(text: str, opening: str, closing: str) -> str:
    """Blank out all stretches from an opening to the next closing, both included."""
    stretches = []
    start = text.find(opening)
    while start >= 0:
        end = text.find(closing, start + len(opening))
        if end < 0:
            break
        stretches.append((start, end + len(closing)))
        start = text.find(opening, end + len(closing))
    return _blank(text, stretches)


def _blank(text: str, stretches: list[tuple[int, int]]) -> str:
    parts, last = [], 0
    for start, end in stretches:
        parts += [text[last:start], re.sub(r"[^\n]", " ", text[start:end])]
        last = end
    return "".join((*parts, text[last:]))
