"""Where results go: standard output, files, and the exit code."""

from __future__ import annotations

import os
import sys
from collections.abc import Collection
from contextlib import suppress
from pathlib import Path

from checker.base.errors import CheckerError

EXIT_CLEAN, EXIT_FINDINGS, EXIT_USAGE, EXIT_CRASH = 0, 1, 2, 3


def show(text: str) -> None:
    """Write to standard output; a reader that went away, as `head` does, is no fault.

    Raises:
        CheckerError: The disk behind it is full, or the like.
    """
    try:
        sys.stdout.write(text)
        sys.stdout.flush()
    except BrokenPipeError:
        # Point stdout at nothing, so that Python's own flush at the end is silent too.
        nowhere = os.open(os.devnull, os.O_WRONLY)
        os.dup2(nowhere, sys.stdout.fileno())
        os.close(nowhere)
    except OSError as error:
        raise CheckerError(f"the result cannot be written: {error.strerror}") from None


def say_progress(words: str) -> None:
    """Say on the standard error what goes on; whether somebody reads it does not matter."""
    with suppress(OSError):
        sys.stderr.write(f"{words}\n")
        sys.stderr.flush()


def write(path: Path, content: str | bytes) -> None:
    """Write a file, and the folders above it; text in UTF-8.

    Raises:
        CheckerError: It cannot be written.
    """
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content.encode() if isinstance(content, str) else content)
    except OSError as error:
        raise CheckerError(f"{path} cannot be written: {error.strerror}") from None


def here() -> Path:
    """Return the current folder.

    Raises:
        CheckerError: It is gone.
    """
    try:
        return Path.cwd()
    except OSError as error:
        raise CheckerError(f"the current folder cannot be used: {error.strerror}") from None


def empty_of(folder: Path, names: Collection[str] = ()) -> Path:
    """Return a folder, made if need be, without some files.

    Raises:
        CheckerError: It cannot be made or changed.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name in names:
            (folder / name).unlink(missing_ok=True)
    except OSError as error:
        raise CheckerError(f"{folder} cannot be written: {error.strerror}") from None
    return folder
