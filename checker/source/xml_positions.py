"""Tags of a text that expat has read: their places, or a fault."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from checker.base.record import Record
from checker.finding import Edit
from checker.source.text import Span


@dataclass(slots=True)
class TagPosition:
    """Content of one start tag, and the character offsets of its element.

    Attributes:
        tag: Name as written, with its prefix.
        attributes: Values by names as written; declarations of namespaces are none.
        start: The offset of the start tag's `<`.
        start_end: The offset behind the start tag's `>`.
        end_start: The offset of the end tag's `<`; equal to `start_end` for `<a/>`.
        end: The offset behind the end tag's `>`.
    """

    tag: str
    attributes: Mapping[str, str]
    start: int
    start_end: int
    end_start: int
    end: int


class XmlFault(Record, eq=False):
    """Reason and place of a fault for which a text is not well-formed XML.

    `edit` corrects it, where only one correction is possible.
    """

    span: Span
    message: str
    hint: str = ""
    edit: Edit | None = None


class LocatedTags(Record):
    """All tags of a text in document order, and the text as the parsers are to read it."""

    text: str
    tags: list[TagPosition]
    tolerated: tuple[XmlFault, ...]
