"""Links of a sheet to measurements of the real robot: videos, recordings, logs."""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.source.markdown import MAX_LENGTH
from checker.source.text import SourceText, Span

_COMMENT = re.compile(r"<!--.*?(?:-->|\Z)", re.DOTALL)
_URL = re.compile(r"https?://[^\s)>\]\\]{3,2000}")
_PLACEHOLDER = re.compile(r"x{3,}|\.\.\.|…|//(?:www\.)?example\.", re.IGNORECASE)
_RECORDED = re.compile(
    r"\b(?:validat\w*|tests?|testing|videos?|record\w*|(?:data)?logs?|bags?|bagfiles?|measure\w*"
    r"|experiments?|endurance|(?:top |max\w* )?speed|turning)\b",
    re.IGNORECASE,
)
_SHARED = re.compile(
    r"//(?:[\w-]+\.)*(?:youtube\.com|youtu\.be|vimeo\.com|drive\.google\.com|docs\.google\.com"
    r"|dropbox\.com|onedrive\.live\.com|1drv\.ms|box\.com)/",
    re.IGNORECASE,
)
"""Where teams put videos and logs; manufacturers' pages are elsewhere."""


def validation_links(source: SourceText, start: int, end: int) -> Iterator[Span]:
    """Yield links to measurements; placeholders such as `https://youtu.be/xxxx` are none.

    Args:
        source: The sheet.
        start: Where its section on validation starts: in it, words in the line such as `speed test`
            say what a link is; elsewhere only its host does.
        end: Where that section ends.
    """
    # Blanks of the same length keep the offsets.
    text = _COMMENT.sub(lambda found: " " * len(found.group()), source.text[:MAX_LENGTH])
    offset = 0
    for line in text.splitlines(keepends=True):
        named = start <= offset < end and _RECORDED.search(_URL.sub(" ", line)) is not None
        for found in _URL.finditer(line):
            shared = _SHARED.search(found.group()) is not None
            if (named or shared) and not _PLACEHOLDER.search(found.group()):
                yield Span(source, offset + found.start(), offset + found.end())
        offset += len(line)
