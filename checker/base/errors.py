"""Exceptions for command-line input that the checker cannot read at all.

Faults inside a package are findings; these exceptions are for input that contains no package.
"""

from __future__ import annotations

import errno
from pathlib import Path

DEBUG = "SUBT_CHECK_DEBUG"
"""Name of the variable that adds tracebacks to internal errors."""
_MOMENTARY = frozenset(
    (
        *(errno.EAGAIN, errno.EDQUOT, errno.EIO, errno.EMFILE),
        *(errno.ENFILE, errno.ENOSPC, errno.EROFS, errno.ESTALE),
    )
)


def is_momentary(error: BaseException) -> bool:
    """Return whether the disk or the system failed: nothing that a package can do, and may pass."""
    return isinstance(error, OSError) and error.errno in _MOMENTARY


def momentary_cause(error: BaseException) -> str:
    """Return what failed of the disk or the system, where an error comes from that; else empty."""
    cause: BaseException | None = error
    while cause is not None and not is_momentary(cause):
        cause = cause.__cause__ or cause.__context__
    return getattr(cause, "strerror", None) or "" if cause else ""


class CheckerError(Exception):
    """Something that the user can correct; its text is one sentence and reaches the terminal."""


class Unreachable(CheckerError):
    """A service or database that is needed does not answer; the same may work later."""


_LONGEST = 1000
"""Characters of a problem."""


class InvalidSettings(CheckerError):
    """Settings that name what does not exist, or have the wrong type.

    Attributes:
        path: The settings file; None if the command line states it.
        problem: What is wrong, and what is known instead; it may repeat untrusted text.
    """

    def __init__(self, path: Path | None, problem: str) -> None:
        problem = problem if len(problem) <= _LONGEST else f"{problem[: _LONGEST - 1]}…"
        super().__init__(path, problem)
        self.path = path
        self.problem = problem

    def __str__(self) -> str:
        """Return the file, if it is one, and the problem."""
        return f"{self.path}: {self.problem}" if self.path else self.problem


class UnreadableInput(CheckerError):
    """An argument that is no package, archive or model file, or cannot be opened.

    Attributes:
        path: The path as the user gave it.
        reason: What is wrong with it, as the end of a sentence that starts with the path.
        advice: What to do about it, in the imperative.
    """

    def __init__(self, path: Path, reason: str, advice: str) -> None:
        super().__init__(path, reason, advice)
        self.path = path
        self.reason = reason
        self.advice = advice

    def __str__(self) -> str:
        """Return path, reason and advice in one sentence."""
        shown = "".join(
            c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in str(self.path)
        )
        return f"{shown} {self.reason}; {self.advice}."


class RefusedArchive(UnreadableInput):
    """An archive that could do harm when unpacked, or is larger than any package."""
