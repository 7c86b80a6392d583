"""Text of a package in GitHub's Markdown, where it must stay text: no mark-up, link or mention."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from typing import TypeVar

from checker.base.words import plain

T = TypeVar("T")

_UNSEEN = "\N{ZERO WIDTH SPACE}"
_AT, _HASH = "&#64;", "&#35;"
_MARKS = re.compile(
    r"""[$&*<>\[\\\]`|~@#]
    | (?<![^\W_])_ | _(?![^\W_])   # inside a word it marks nothing
    | :(?=//) | (?<=www)\.        # else these begin a link
    """,
    re.VERBOSE,
)


def escaped(text: str) -> str:
    """Return text that Markdown, HTML in it, and GitHub's own links leave alone.

    Marks become numbers of characters, which no parser takes for marks again. Mentions and issue
    numbers are looked for when the page is ready, so that a character of no width has to part them.
    """
    return _numbered(plain(text)).replace(_AT, _AT + _UNSEEN).replace(_HASH, _HASH + _UNSEEN)


def _numbered(text: str) -> str:
    return _MARKS.sub(lambda match: f"&#{ord(match[0])};", text)


def with_code(text: str) -> str:
    """Return text of a rule's page with what is in backticks as code."""
    pieces = text.split("`")
    if len(pieces) % 2 == 0:
        return escaped(text)
    return "".join(code(piece) if n % 2 else escaped(piece) for n, piece in enumerate(pieces))


def code(text: str) -> str:
    """Return text to be shown as code, in which GitHub looks for no mentions.

    Tags do it, as no fence of backticks is possible in a table.
    """
    return f"<code>{_numbered(plain(text))}</code>"


def fitting(items: Sequence[T], line: Callable[[T], str], room: int) -> tuple[list[str], int]:
    """Return the lines of the first items, as many as fit, and the number of the others.

    Args:
        items: What to write.
        line: Writes one item, without the line's end; not called for items without room.
        room: Bytes in UTF-8.
    """
    kept: list[str] = []
    for item in items:
        written = line(item)
        room -= len(written.encode("utf-8")) + 1
        if room < 0:
            break
        kept.append(written)
    return kept, len(items) - len(kept)
