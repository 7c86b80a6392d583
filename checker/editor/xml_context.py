"""Position of a caret in an XML text, which may not be well-formed at the moment.

The text is read once from its start to the caret, without building a tree or refusing anything. A
start tag that the next `<` cuts off opens nothing; an end tag closes what is open by its name, if
any is.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum

from checker.base.record import Record

DEPTH_LIMIT = 300
"""Open elements that are kept track of; deeper ones count as closed."""
_BLANKS = " \t\r\n"
_QUOTES = ("'", '"')
_TAG = re.compile(
    r"""<(?P<name>[^\s<>/"'=!?][^\s<>/"'=]*+)(?:[^<>"']++|"[^"<]*+"?+|'[^'<]*+'?+)*+(?P<end>>)?"""
)
_END_TAG = re.compile(r"</(?P<name>[^\s<>]*+)[^<>]*+(?P<end>>)?")
_ATTRIBUTE = re.compile(r"""([^\s=<>/"']++)(?:\s*+(=)\s*+(?:"([^"<]*+)"?+|'([^'<]*+)'?+)?+)?+""")
_NEXT_ATTRIBUTE = re.compile(r"\s[\w:.-]+\s*=\s*\Z")
_OTHER = (("<!--", "-->"), ("<![CDATA[", "]]>"), ("<?", "?>"), ("<!", ">"))


class Where(StrEnum):
    """Kind of text around a caret."""

    TEXT = "text"
    TAG = "tag"
    """The name of a start tag."""
    ATTRIBUTE = "attribute"
    """A start tag, where a name of an attribute stands or may stand."""
    VALUE = "value"
    """The value of an attribute."""
    CLOSING = "closing"
    """An end tag."""
    OTHER = "other"
    """A comment, CDATA or an instruction."""


class OpenElement(Record):
    """An element around a caret.

    Attributes:
        tag: Name as written.
        attributes: Values by name, as written.
        children: Tags of the elements in it that are in front of the caret.
        start: Offset of its `<`.
    """

    tag: str
    attributes: Mapping[str, str]
    children: tuple[str, ...]
    start: int


class Context(Record):
    """Surroundings of a caret.

    Attributes:
        where: Kind of place.
        around: Elements around it, outermost first; a tag that it is in is none of them.
        tag: Name of the start or end tag around it.
        attributes: The attributes of that start tag, by name.
        attribute: Name of the attribute with this value.
        typed: What is between the start of the word and the caret.
        start: Offset of the word: a name, a value, a text of one line.
        end: Offset behind it.
    """

    where: Where
    around: tuple[OpenElement, ...]
    tag: str = ""
    attributes: Mapping[str, str] = {}
    attribute: str = ""
    typed: str = ""
    start: int = 0
    end: int = 0

    @property
    def tags(self) -> tuple[str, ...]:
        """The names of the elements around, outermost first."""
        return tuple(element.tag for element in self.around)

    @property
    def innermost(self) -> OpenElement | None:
        """The nearest element around."""
        return self.around[-1] if self.around else None


@dataclass(slots=True)
class Markup:
    """A piece of markup.

    Attributes:
        kind: `<` for a start tag, `/` for an end tag, `!` for a comment, CDATA and the like.
        name: Name of the tag.
        start: Offset of its `<`.
        end: Offset behind it.
        is_whole: Whether it ends with its own `>`.
        is_empty: Whether it is a start tag that ends with `/>`.
    """

    kind: str
    name: str
    start: int
    end: int
    is_whole: bool
    is_empty: bool = False


@dataclass(slots=True)
class _Open:
    markup: Markup
    children: list[str] = field(default_factory=list)


def xml_context(text: str, offset: int) -> Context:
    """Return what is around the caret in front of the character at an offset.

    Args:
        text: May be malformed in any way.
        offset: Clipped to the text.
    """
    offset = min(max(offset, 0), len(text))
    stack: list[_Open] = []
    end = 0
    for markup in markup_in(text, 0, offset):
        if offset < markup.end or not markup.is_whole:
            if offset <= markup.end and offset > markup.start and markup.kind != "<":
                return _in_other(text, offset, markup, _frozen(text, stack))
            if offset <= markup.end and offset > markup.start:
                return _in_start_tag(text, offset, markup, _frozen(text, stack))
        end = markup.end
        _apply(markup, stack)
    return _in_text(text, offset, end, _frozen(text, stack))


def tags_behind(text: str, offset: int) -> Iterator[str]:
    """Yield the tags of the elements behind a caret that are in the same element as it."""
    depth = 0
    for markup in markup_in(text, offset, len(text)):
        if markup.kind == "/":
            depth -= 1
            if depth < 0:
                return
        elif markup.kind == "<" and markup.is_whole:
            if depth == 0:
                yield markup.name
            depth += not markup.is_empty


