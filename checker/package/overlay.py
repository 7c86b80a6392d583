"""Texts that replace the content of files: unsaved text of an editor, and the result of a fix.

Every file of a package is read through the overlay of its workspace.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from msgspec import field
from msgspec.structs import replace

from checker.base.files import NotReadable, read_bytes
from checker.base.record import Record
from checker.package.index import EntryKind, FileEntry, FileIndex
from checker.source.text import SourceText
from checker.source.text_file import TEXT_LIMIT, read_text


class OverlayText(Record):
    """A text, and the encoding in which its file contains or will hold it."""

    text: str
    encoding: str = "utf-8"

    @property
    def content(self) -> bytes:
        """The text as a file; characters that the encoding lacks are replaced."""
        return self.text.encode(self.encoding, "replace")


class Overlay(Record, eq=False):
    """Texts by the places of their files on disk, links resolved; the files may not exist yet."""

    texts: Mapping[Path, OverlayText] = field(default_factory=dict)

    def read(self, location: Path, path: str, limit: int = TEXT_LIMIT) -> SourceText | NotReadable:
        """Return a file's text.

        Args:
            location: The place on disk, links resolved.
            path: What to call it.
            limit: The greatest size of a file that is read from disk, bytes.
        """
        own = self.texts.get(location)
        return SourceText(path, own.text, own.encoding) if own else read_text(location, path, limit)

    def read_bytes(self, location: Path, path: str, limit: int) -> bytes | NotReadable:
        """Return a file's content, of at most `limit` bytes."""
        own = self.texts.get(location)
        return own.content[:limit] if own else read_bytes(location, path, limit)

    def indexed(self, index: FileIndex, root: Path) -> FileIndex:
        """Return an index with the sizes of these texts, and with files that are not on disk yet.

        Args:
            index: The index of the folder on disk.
            root: The path of the folder, links resolved.
        """
        if not self.texts:
            return index
        entries = dict(index.entries)
        missing = {location for location in self.texts if location.is_relative_to(root)}
        for path, entry in index.entries.items():
            if own := self.texts.get(entry.location):
                entries[path] = replace(entry, size=len(own.content))
                missing.discard(entry.location)
        file = EntryKind.FILE
        for location in missing:
            path, size = location.relative_to(root).as_posix(), len(self.texts[location].content)
            entries[path] = FileEntry(path, file, size, location, file)
        return replace(index, entries=dict(sorted(entries.items())))

    def changed_paths(self, other: Overlay) -> frozenset[Path]:
        """Return the places of files that contain another text in another overlay."""
        every = {*self.texts, *other.texts}
        return frozenset(at for at in every if self.texts.get(at) != other.texts.get(at))
