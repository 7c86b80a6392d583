"""The characters between two tags that are no text: comments, instructions, CDATA brackets."""

from __future__ import annotations

import re

_OPENING = re.compile(r"<!--|<\?|<!\[CDATA\[")
_CLOSING = {"<!--": "-->", "<?": "?>", "<![CDATA[": "]]>"}


def blank_markup(text: str) -> str:
    """Return a text of the same length with blanks for what is no text.

    Args:
        text: What stands between two tags of a well-formed document.
    """
    if "<" not in text:
        return text
    parts: list[str] = []
    at = 0
    while opening := _OPENING.search(text, at):
        closing = _CLOSING[opening.group()]
        inside_end = text.find(closing, opening.end())
        inside_end = len(text) if inside_end < 0 else inside_end
        inside = text[opening.end() : inside_end]
        parts += [text[at : opening.start()], " " * len(opening.group())]
        parts.append(inside if closing == "]]>" else " " * len(inside))
        parts.append(" " * len(closing))
        at = inside_end + len(closing)
    return "".join([*parts, text[at:]])[: len(text)]
