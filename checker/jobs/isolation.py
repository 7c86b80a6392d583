"""What a process may do that reads strangers' files: set by itself before it reads the first."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

from checker.confined import end_with_parent, tightened
from checker.record import record

_NICENESS = 10
"""Below that of the processes of the service, as `nice` counts it."""
_AUTOGROUP = Path("/proc/self/autogroup")


@record()
class StageLimits:
    """What the check of an upload may use.

    Attributes:
        seconds: By the clock, for all processes together; and of processor time, for each.
        memory: Bytes of address space of each process. Not below what the children of the
            check ask for themselves: 4 GB for drawing, of which 0.9 GB were ever seen in use.
        file_bytes: Size of one file that is written.
        open_files: At a time, by each process.
    """

    seconds: float
    memory: int = 4_000_000_000
    file_bytes: int = 1_000_000_000
    open_files: int = 512


def isolate(parent: int) -> None:
    """Take network and precedence away from this process and its children; it ends with its parent.

    Call it before a library starts threads: a process of several threads cannot leave the network
    (unshare(2)), and those that there are keep their niceness (setpriority(2)).

    Args:
        parent: Process id of the parent, without which it shall not live.

    Raises:
        ProcessLookupError: The parent has ended meanwhile.
    """
    _leave_the_network()
    end_with_parent()
    if os.getppid() != parent:
        raise ProcessLookupError(f"process {parent} has ended")
    _stand_back()


def _stand_back() -> None:
    """Let come first what people wait for at this very moment: uploads, pages."""
    os.nice(_NICENESS)
    # A session of its own may be a group of its own, within which alone niceness counts (sched(7)).
    with suppress(OSError):
        _AUTOGROUP.write_text(str(_NICENESS), encoding="ascii")


def limit(limits: StageLimits, process: int = 0) -> None:
    """Take too much of everything away from a process and the children that it will have.

    Args:
        limits: What it may use; nothing that is held tighter already is loosened.
        process: Its id; 0 for this one.

    Raises:
        ProcessLookupError: It has ended.
    """
    import resource

    seconds = max(1, int(limits.seconds))
    for kind, most in (
        (resource.RLIMIT_CPU, seconds),
        (resource.RLIMIT_AS, limits.memory),
        (resource.RLIMIT_FSIZE, limits.file_bytes),
        (resource.RLIMIT_NOFILE, limits.open_files),
        (resource.RLIMIT_CORE, 0),
    ):
        given = resource.prlimit(process, kind)
        resource.prlimit(process, kind, tightened(given, most, most))


_NEW_USER, _NEW_NET = 0x10000000, 0x40000000
"""Flags of unshare(2): CLONE_NEWUSER, CLONE_NEWNET."""


def _leave_the_network() -> None:
    """Go where there is no network, and no reading of the parent's memory or environment.

    Linux allows it to everybody (user_namespaces(7)) where neither the administrator nor a
    container's rules forbid it; then the container has to do without a network itself.
    """
    import ctypes

    user, group = os.getuid(), os.getgid()
    with suppress(OSError, AttributeError):
        if ctypes.CDLL(None).unshare(_NEW_USER | _NEW_NET) == 0:
            _be_known_as(user, group)


def _be_known_as(user: int, group: int) -> None:
    """Keep user and group as they are: without this they are those of nobody."""
    for name, said in (
        ("setgroups", "deny"),
        ("uid_map", f"{user} {user} 1"),
        ("gid_map", f"{group} {group} 1"),
    ):
        # In one write, as the system wants it.
        descriptor = os.open(f"/proc/self/{name}", os.O_WRONLY)
        try:
            os.write(descriptor, said.encode())
        finally:
            os.close(descriptor)
