"""A spawner's text without its comments, every other character where it was."""

from __future__ import annotations

import re

# `#{` interpolates, and `#` behind a character is a fragment (`a#b`), so neither is a comment.
_COMMENT_START = re.compile(r"<!--|(?<!\S)#(?!\{)|^=begin\b|^__END__$", re.MULTILINE)
_BLOCK_END = re.compile(r"^=end\b.*$", re.MULTILINE)
_NOT_LINE_END = re.compile(r"[^\r\n]")


def blank_comments(text: str) -> str:
    """Replace Ruby comments, and the XML comments inside of strings, by blanks."""
    kept: list[str] = []
    at = 0
    unclosed = False
    while start := _COMMENT_START.search(text, at):
        end = -1 if unclosed and start.group() == "<!--" else _end(text, start)
        kept.append(text[at : start.start()])
        if end < 0:
            unclosed = True
            end = start.end()
            kept.append(start.group())
        else:
            kept.append(_NOT_LINE_END.sub(" ", text[start.start() : end]))
        at = end
    return "".join([*kept, text[at:]])


def _end(text: str, start: re.Match[str]) -> int:
    """Return where a comment ends, or -1 for an XML comment that never does."""
    if start.group() == "<!--":
        end = text.find("-->", start.end())
        return end + 3 if end >= 0 else -1
    if start.group() == "#":
        end = text.find("\n", start.end())
        return end if end >= 0 else len(text)
    block_end = _BLOCK_END.search(text, start.end()) if start.group() == "=begin" else None
    return block_end.end() if block_end else len(text)