def markup_in(text: str, at: int, stop: int) -> Iterator[Markup]:
    """Yield all markup that begins from one offset up to another, in order."""
    while (at := text.find("<", at, stop)) >= 0:
        markup = _markup_at(text, at)
        yield markup
        at = max(markup.end, at + 1)


def _markup_at(text: str, at: int) -> Markup:
    following = text[at + 1 : at + 2]
    if following == "/" and (match := _END_TAG.match(text, at)):
        return Markup("/", match["name"], at, match.end(), match["end"] is not None)
    if following in ("!", "?"):
        opening, closing = next(pair for pair in _OTHER if text.startswith(pair[0], at))
        end = text.find(closing, at + len(opening))
        found = end >= 0
        return Markup("!", "", at, end + len(closing) if found else len(text), found)
    if match := _TAG.match(text, at):
        whole = match["end"] is not None
        empty = whole and text[match.end() - 2] == "/"
        return Markup("<", match["name"], at, match.end(), whole, empty)
    return Markup("<", "", at, at + 1, False)


def _apply(markup: Markup, stack: list[_Open]) -> None:
    """Open or close elements as markup in front of the caret does."""
    if markup.kind == "<" and markup.is_whole:
        if stack:
            stack[-1].children.append(markup.name)
        if not markup.is_empty and len(stack) < DEPTH_LIMIT:
            stack.append(_Open(markup))
    elif markup.kind == "/":
        for depth in range(len(stack) - 1, -1, -1):
            if stack[depth].markup.name == markup.name:
                del stack[depth:]
                return


def _frozen(text: str, stack: list[_Open]) -> tuple[OpenElement, ...]:
    return tuple(
        OpenElement(
            it.markup.name, _attributes(text, it.markup), tuple(it.children), it.markup.start
        )
        for it in stack
    )


def _attributes(text: str, tag: Markup) -> dict[str, str]:
    start = tag.start + 1 + len(tag.name)
    return {
        match[1]: match[3] if match[3] is not None else match[4] or ""
        for match in _ATTRIBUTE.finditer(text, start, tag.end)
    }


def _in_other(text: str, offset: int, markup: Markup, around: tuple[OpenElement, ...]) -> Context:
    if markup.kind == "!":
        return Context(Where.OTHER, around, start=offset, end=offset)
    start = markup.start + 2
    end = start + len(markup.name)
    if offset < start or offset > end:
        start = end = offset
    typed = text[start:offset]
    return Context(Where.CLOSING, around, markup.name, typed=typed, start=start, end=end)


def _in_start_tag(text: str, offset: int, tag: Markup, around: tuple[OpenElement, ...]) -> Context:
    start, end = tag.start + 1, tag.start + 1 + len(tag.name)
    if offset <= end:
        attributes = _attributes(text, tag)
        return Context(Where.TAG, around, tag.name, attributes, "", text[start:offset], start, end)
    attributes = _attributes(text, tag)
    for match in _ATTRIBUTE.finditer(text, end, tag.end):
        if match.start() > offset:
            break
        others = {name: it for name, it in attributes.items() if name != match[1]}
        if offset <= match.end(1):
            start, end = match.span(1)
            typed = text[start:offset]
            return Context(Where.ATTRIBUTE, around, tag.name, others, "", typed, start, end)
        if (value := _value_at(text, offset, match)) is not None:
            start, end = value
            typed = text[start:offset]
            return Context(Where.VALUE, around, tag.name, others, match[1], typed, start, end)
    return Context(Where.ATTRIBUTE, around, tag.name, attributes, start=offset, end=offset)


def _value_at(text: str, offset: int, match: re.Match[str]) -> tuple[int, int] | None:
    """Return the range of an attribute's value if the caret is in it.

    Without a quote at its end it ends at the caret, and so it does where that quote is the first
    one of another attribute.
    """
    group = 3 if match[3] is not None else 4
    if match[group] is None:
        return (offset, offset) if match[2] and match.end(2) <= offset <= match.end() else None
    start, end = match.span(group)
    if not start <= offset <= end:
        return None
    is_closed = text[end : end + 1] in _QUOTES and end < len(text)
    return start, end if is_closed and not _NEXT_ATTRIBUTE.search(text, offset, end) else offset


def _in_text(text: str, offset: int, after: int, around: tuple[OpenElement, ...]) -> Context:
    line = max(after, text.rfind("\n", after, offset) + 1)
    before = text[line:offset]
    start = offset - len(before.lstrip(_BLANKS))
    ends = (text.find(mark, offset) for mark in ("<", "\n"))
    end = min((it for it in ends if it >= 0), default=len(text))
    end = offset + len(text[offset:end].rstrip(_BLANKS))
    typed = text[start:offset]
    return Context(Where.TEXT, around, typed=typed, start=start, end=end)
