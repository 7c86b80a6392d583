"""What the check of an upload may use."""

from __future__ import annotations

from checker.record import record
from checker.sandbox.task import tightened

NICENESS = 10
"""Below that of the processes of the service, as `nice` counts it."""


@record()
class StageLimits:
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
    import resource

    seconds = max(1, int(limits.seconds))
    for kind, most in (
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_AS, limits.memory),
        (resource.RLIMIT_FSIZE, limits.file_bytes),
        (resource.RLIMIT_NOFILE, limits.open_files),
        (resource.RLIMIT_CORE, 0),
    ):
        resource.setrlimit(kind, tightened(resource.getrlimit(kind), most, most))
