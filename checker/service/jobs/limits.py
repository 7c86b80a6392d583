"""What the check of an upload may use."""

from __future__ import annotations

from checker.base.record import Record
from checker.base.sandbox.task import hold_files_to, tighten

NICENESS = 10
"""Below that of the processes of the service, as `nice` counts it."""


class StageLimits(Record):
    """What the check of an upload may use.

    Attributes:
        seconds: By the clock, for all processes together; and of processor time, for each.
        memory: Bytes of address space of the process that checks. Not below what the children of
            the check ask for themselves: 4 GB for drawing, of which 0.9 GB were ever seen in use.
        file_bytes: Size of one file that it writes.
        open_files: At a time.
    """

    seconds: float
    memory: int = 4_000_000_000
    file_bytes: int = 1_000_000_000
    open_files: int = 512


def limit(limits: StageLimits) -> None:
    """Take too much of everything away from this process; nothing that is tighter is loosened."""
    from resource import RLIMIT_AS, RLIMIT_CPU

    seconds = max(1, int(limits.seconds))
    tighten(RLIMIT_CPU, seconds, seconds)
    tighten(RLIMIT_AS, limits.memory, limits.memory)
    hold_files_to(limits.file_bytes, limits.open_files)
