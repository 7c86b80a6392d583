"""Looks at the walls around processes that read what others have made; see `checker.sandbox`."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from contextlib import closing

from checker.doctor.result import INSTALL_AGAIN, Result, State
from checker.report.wording import plain, shortened
from checker.sandbox.launcher import OwnLauncher
from checker.sandbox.layers import ACCOUNT, LANDLOCK, NAMESPACES, SECCOMP, Layer
from checker.sandbox.namespaces import bubblewrap

_ADVICE = {
    ACCOUNT: "a service that root starts has it, a command for oneself can do without",
    LANDLOCK: "use Linux 5.13 or newer with `landlock` among the names in "
    "/sys/kernel/security/lsm, and in a container rules that allow its system calls",
    SECCOMP: "use Linux on x86-64 or arm64 with CONFIG_SECCOMP_FILTER",
}


def walls() -> Iterator[Result]:
    """Yield each wall, whether it holds on this machine, and how to get it."""
    with closing(OwnLauncher()) as starter:
        layers = starter.layers
    if not layers:
        yield Result(State.PROBLEM, "walls: the process that keeps them ends", INSTALL_AGAIN)
    yield from map(wall, layers)


def wall(layer: Layer) -> Result:
    """Return what is to be said of one of them."""
    words = plain(shortened(layer.words, 200))
    if layer.held and (layer.hides or layer.name == SECCOMP):
        return Result(State.OK, f"walls: {layer.name} ({words})")
    part = f"{layer.name} in part" if layer.held else f"no {layer.name}"
    advice = _namespaces_advice() if layer.name == NAMESPACES else _ADVICE[layer.name]
    return Result(State.NOTE, f"walls: {part} ({words})", advice)


def _namespaces_advice() -> str:
    if shutil.which("bwrap") is None:
        return "apt install bubblewrap"
    reason = plain(shortened(bubblewrap(), 200))
    return f"let this user make namespaces, in a container by its rules ({reason})"
