"""Bounded reading of one text file."""

from __future__ import annotations

import codecs
import re
from pathlib import Path

from checker.base.files import NotReadable, read_bytes
from checker.source.text import SourceText

# Bytes to text: byte order marks, XML declarations, and what is no text at all.


_BOMS = (
    (codecs.BOM_UTF8, "utf-8"),
    (codecs.BOM_UTF32_LE, "utf-32-le"),
    (codecs.BOM_UTF32_BE, "utf-32-be"),
    (codecs.BOM_UTF16_LE, "utf-16-le"),
    (codecs.BOM_UTF16_BE, "utf-16-be"),
)
_DECLARED = re.compile(rb"""^\s*<\?xml[^>]*encoding\s*=\s*["']([A-Za-z0-9._-]+)["']""")
# A file may declare any codec that Python has, and some of those take quadratic time.
_KNOWN = re.compile(
    r"utf-?(?:8|16|32)(?:-?[lb]e)?|latin-?1|iso-8859-\d{1,2}|windows-125\d|cp125\d"
    r"|koi8-[ru]|shift_jis|euc-(?:jp|kr)|gb2312|gbk|gb18030|big5",
    re.IGNORECASE,
)


class NotText(ValueError):
    """The bytes are no text in the encoding that they announce."""


def encoding_of(data: bytes) -> str:
    """Return the encoding that a text file announces; UTF-8 when it announces none, or ASCII.

    TinyXML-2, with which Gazebo and urdfdom read, takes every file for UTF-8.
    """
    for mark, name in _BOMS:
        if data.startswith(mark):
            return name
    declared = _DECLARED.match(data[:200])
    name = declared.group(1).decode("ascii").lower() if declared else "utf-8"
    return "utf-8" if name in ("ascii", "us-ascii") else name


def encode_like(text: str, data: bytes) -> bytes:
    """Return a text in the encoding of `data`, with its byte order mark if it has one.

    Raises:
        UnicodeError: The encoding lacks a character of the text.
    """
    mark = next((mark for mark, _ in _BOMS if data.startswith(mark)), b"")
    return mark + text.encode(encoding_of(data))


def decode(data: bytes) -> str:
    """Decode a text file: by byte order mark, by XML declaration, else as UTF-8.

    A byte order mark is dropped, line endings stay as they are.

    Raises:
        NotText: The bytes do not fit the encoding, hold NUL characters, or name an unknown one.
    """
    encoding = encoding_of(data)
    mark = next((mark for mark, _ in _BOMS if data.startswith(mark)), b"")
    data = data[len(mark) :]
    if not _KNOWN.fullmatch(encoding):
        raise NotText(f"declares the unknown encoding {encoding!r}")
    try:
        text = data.decode(encoding)
    except LookupError:
        raise NotText(f"declares the unknown encoding {encoding!r}") from None
    except UnicodeError as error:
        where = getattr(error, "start", 0)
        raise NotText(f"is not {encoding.upper()} text: byte {where} cannot be decoded") from None
    if "\0" in text:
        raise NotText("contains NUL characters, so it is a binary file")
    return text


TEXT_LIMIT = 20_000_000
"""Bytes; the largest text of 99 real packages is below 1 MB."""


def read_text(location: Path, path: str, limit: int = TEXT_LIMIT) -> SourceText | NotReadable:
    """Read a text file; `path` becomes the source's file."""
    data = read_bytes(location, path, limit)
    if isinstance(data, NotReadable):
        return data
    try:
        return SourceText(path, decode(data), encoding=encoding_of(data))
    except NotText as error:
        text = _python(data) if path.endswith(".py") else ""
        return SourceText(path, text) if text else NotReadable(path, str(error))


def _python(data: bytes) -> str:
    """Return a program with comments that are not UTF-8, which Python imports; else nothing."""
    text = data.decode("utf-8", "replace")
    outside = (line.partition("#")[0] for line in text.splitlines())
    return "" if "\0" in text or any("\ufffd" in part for part in outside) else text
