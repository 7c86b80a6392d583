"""Whether the first bytes of a file fit its name."""

from __future__ import annotations

HEAD = 512
"""Bytes that are enough to tell."""
_ZIP = (b"PK\x03\x04", b"PK\x05\x06")
_GZIP = b"\x1f\x8b"
_UTF8_MARK = b"\xef\xbb\xbf"
_UTF16_TAG = (b"\xff\xfe<\0", b"\xfe\xff\0<")


def misfit(name: str, head: bytes) -> str:
    """Return what the file should begin with and does not; empty if it does.

    Args:
        name: Of the file, with an ending that is known.
        head: Its first `HEAD` bytes, or all of them.
    """
    lower = name.lower()
    if lower.endswith(".zip"):
        return "" if head.startswith(_ZIP) else "a zip archive"
    if lower.endswith((".gz", ".tgz")):
        return "" if head.startswith(_GZIP) else "a gzipped tar archive"
    return "" if _is_xml(head) else "an XML text"


def _is_xml(head: bytes) -> bool:
    """Whether a tag, a comment or a declaration comes first."""
    return head.removeprefix(_UTF8_MARK).lstrip().startswith(b"<") or head.startswith(_UTF16_TAG)
