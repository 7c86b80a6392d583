"""The files that are open in the editor, as it shows them."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from urllib.parse import unquote, urlsplit
from urllib.request import url2pathname

from checker.base.files import NotReadable, read_bytes
from checker.base.record import Record
from checker.package.formats import xml_suffixes
from checker.package.overlay import Overlay, OverlayText
from checker.source.text import SourceText
from checker.source.text_file import TEXT_LIMIT, encoding_of


class Document(Record, eq=False, dict=True):
    """An open file.

    Attributes:
        uri: The URI as the client spells it.
        path: Its path, links resolved; it may not exist yet.
        version: The client's version of the text.
        text: What the editor shows.
        encoding: The encoding of the file on disk.
    """

    uri: str
    path: Path
    version: int
    text: str
    encoding: str = "utf-8"

    @cached_property
    def source(self) -> SourceText:
        """The text with its lines."""
        return SourceText(self.path.name, self.text, self.encoding)

    @property
    def is_xml(self) -> bool:
        """True if the file is XML, by its name or else by its first characters."""
        name = self.path.name.lower()
        return name.endswith(xml_suffixes()) or self.text.lstrip("\ufeff \t\r\n").startswith("<")

    def with_text(self, text: str, version: int) -> Document:
        """Return the file with another text."""
        return Document(self.uri, self.path, version, text, self.encoding)


def open_document(uri: str, version: int, text: str) -> Document | None:
    """Return a file as it was opened; None for what is on no disk, such as a draft."""
    path = path_of(uri)
    if path is None:
        return None
    data = read_bytes(path, path.name, TEXT_LIMIT)
    encoding = "utf-8" if isinstance(data, NotReadable) else encoding_of(data)
    return Document(uri, path, version, text, encoding)


def path_of(uri: str) -> Path | None:
    """Return the path of the file of a URI, links resolved; None for other schemes."""
    try:
        parts = urlsplit(uri)
        if parts.scheme != "file" or parts.netloc not in ("", "localhost"):
            return None
        return Path(url2pathname(unquote(parts.path))).resolve()
    except (OSError, RuntimeError, ValueError):  # a loop of links, or a name that no file has
        return None


def overlay_of(documents: Mapping[str, Document]) -> Overlay:
    """Return the overlay with the open files, for reading packages."""
    return Overlay(
        {each.path: OverlayText(each.text, each.encoding) for each in documents.values()}
    )
