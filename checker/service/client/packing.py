"""A folder packed for sending: plain files and folders, as a repository would have them."""

from __future__ import annotations

import shutil
import zipfile
from pathlib import Path
from typing import BinaryIO

from checker.base.errors import UnreadableInput
from checker.base.words import count, listed, plain, shortened
from checker.package.archives.index import ArchiveLimits
from checker.package.index import EntryKind, FileEntry, FileIndex
from checker.package.walk import MAX_ENTRIES, build_index

LEFT_OUT = frozenset({".git", ".hg", ".svn", "__pycache__"})
"""Folders that are no part of what is checked."""
_LONG_AGO = (1980, 1, 1, 0, 0, 0)
"""For every file, so that the same content makes the same archive, and is checked once."""
_NAMED = 3
_ADVICE = "leave out what the package does not need"


def pack(folder: Path, archive: BinaryIO, limits: ArchiveLimits | None = None) -> tuple[str, ...]:
    """Write a folder into a ZIP archive, below its own name.

    Args:
        folder: A package, or a folder of packages.
        archive: Where the archive goes, open for writing.
        limits: What an archive may hold.

    Returns:
        What is left out of it and why, in sentences without their dots.

    Raises:
        UnreadableInput: It holds more than is allowed, or what cannot be read.
    """
    root = folder.resolve()
    index = build_index(root, lambda _: False)
    entries = [each for each in index.entries.values() if not LEFT_OUT & {*each.path.split("/")}]
    packed = [each for each in entries if each.kind in (EntryKind.FILE, EntryKind.FOLDER)]
    _refuse(folder, index, packed, limits or ArchiveLimits())
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for each in packed:
            _add(folder, file, root.name, each)
    return tuple(_words_of_left_out(entries))


def _refuse(folder: Path, index: FileIndex, packed: list[FileEntry], limits: ArchiveLimits) -> None:
    """Refuse what the service would refuse, before anything is sent.

    Raises:
        UnreadableInput: There is too much, or something cannot be read.
    """
    if index.faults:
        fault = index.faults[0]
        what = f"'{plain(shortened(fault.path, 200))}' in it {plain(fault.reason)}"
        raise UnreadableInput(folder, f"is not sent: {what}", _ADVICE)
    if len(packed) > min(limits.entries, MAX_ENTRIES):
        reason = f"holds {len(packed)} files and folders, expected {limits.entries} or fewer"
        raise UnreadableInput(folder, reason, _ADVICE)
    size = sum(each.size for each in packed)
    if size > limits.unpacked_bytes:
        reason = f"holds {size / 1e6:.0f} MB, expected {limits.unpacked_bytes / 1e6:.0f} or less"
        raise UnreadableInput(folder, reason, _ADVICE)


def _add(folder: Path, archive: zipfile.ZipFile, name: str, entry: FileEntry) -> None:
    is_folder = entry.kind is EntryKind.FOLDER
    info = zipfile.ZipInfo(f"{name}/{entry.path}{'/' * is_folder}", _LONG_AGO)
    info.external_attr = (0o40755 if is_folder else 0o100644) << 16
    info.compress_type = zipfile.ZIP_DEFLATED
    if is_folder:
        archive.writestr(info, b"")
        return
    try:
        with entry.location.open("rb") as source, archive.open(info, "w") as target:
            shutil.copyfileobj(source, target)
    except (OSError, UnicodeEncodeError, ValueError) as error:
        problem = getattr(error, "strerror", None) or "its name cannot be written"
        reason = f"cannot be packed: '{plain(shortened(entry.path, 200))}': {problem}"
        raise UnreadableInput(folder, reason, "check its permissions and names") from None


def _words_of_left_out(entries: list[FileEntry]) -> list[str]:
    kinds = {EntryKind.LINK: "link", EntryKind.SPECIAL: "special file"}
    words = []
    for kind, noun in kinds.items():
        paths = [plain(shortened(each.path, 200)) for each in entries if each.kind is kind]
        if paths:
            more = [f"{len(paths) - _NAMED} more"] * (len(paths) > _NAMED)
            named = listed([*paths[:_NAMED], *more])
            words.append(f"{count(len(paths), noun)} left out, as archives hold none: {named}")
    return words
