"""What is found out about one thing that the checker needs, or would like to have."""

from __future__ import annotations

from enum import StrEnum

from checker.base.record import Record

INSTALL_AGAIN = "install subt-check again, with its libraries"


class State(StrEnum):
    """`NOTE`: something is missing that the checker can do without."""

    OK = "ok"
    NOTE = "note"
    PROBLEM = "problem"


class Result(Record):
    """What was found.

    Attributes:
        state: Whether it is as it should be.
        what: The thing, and what is so.
        advice: What to do; empty when all is well.
    """

    state: State
    what: str
    advice: str = ""

    def __str__(self) -> str:
        """Give it in a line."""
        return f"{self.state:<8}{self.what}" + (f"; {self.advice}" if self.advice else "")
