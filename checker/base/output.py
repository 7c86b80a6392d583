"""Output of results and progress: standard output, files, and the exit code."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import perf_counter

from checker.base.errors import CheckerError

# Progress of a check: what begins is said, and stages are timed for the report.


Say = Callable[[str], None]
"""Called with a few words when a stage starts."""


def say_nothing(_: str) -> None:
    """Print no progress."""


class Stages:
    """The stages of one check.

    Attributes:
        say: Called with a few words when a stage starts.
        seconds: The time of each stage, without the stages inside it.
    """

    def __init__(self, say: Say = say_nothing) -> None:
        self.say = say
        self.seconds: dict[str, float] = {}

    @contextmanager
    def stage(self, name: str, words: str = "") -> Iterator[None]:
        """Measure the time inside; a stage that is entered again continues.

        Args:
            name: The name in the report.
            words: The progress message; empty for none.
        """
        if words:
            self.say(words)
        inside = sum(self.seconds.values())
        started = perf_counter()
        try:
            yield
        finally:
            took = perf_counter() - started
            others = sum(self.seconds.values()) - inside
            self.seconds[name] = self.seconds.get(name, 0.0) + max(took - others, 0.0)


EXIT_CLEAN, EXIT_FINDINGS, EXIT_USAGE, EXIT_CRASH = 0, 1, 2, 3
"""Done; findings, or something is not in order; it cannot be done as asked, as for wrong usage; a
fault of ours, or a service or database that does not answer. The same for every command."""
EXIT_INTERRUPTED = 130
"""The code of shells: 128 and the number of the signal."""


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
    """Print progress on the standard error; errors of writing are ignored."""
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


def current_folder() -> Path:
    """Return the current folder.

    Raises:
        CheckerError: It is gone.
    """
    try:
        return Path.cwd()
    except OSError as error:
        raise CheckerError(f"the current folder cannot be used: {error.strerror}") from None


def empty_of(folder: Path, names: Collection[str] = ()) -> Path:
    """Return a folder, created if needed, without some files.

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
