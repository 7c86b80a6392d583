"""Walking a folder to index it: bounded, and no link is followed blindly."""

from __future__ import annotations

import os
import stat
from collections.abc import Callable
from itertools import islice
from pathlib import Path

from checker.package.index import EntryKind, FileEntry, FileIndex, IndexFault, LinkState
from checker.package.kind import BUILT, IGNORED, is_environment, is_made_by_colcon

MAX_ENTRIES = 20_000
MAX_DEPTH = 50
SKIPPED_FOLDERS = frozenset({".git", ".ipynb_checkpoints"})

Inside = Callable[[Path], bool]
"""Function that returns whether a real path belongs to an available sibling package."""


def build_index(root: Path, inside: Inside) -> FileIndex:
    """Index a folder.

    Args:
        root: The folder, links resolved.
        inside: Whether a link's target outside the folder belongs to a sibling package.
    """
    return _Walk(root, inside).run()


def entry_at(location: Path, path: str, root: Path, inside: Inside) -> FileEntry | None:
    """Return the file or folder at a place on disk that no index lists, or None.

    Args:
        location: Its expected place; links on the way are resolved.
        path: The name for the entry.
        root: The package folder.
        inside: Whether a target outside the folder belongs to a sibling package.
    """
    try:
        real = location.resolve(strict=True)
        if not (real.is_relative_to(root) or inside(real)):
            return None
        status = real.stat()
    except (OSError, RuntimeError, ValueError):
        return None
    content = _kind(status.st_mode)
    size = status.st_size if content is EntryKind.FILE else 0
    return FileEntry(path, content, size, real, content)


def _kind(mode: int) -> EntryKind:
    if stat.S_ISREG(mode):
        return EntryKind.FILE
    return EntryKind.FOLDER if stat.S_ISDIR(mode) else EntryKind.SPECIAL


class _Walk:
    """One pass over a folder, breadth bounded by `MAX_ENTRIES` and depth by `MAX_DEPTH`."""

    def __init__(self, root: Path, inside: Inside) -> None:
        self.root = root
        self.inside = inside
        self.entries: dict[str, FileEntry] = {}
        self.faults: list[IndexFault] = []

    def run(self) -> FileIndex:
        pending = [("", str(self.root))]
        while pending and len(self.entries) <= MAX_ENTRIES:
            prefix, location = pending.pop()
            for item in self._items(prefix, location):
                entry = self._entry(prefix + _printable(item.name), item)
                if entry is None:
                    continue
                self.entries[entry.path] = entry
                if entry.kind is EntryKind.FOLDER:
                    pending.append((f"{entry.path}/", item.path))
        if len(self.entries) > MAX_ENTRIES:
            self._fault("", f"contains more than {MAX_ENTRIES} files; the rest is not checked")
        return FileIndex(dict(sorted(self.entries.items())), tuple(self.faults))

    def _items(self, prefix: str, location: str) -> list[os.DirEntry[str]]:
        if prefix.count("/") >= MAX_DEPTH:
            self._fault(prefix[:-1], f"is more than {MAX_DEPTH} folders deep")
            return []
        room = MAX_ENTRIES + 1 - len(self.entries)
        try:
            with os.scandir(location) as items:
                kept = (item for item in items if item.name not in SKIPPED_FOLDERS)
                found = list(islice(kept, room))
        except OSError as error:
            self._fault(prefix[:-1], f"cannot be listed: {error.strerror}")
            return []
        names = [item.name for item in found]
        if prefix and (is_environment(names) or is_made_by_colcon(Path(location), names)):
            return []
        marks = [item for item in found if item.name in IGNORED]
        return marks if marks and Path(prefix).name in BUILT else found

    def _entry(self, path: str, item: os.DirEntry[str]) -> FileEntry | None:
        try:
            if item.is_symlink():
                return self._link(path, Path(item.path))
            status = item.stat(follow_symlinks=False)
        except OSError as error:
            self._fault(path, f"cannot be read: {error.strerror}")
            return None
        kind = _kind(status.st_mode)
        if kind is EntryKind.FILE and not os.access(item.path, os.R_OK):
            self._fault(path, "cannot be read: permission denied")
        size = status.st_size if kind is EntryKind.FILE else 0
        return FileEntry(path, kind, size, Path(item.path), kind)

    def _link(self, path: str, location: Path) -> FileEntry:
        target = _printable(str(location.readlink()))
        state = self._state(location)
        if state in (LinkState.OK, LinkState.SIBLING):
            entry = entry_at(location, path, self.root, self.inside)
            if entry is not None:
                return FileEntry(
                    path, EntryKind.LINK, entry.size, entry.location, entry.content, state, target
                )
            state = LinkState.DANGLING
        return FileEntry(path, EntryKind.LINK, 0, location, EntryKind.LINK, state, target)

    def _state(self, location: Path) -> LinkState:
        try:
            real = location.resolve(strict=True)
        except (FileNotFoundError, NotADirectoryError):
            return LinkState.DANGLING
        except (OSError, RuntimeError) as error:
            return LinkState.OUTSIDE if isinstance(error, PermissionError) else LinkState.LOOP
        if location.parent.is_relative_to(real):
            return LinkState.LOOP
        if real.is_relative_to(self.root):
            return LinkState.OK
        return LinkState.SIBLING if self.inside(real) else LinkState.OUTSIDE

    def _fault(self, path: str, reason: str) -> None:
        self.faults.append(IndexFault(path, reason))


def _printable(name: str) -> str:
    """Return a name that can be printed: bytes that are not UTF-8 become replacement marks."""
    return name.encode("utf-8", "surrogateescape").decode("utf-8", "replace")
