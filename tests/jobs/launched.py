"""The processes that launchers have started, as Linux shows them."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from time import monotonic, sleep

from tests.jobs.site import PATIENCE

MODULE = b"checker.base.sandbox.launcher_process"


_others: set[int] = set()
"""Processes of other tests, which launchers that live as long as this process have started."""


def look_from_now_on() -> None:
    """Have what there is by now count for nothing."""
    _others.clear()
    _others.update(id for id, _ in _of_launchers())


def tasks(ancestor: int | None = None) -> list[int]:
    """Return the processes below another one that a launcher has forked, and that are not dead."""
    found = dict(_of_launchers())
    below = os.getpid() if ancestor is None else ancestor
    return sorted(id for id, parent in found.items() if parent in found and is_below(id, below))


def launchers(ancestor: int | None = None) -> list[int]:
    """Return the launchers below a process that are not dead."""
    found = dict(_of_launchers())
    below = os.getpid() if ancestor is None else ancestor
    return sorted(id for id, parent in found.items() if parent not in found and is_below(id, below))


def _of_launchers() -> Iterator[tuple[int, int]]:
    """Yield the ids of launchers and of what they have forked, with those of their parents."""
    for each in Path("/proc").glob("[0-9]*"):
        try:
            ours = MODULE in (each / "cmdline").read_bytes()
            python = (each / "comm").read_text().startswith("python")
        except OSError:
            continue
        if ours and python and int(each.name) not in _others and is_alive(int(each.name)):
            yield int(each.name), parent_of(int(each.name))


def parent_of(process: int) -> int:
    """Return the parent of a process; 0 if it is gone."""
    try:
        return int(Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[1])
    except OSError:
        return 0


def is_below(process: int, ancestor: int) -> bool:
    """Whether a process was started by another one, or by one that this has started."""
    while process > 1 and process != ancestor:
        process = parent_of(process)
    return process == ancestor


def is_alive(process: int) -> bool:
    """Whether a process is there and no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def wait_for(number: int, ancestor: int | None = None) -> list[int]:
    """Wait until there are so many tasks below a process, and return them."""
    deadline = monotonic() + PATIENCE
    while len(tasks(ancestor)) != number and monotonic() < deadline:
        sleep(0.02)
    found = tasks(ancestor)
    assert len(found) == number, found
    return found
