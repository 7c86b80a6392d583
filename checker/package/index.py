"""Index of a folder: every file, folder and link, by its path."""

from __future__ import annotations

import posixpath
from enum import StrEnum
from functools import cached_property
from pathlib import Path

from checker.base.record import Record


class EntryKind(StrEnum):
    """Kind of an entry; `SPECIAL` are devices, pipes and sockets, which are never opened."""

    FILE = "file"
    FOLDER = "folder"
    LINK = "link"
    SPECIAL = "special"


class LinkState(StrEnum):
    """Target of a symbolic link.

    `OK`: within the package. `SIBLING`: into another package of the workspace. Both are followed.
    `OUTSIDE`, `DANGLING` and `LOOP` (also: to a folder around the link) are not.
    """

    OK = "ok"
    SIBLING = "sibling"
    DANGLING = "dangling"
    OUTSIDE = "outside"
    LOOP = "loop"


_BROKEN = ("bad_", "broken_", "invalid_", "malformed_")


class FileEntry(Record):
    """A file, folder or link.

    Attributes:
        path: Relative to the package folder, with `/`.
        kind: What is at the path.
        size: The size of the file, in bytes; that of the target when a link is followed; 0 for
            folders.
        location: The place of the content on disk, links resolved.
        content: `FILE` or `FOLDER` when there is content to read, a followed link's target
            included; otherwise the kind.
        target_state: The kind of a link's target; None for other entries.
        target: The link's text.
    """

    path: str
    kind: EntryKind
    size: int
    location: Path
    content: EntryKind
    target_state: LinkState | None = None
    target: str = ""

    @property
    def is_file(self) -> bool:
        """True if it can be read as a file."""
        return self.content is EntryKind.FILE

    @property
    def is_folder(self) -> bool:
        """True if it is a folder, or a followed link to one."""
        return self.content is EntryKind.FOLDER

    @property
    def is_of_tests(self) -> bool:
        """True if it is in a folder of tests, which may be about another robot."""
        return is_of_tests(self.path)

    @property
    def is_broken_for_tests(self) -> bool:
        """True if its name says that a test expects its readers to refuse it."""
        return self.is_of_tests and self.path.rsplit("/", 1)[-1].lower().startswith(_BROKEN)


class IndexFault(Record):
    """Part of a folder that could not be indexed or read, and the reason."""

    path: str
    reason: str


class FileIndex(Record, eq=False, dict=True):
    """Index of the content of a folder.

    Attributes:
        entries: The entries by path, sorted.
        faults: What could not be read: unreadable files and folders, limits exceeded.
    """

    entries: dict[str, FileEntry]
    faults: tuple[IndexFault, ...] = ()

    def find(self, path: str) -> FileEntry | None:
        """Return the entry at a normal path (see `normal_path`), or None."""
        return self.entries.get(path)

    @cached_property
    def files(self) -> tuple[FileEntry, ...]:
        """Everything that can be read as a file; not what editors keep in hidden folders."""
        files = (entry for entry in self.entries.values() if entry.is_file)
        return tuple(entry for entry in files if not is_hidden(entry.path))

    @cached_property
    def links(self) -> tuple[FileEntry, ...]:
        """All symbolic links, wherever they lead."""
        return tuple(entry for entry in self.entries.values() if entry.kind is EntryKind.LINK)

    def with_suffix(self, *suffixes: str) -> tuple[FileEntry, ...]:
        """Return the files that end in one of the suffixes (`.sdf`), in any case."""
        return tuple(entry for entry in self.files if entry.path.lower().endswith(suffixes))

    def similar_files(self, path: str) -> tuple[str, ...]:
        """Return files that may be meant by a path that does not exist.

        First those that differ in case only, then those of other extension (`.jpg` for `.png`).
        """
        path = posixpath.normpath(path)
        alike = self._by_stem.get(_stem(path), ())
        return tuple(sorted(alike, key=lambda other: other.casefold() != path.casefold()))

    def ending(self, path: str) -> list[str]:
        """Return the files in some folder whose paths end in a path."""
        alike = self._by_name.get(posixpath.basename(path), ())
        return [other for other in alike if other.endswith(f"/{path}")]

    @cached_property
    def _by_name(self) -> dict[str, list[str]]:
        names: dict[str, list[str]] = {}
        for entry in self.files:
            names.setdefault(posixpath.basename(entry.path), []).append(entry.path)
        return names

    @cached_property
    def _by_stem(self) -> dict[str, list[str]]:
        stems: dict[str, list[str]] = {}
        for entry in self.files:
            stems.setdefault(_stem(entry.path), []).append(entry.path)
        return stems


def _stem(path: str) -> str:
    return posixpath.splitext(path)[0].casefold()


def is_of_tests(path: str) -> bool:
    """Return whether a path is in a folder of tests."""
    return not {"test", "tests"}.isdisjoint(path.split("/")[:-1])


_OF_BUILDS = {".devcontainer", ".docker", ".github", ".gitlab", ".vscode"}
"""Hidden folders whose files say how a package is built, and for which distribution."""


def is_hidden(path: str) -> bool:
    """Return whether a path is in a hidden folder, such as `.history` of an editor."""
    folders = path.split("/")[:-1]
    return any(it.startswith(".") and it not in _OF_BUILDS for it in folders)


_RETIRED = {"old", "past", "backup", "archive", "archived", "deprecated", "unused", "obsolete"}


def is_retired(path: str) -> bool:
    """Return whether a path is in a folder whose name says that its files are not used any more."""
    return not _RETIRED.isdisjoint(path.lower().split("/")[:-1])


def normal_path(path: str) -> str | None:
    """Return a relative path without `.` and inner `..`, or None if it is absolute or empty.

    A path that leaves the folder keeps its leading `..`.
    """
    if not path or path.startswith("/") or "\0" in path or "\\" in path or path[1:2] == ":":
        return None
    return posixpath.normpath(path)
