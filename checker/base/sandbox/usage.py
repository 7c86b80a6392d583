"""Resources that all processes of a launcher use together.

Limits of the system (setrlimit(2)) apply to single processes. A process outside the sandbox sees
all of them in /proc: one whose parent has ended becomes a child of the launcher.
"""

from __future__ import annotations

import errno
import mmap
import os
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from checker.base.record import Record

_BLOCK, _KILOBYTE = 512, 1024
"""Bytes that `st_blocks` (stat(2)) and /proc/PID/smaps_rollup (proc(5)) count by."""
_GONE = (errno.ENOENT, errno.ENOTDIR)


class Usage(Record):
    """Resources that some processes use together, or their limits.

    Attributes:
        memory: Bytes; what several of them share counts once.
        disk: Bytes of the files in their folder and of those that they have open: a removed one
            occupies space until it is closed.
        files: The number of these.
        processes: The number of processes.
    """

    memory: int = 0
    disk: int = 0
    files: int = 0
    processes: int = 0

    def excess_over(self, most: Usage) -> str:
        """Return what is more than there may be, the end of "needs more than"; empty for none."""
        if self.processes > most.processes:
            return f"{most.processes} processes"
        if self.memory > most.memory:
            return f"{most.memory / 1e9:g} GB of memory"
        if self.disk > most.disk:
            return f"{most.disk / 1e9:.1f} GB of disk space"
        return f"{most.files} files" if self.files > most.files else ""


def usage_below(ancestor: int, folder: Path, most: Usage) -> Usage:
    """Return what all processes below another one use; of files, no more than `most` is counted.

    Args:
        ancestor: Its id; itself, it does not count.
        folder: Their working folder.
        most: What they may use.
    """
    processes = descendant_ids(ancestor)
    if len(processes) > most.processes:
        return Usage(processes=len(processes))
    memory, disk, known = sum(map(_memory, processes)), 0, set[tuple[int, int]]()
    for status in _files(processes, folder):
        if status is None or len(known) > most.files or disk > most.disk:
            return Usage(memory, disk, most.files + 1, len(processes))
        if (file := (status.st_dev, status.st_ino)) not in known:
            known.add(file)
            disk += getattr(status, "st_blocks", 0) * _BLOCK
    return Usage(memory, disk, len(known), len(processes))


def descendant_ids(ancestor: int) -> list[int]:
    """Return the ids of all processes below another one; none if the system has no /proc."""
    children: dict[int, list[int]] = {}
    with suppress(OSError), os.scandir("/proc") as entries:
        for entry in entries:
            # One that has ended meanwhile has no parent any more.
            with suppress(OSError, ValueError):
                id = int(entry.name)
                fields = Path(f"/proc/{id}/stat").read_bytes().rpartition(b")")[2].split()
                children.setdefault(int(fields[1]), []).append(id)
    found = children.get(ancestor, [])
    for id in found:
        found += children.get(id, ())
    return found


def _memory(process: int) -> int:
    """Return the share of a process in the memory that it uses with others."""
    with suppress(OSError):
        for line in Path(f"/proc/{process}/smaps_rollup").read_bytes().splitlines():
            if line.startswith(b"Pss:"):
                return int(line.split()[1]) * _KILOBYTE
    with suppress(OSError):  # the system may hide the rest from other users
        pages = int(Path(f"/proc/{process}/statm").read_bytes().split()[1])
        return pages * mmap.PAGESIZE
    return 0


def _files(processes: list[int], folder: Path) -> Iterator[os.stat_result | None]:
    """Yield what is known of open files and of those in a folder; None for what is hidden."""
    for id in processes:
        with suppress(OSError):
            for name in os.listdir(f"/proc/{id}/fd"):  # noqa: PTH208 - not paths that lead anywhere
                with suppress(OSError):
                    yield os.stat(f"/proc/{id}/fd/{name}")  # noqa: PTH116
    waiting = [str(folder)]
    while waiting:
        try:
            with os.scandir(waiting.pop()) as entries:
                for entry in entries:
                    yield entry.stat(follow_symlinks=False)
                    if entry.is_dir(follow_symlinks=False):
                        waiting.append(entry.path)
        except OSError as error:
            # A name that is too long, or a folder that cannot be listed, is none of ours.
            if error.errno not in _GONE:
                yield None
