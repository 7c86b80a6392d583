"""What a package has to offer to a rule, or why it cannot."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from checker.base.record import Record


class NotAvailable(Record):
    """A part of a package that a rule asks for and that cannot be had.

    Attributes:
        reason: Why, as the end of a sentence.
        applicable: False when the package has no such part and needs none.
    """

    reason: str
    applicable: bool = True


class WorkerFailed(Record):
    """A process gave no result: it died, ran out of what it may use, or answered with nonsense.

    Attributes:
        reason: Why, as the end of a sentence whose subject is the work.
        momentary: Whether the cause is not in the work, so that it may go well the next time: it
            was killed from outside, the machine was too busy, or the disk was full.
    """

    reason: str
    momentary: bool = False

    @property
    def entry(self) -> dict[str, object]:
        """How a process says it in place of one of its results (`checker.base.background`)."""
        return {"failed": {"reason": self.reason, "momentary": self.momentary}}


class Parts(Protocol):
    """Gives the parts of a package by the names of their types.

    By names, so that nobody loads the modules of parts that the package has not.
    """

    def part(self, kind: str) -> Sequence[object] | NotAvailable:
        """Return the part; several when a file holds several robots."""
        ...
