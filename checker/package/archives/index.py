"""The index of an archive, checked entry by entry before anything is unpacked."""

from __future__ import annotations

import re
import unicodedata
from dataclasses import dataclass, field
from pathlib import Path

from checker.base.errors import RefusedArchive
from checker.base.record import Record

_DRIVE = re.compile(r"[A-Za-z]:")
_UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\ud800-\udfff]")
"""Control characters and surrogates: the Unicode categories Cc and Cs."""
_MAX_SHOWN = 80


class ArchiveLimits(Record):
    """Limits for the content of an archive.

    Attributes:
        entries: Files and folders.
        paths: These, and their parent folders.
        unpacked_bytes: All files together.
        ratio: Unpacked size over the archive's size.
        ratio_floor_bytes: Up to this unpacked size any ratio is allowed: small text packs well.
        name_bytes: One part of a path, in UTF-8; file systems end at 255.
        path_bytes: A whole path, in UTF-8.
        depth: Folders within folders.
    """

    entries: int = 5_000
    paths: int = 10_000
    unpacked_bytes: int = 500_000_000
    ratio: int = 200
    ratio_floor_bytes: int = 10_000_000
    name_bytes: int = 255
    path_bytes: int = 1_024
    depth: int = 50

    def allowed_bytes(self, packed_bytes: int) -> int:
        """Return how much an archive of a size may unpack to."""
        by_ratio = max(self.ratio_floor_bytes, self.ratio * packed_bytes)
        return min(self.unpacked_bytes, by_ratio)


class DamagedArchive(Exception):
    """An archive that contradicts its own format; the text states how."""


def plain_path(name: str) -> str:
    """Return an entry's name without `.`, doubled and closing slashes."""
    return "/".join(part for part in name.split("/") if part not in ("", "."))


class Member(Record):
    """An entry that passed: its path (normal, relative, with `/`) and size in bytes."""

    path: str
    size: int
    is_folder: bool


@dataclass
class ArchiveIndex:
    """Takes the entries of an archive in their order, and refuses the first that may do harm.

    Attributes:
        archive: The archive for messages.
        packed_bytes: Size of the archive.
        limits: What is allowed.
        members: The entries that passed.
    """

    archive: Path
    packed_bytes: int
    limits: ArchiveLimits = field(default_factory=ArchiveLimits)
    members: list[Member] = field(default_factory=list)
    _total: int = 0
    _seen: dict[str, tuple[str, bool]] = field(default_factory=dict)

    @property
    def allowed_bytes(self) -> int:
        """Greatest size of all files together, unpacked."""
        return self.limits.allowed_bytes(self.packed_bytes)

    def add(self, name: str, size: int, *, is_folder: bool) -> Member | None:
        """Check an entry; None represents the archive's own top folder (`./`).

        Raises:
            RefusedArchive: The entry is not allowed.
        """
        if len(self.members) >= self.limits.entries:
            raise self.refusal(name, f"exceeds the limit of {self.limits.entries} entries")
        path = self._checked_path(name)
        if not path:
            if is_folder:
                return None
            raise self.refusal(name, "names no file")
        self._claim(name, path, is_folder)
        self._weigh(name, size)
        member = Member(path, size, is_folder)
        self.members.append(member)
        return member

    def refusal(self, name: str, reason: str) -> RefusedArchive:
        """Return the error that names the entry at fault."""
        shown = "".join(c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in name)
        if len(shown) > _MAX_SHOWN:
            shown = shown[:_MAX_SHOWN] + "…"
        return RefusedArchive(
            self.archive,
            f"is not unpacked: its entry '{shown}' {reason}",
            "pack the package folder again, with plain files and folders only",
        )

    def _checked_path(self, name: str) -> str:
        if _UNPRINTABLE.search(name):
            raise self.refusal(name, "has control characters, or bytes outside UTF-8, in its name")
        if "\\" in name or _DRIVE.match(name):
            raise self.refusal(name, "has a backslash or a drive letter in its name")
        if name.startswith("/"):
            raise self.refusal(name, "is an absolute path")
        path = plain_path(name)
        parts = path.split("/")
        if ".." in parts:
            raise self.refusal(name, "leads out of the archive with '..'")
        longest = max(len(part.encode()) for part in parts)
        if longest > self.limits.name_bytes or len(path.encode()) > self.limits.path_bytes:
            raise self.refusal(name, "has a name that is too long")
        if len(parts) > self.limits.depth:
            raise self.refusal(name, f"is more than {self.limits.depth} folders deep")
        return path

    def _claim(self, name: str, path: str, is_folder: bool) -> None:
        """Refuse a path, or a folder on the way to it, that clashes with an earlier one.

        The way goes up from the path, and ends at a folder that is known: so are those above it.
        """
        spelling, as_folder = path, is_folder
        while spelling:
            key = unicodedata.normalize("NFC", spelling).casefold()
            earlier = self._seen.get(key)
            if earlier is not None:
                self._compare(name, (spelling, as_folder), earlier)
                return
            if len(self._seen) >= self.limits.paths:
                most = self.limits.paths
                raise self.refusal(name, f"exceeds the limit of {most} files and folders")
            self._seen[key] = (spelling, as_folder)
            spelling, as_folder = spelling.rpartition("/")[0], True

    def _compare(self, name: str, path: tuple[str, bool], earlier: tuple[str, bool]) -> None:
        """Refuse a path, and whether it is a folder, unless it is that of an earlier folder."""
        if earlier[0] != path[0]:
            raise self.refusal(name, f"differs from '{earlier[0]}' only in upper and lower case")
        if earlier[1] != path[1]:
            raise self.refusal(name, "is both a file and a folder")
        if not path[1]:
            raise self.refusal(name, "appears twice")

    def _weigh(self, name: str, size: int) -> None:
        if size < 0:
            raise self.refusal(name, "has a negative size")
        self._total += size
        if self._total > self.allowed_bytes:
            raise self.overweight(name)

    def overweight(self, name: str) -> RefusedArchive:
        """Return the error for an entry that makes the archive unpack to too much."""
        if self.allowed_bytes == self.limits.unpacked_bytes:
            most = f"the {self.limits.unpacked_bytes / 1e6:g} MB allowed"
        else:
            most = f"{self.limits.ratio} times the size of the archive"
        return self.refusal(name, f"makes it unpack to more than {most}")
