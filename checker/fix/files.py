"""Writes fixed files: a whole file or nothing, never outside the package or through a link."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable
from contextlib import suppress
from glob import escape
from pathlib import Path

from checker.base.errors import CheckerError
from checker.fix.rounds import FixedFile
from checker.package.package import Package
from checker.source.text_file import NotText, decode, encode_like

_SUFFIX = ".subt-check"


class NotWritten(CheckerError):
    """A fixed file could not be written."""


def write_files(package: Package, files: Iterable[FixedFile]) -> None:
    """Write files, each in one step.

    First all new contents are put beside the files, so that a full disk or a folder that cannot
    be written to leaves everything as it was; then each takes its file's place.

    Raises:
        NotWritten: A file is a link, lies outside, changed meanwhile, or cannot be written.
    """
    prepared: list[tuple[Path, Path]] = []
    try:
        for file in files:
            target = _target(package, file)
            _tidy(target)
            prepared.append((_beside(target, _content(target, file)), target))
        while prepared:
            new, target = prepared[0]
            new.replace(target)
            prepared.pop(0)
            _sync_folder(target.parent)
    except OSError as error:
        raise NotWritten(
            f"{error.filename or package.name} cannot be written: {error.strerror}; "
            "files are replaced whole, so none is half written"
        ) from None
    finally:
        for new, _ in prepared:
            with suppress(OSError):
                new.unlink()


def _target(package: Package, file: FixedFile) -> Path:
    target = package.root / file.path
    if target.resolve() != target or not target.is_relative_to(package.root):
        raise NotWritten(f"{file.path} is reached through a link, and links are not written to")
    return target


def _content(target: Path, file: FixedFile) -> bytes:
    """Return the new bytes of a file, made from those that are still there."""
    data = target.read_bytes()
    try:
        if decode(data) != file.before.text:
            raise NotWritten(f"{file.path} has changed since it was checked; run the command again")
        return encode_like(file.after, data)
    except (NotText, UnicodeError):
        raise NotWritten(f"{file.path} cannot be written in its own encoding") from None


def _tidy(target: Path) -> None:
    """Remove what a run left behind that was killed before it could."""
    for left in target.parent.glob(f".{escape(target.name)}.*{_SUFFIX}"):
        left.unlink()


def _beside(target: Path, content: bytes) -> Path:
    """Write the content into a new file in the same folder, with the same permissions."""
    number, name = tempfile.mkstemp(prefix=f".{target.name}.", suffix=_SUFFIX, dir=target.parent)
    new = Path(name)
    try:
        with os.fdopen(number, "wb") as stream:
            stream.write(content)
            stream.flush()
            os.fsync(stream.fileno())
        new.chmod(target.stat().st_mode & 0o7777)
    except OSError:
        new.unlink()
        raise
    return new


def _sync_folder(folder: Path) -> None:
    """Have the folder's new entry reach the disk, where folders can be synchronised."""
    with suppress(OSError):
        number = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)
