"""What the user gave on the command line and the checker cannot read at all.

Faults inside a package are findings; these exceptions are for input that holds no package to
find anything in.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Protocol

from checker.base.record import Record

# What a package has to offer to a rule, or why it cannot.


class NotAvailable(Record):
    """A part of a package that a rule asks for and that cannot be had.

    Attributes:
        reason: Why, as the end of a sentence.
        applicable: False when the package has no such part and needs none.
    """

    reason: str
    applicable: bool = True


class WorkerFailed(Record):
    """No result came of a process: it died, ran out of what it may use, or answered with nonsense.

    Attributes:
        reason: Why, as the end of a sentence whose subject is the work.
    """

    reason: str


class Parts(Protocol):
    """Gives the parts of a package by their type."""

    def part(self, kind: type) -> Sequence[object] | NotAvailable:
        """Return the part; several when a file holds several robots."""
        ...


class CheckerError(Exception):
    """Something that the user can mend; its text is one sentence and reaches the terminal."""


_LONGEST = 1000
"""Characters of a problem."""


class InvalidSettings(CheckerError):
    """Settings that name what does not exist, or have the wrong type.

    Attributes:
        path: The settings file; None when the command line says it.
        problem: What is wrong, and what is known instead; it may repeat what a stranger wrote.
    """

    def __init__(self, path: Path | None, problem: str) -> None:
        problem = problem if len(problem) <= _LONGEST else f"{problem[: _LONGEST - 1]}…"
        super().__init__(path, problem)
        self.path = path
        self.problem = problem

    def __str__(self) -> str:
        """Give the file, if it is one, and the problem."""
        return f"{self.path}: {self.problem}" if self.path else self.problem


class UnreadableInput(CheckerError):
    """An argument that is no package, archive or model file, or cannot be opened.

    Attributes:
        path: As the user gave it.
        reason: What is wrong with it, as the end of a sentence that starts with the path.
        advice: What to do about it, in the imperative.
    """

    def __init__(self, path: Path, reason: str, advice: str) -> None:
        super().__init__(path, reason, advice)
        self.path = path
        self.reason = reason
        self.advice = advice

    def __str__(self) -> str:
        """Give path, reason and advice in one sentence."""
        shown = "".join(
            c if c.isprintable() else "\N{REPLACEMENT CHARACTER}" for c in str(self.path)
        )
        return f"{shown} {self.reason}; {self.advice}."


class RefusedArchive(UnreadableInput):
    """An archive that could do harm when unpacked, or is larger than any package."""
