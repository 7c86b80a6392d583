"""The Markdown of a hover: a title, and lines below it."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from checker.base.words import count, plain, shortened
from checker.rulebook.pages import escaped

_CODE_LIMIT = 200
"""Characters of a name or value that are shown."""
_BACKTICKS = re.compile(r"`+")
_MOST = 8
"""Names of a list that are shown."""


def code(text: str) -> str:
    """Return a name or value of a file as code."""
    text = shortened(plain(text.strip()), _CODE_LIMIT) or " "
    fence = "``" if "`" in text else "`"
    space = " " if "`" in text else ""
    return f"{fence}{space}{_BACKTICKS.sub('`', text)}{space}{fence}"


def escaped_words(text: str) -> str:
    """Return words of a file or a table, in which Markdown marks nothing."""
    return escaped(shortened(plain(text), _CODE_LIMIT))


def card(title: str, rows: Iterable[tuple[str, str]], note: str = "") -> str:
    """Return a hover.

    Args:
        title: The title in Markdown.
        rows: Each a label and what it states, in Markdown; those that state nothing are left out.
        note: A paragraph below, in Markdown.
    """
    items = [f"- {label}: {text}" for label, text in rows if text]
    return "\n\n".join(filter(None, (title, "\n".join(items), note)))


def names(items: Sequence[str]) -> str:
    """Return names as code, the first eight of them."""
    shown = ", ".join(map(code, items[:_MOST]))
    more = len(items) - _MOST
    return f"{shown} and {count(more, 'more')}".replace("mores", "more") if more > 0 else shown
