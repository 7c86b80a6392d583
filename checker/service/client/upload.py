"""Content of an upload: an archive or model file as it is, or a packed folder."""

from __future__ import annotations

import io
import secrets
import shutil
import tempfile
import zipfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any, BinaryIO

from msgspec import field

from checker.base.errors import CheckerError, UnreadableInput
from checker.base.output import Say, say_nothing
from checker.base.record import Record
from checker.base.words import and_list, count, plain, shortened
from checker.package.archives.index import ArchiveLimits
from checker.package.formats import single_file_suffixes
from checker.package.index import EntryKind, FileEntry, FileIndex
from checker.package.inputs import ARCHIVE_SUFFIXES
from checker.package.kind import enclosing_package
from checker.package.no_package import reason_not_checked
from checker.package.walk import MAX_ENTRIES, build_index

LEFT_OUT = frozenset({".git", ".hg", ".svn", "__pycache__"})
"""Folders that are no part of what is checked."""
_LONG_AGO = (1980, 1, 1, 0, 0, 0)
"""For every file, so that the same content makes the same archive, and is checked once."""
_NAMED = 3
_ADVICE = "remove files that the package does not need"
_LARGE = 1_000_000
"""Bytes of a file from which on it is stated how much of it is sent."""


class Upload(Record):
    """A file to send.

    Attributes:
        file: The file, which is sent with its name.
        profile: The profile of the check; empty for the service's own choice.
        say: Called with the share that is sent, once for each tenth.
        key: The key by which a service recognises repetitions.
    """

    file: Path
    profile: str = ""
    say: Say = say_nothing
    key: str = field(default_factory=secrets.token_urlsafe)

    @contextmanager
    def form(self) -> Iterator[Mapping[str, Any]]:
        """Open the file, and give the members of a request that sends it piece by piece.

        Raises:
            CheckerError: It cannot be read any more.
        """
        name = self.file.name.encode("utf-8", "replace").decode()
        fields = {"profile": self.profile} if self.profile else {}
        try:
            with _Counted(self.file, self.say) as file:
                yield {"data": fields, "files": {"file": (name, file, "application/octet-stream")}}
        except OSError as error:
            raise CheckerError(f"{self.file} cannot be read: {error.strerror or error}") from None


class _Counted(io.FileIO):
    """A file that states how much of it has been read."""

    def __init__(self, path: Path, say: Say) -> None:
        super().__init__(path)
        self._size, self._say, self._tenths = path.stat().st_size, say, 0

    def read(self, size: int | None = -1) -> bytes:
        piece = super().read(size) or b""
        tenths = 10 * self.tell() // max(self._size, 1)
        if tenths > self._tenths and self._size > _LARGE:
            self._tenths = tenths
            self._say(f"uploaded {10 * tenths} %")
        return piece


@contextmanager
def file_to_send(path: Path, say: Say) -> Iterator[Path]:
    """Yield an archive or a model file as it is, a folder packed.

    Args:
        path: The path of a package.
        say: Called with the files that are left out.

    Raises:
        UnreadableInput: It is none of them, or cannot be read.
    """
    if not _is_folder(path):
        _refuse_file(path)
        around = enclosing_package(path.resolve().parent)
        if around and path.name.lower().endswith(single_file_suffixes()):
            say(f"{path} is sent without its meshes; to include them, give the folder {around}")
        yield path
        return
    with tempfile.TemporaryDirectory(prefix="subt-check-", ignore_cleanup_errors=True) as own:
        packed = Path(own) / f"{path.resolve().name or 'package'}.zip"
        with packed.open("wb") as archive:
            left_out = pack(path, archive)
        for words in left_out:
            say(f"{path}: {words}")
        yield packed


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:  # such as a name that is too long: said when it is opened
        return False


def _refuse_file(path: Path) -> None:
    try:
        if not path.exists():
            raise UnreadableInput(path, "does not exist", "check the spelling")
        known = path.name.lower().endswith((*ARCHIVE_SUFFIXES, *single_file_suffixes()))
        if not known or not path.is_file():
            raise UnreadableInput(path, *reason_not_checked(path.name))
        with path.open("rb"):
            pass
    except (OSError, ValueError) as error:
        reason = f"cannot be opened: {getattr(error, 'strerror', None) or error}"
        raise UnreadableInput(path, reason, "check its permissions") from None


def pack(folder: Path, archive: BinaryIO, limits: ArchiveLimits | None = None) -> tuple[str, ...]:
    """Write a folder into a ZIP archive, below its own name.

    Args:
        folder: A package, or a folder of packages.
        archive: The file of the archive, open for writing.
        limits: Limits for the content of an archive.

    Returns:
        What is left out of it and why, in sentences without their dots.

    Raises:
        UnreadableInput: It contains more than is allowed, or unreadable files.
    """
    root = folder.resolve()
    index = build_index(root, lambda _: False)
    entries = [entry for entry in index.entries.values() if not LEFT_OUT & {*entry.path.split("/")}]
    packed = [entry for entry in entries if entry.kind in (EntryKind.FILE, EntryKind.FOLDER)]
    _refuse(folder, index, packed, limits or ArchiveLimits())
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as file:
        for item in packed:
            _add(folder, file, root.name, item)
    return tuple(_words_of_left_out(entries))


def _refuse(folder: Path, index: FileIndex, packed: list[FileEntry], limits: ArchiveLimits) -> None:
    """Refuse what the service would refuse, before anything is sent.

    Raises:
        UnreadableInput: There is too much, or something cannot be read.
    """
    if index.faults:
        fault = index.faults[0]
        what = f"its file '{plain(shortened(fault.path, 200))}' {plain(fault.reason)}"
        raise UnreadableInput(folder, f"is not sent: {what}", _ADVICE)
    if len(packed) > min(limits.entries, MAX_ENTRIES):
        reason = f"contains {len(packed)} files and folders, expected {limits.entries} or fewer"
        raise UnreadableInput(folder, reason, _ADVICE)
    size = sum(item.size for item in packed)
    if size > limits.unpacked_bytes:
        reason = f"has {size / 1e6:.0f} MB, expected {limits.unpacked_bytes / 1e6:.0f} MB or less"
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
        paths = [plain(shortened(entry.path, 200)) for entry in entries if entry.kind is kind]
        if paths:
            more = [f"{len(paths) - _NAMED} more"] * (len(paths) > _NAMED)
            named = and_list([*paths[:_NAMED], *more])
            words.append(
                f"{count(len(paths), noun)} left out, because archives cannot contain them: {named}"
            )
    return words
