"""The possible results of one stage of a check."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from checker.base.record import Record


class Checked(Record):
    """A report is in the store.

    Attributes:
        key: The key of the result.
        packages: The packages, as in `State.packages`.
        words: What came out, one sentence.
    """

    key: str
    packages: tuple[Mapping[str, Any], ...]
    words: str


class Refused(Record):
    """The upload cannot be checked, and its sender can correct that.

    Attributes:
        reason: The reason, and what to do; one sentence.
    """

    reason: str


class Died(Record):
    """The checker could not finish, and would not the next time: a limit, or an internal error.

    Attributes:
        reason: One sentence that begins with `UNFINISHED`.
    """

    reason: str


class Disturbed(Record):
    """It failed for a cause that is outside of the package, and may pass.

    It was killed, the disk was full, or the machine had no time for it.

    Attributes:
        reason: What happened, the beginning of a sentence.
    """

    reason: str


class Cancelled(Record):
    """Somebody wanted it to end."""


UNFINISHED = "the checker could not finish"
"""The text for faults that are not the user's."""
FAILED_INSIDE = (
    f"{UNFINISHED}: it failed with an internal error; the operator finds the cause in the log"
)
Outcome = Checked | Refused | Died | Disturbed | Cancelled
