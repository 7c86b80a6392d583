"""Looks at the sandbox of processes that read what others have made; see `checker.sandbox`."""

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
    ACCOUNT: "a service started by root has it; a command for your own packages does not need it",
    LANDLOCK: "use Linux 5.13 or newer with `landlock` among the names in "
    "/sys/kernel/security/lsm, and in a container rules that allow its system calls",
    SECCOMP: "use Linux on x86-64 or arm64 with CONFIG_SECCOMP_FILTER",
}


def sandbox() -> Iterator[Result]:
    """Yield each layer, whether it holds on this machine, and how to get it."""
    with closing(OwnLauncher()) as starter:
        layers = starter.layers
    if not layers:
        yield Result(State.PROBLEM, "sandbox: its first process ends immediately", INSTALL_AGAIN)
    yield from map(result, layers)


def result(layer: Layer) -> Result:
    """Return what is to be said of one of them."""
    words = plain(shortened(layer.words, 200))
    if layer.held and (layer.hides or layer.name == SECCOMP):
        return Result(State.OK, f"sandbox: {layer.name} ({words})")
    part = f"{layer.name} partly" if layer.held else f"no {layer.name}"
    advice = _namespaces_advice() if layer.name == NAMESPACES else _ADVICE[layer.name]
    return Result(State.NOTE, f"sandbox: {part} ({words})", advice)


def _namespaces_advice() -> str:
    if shutil.which("bwrap") is None:
        return "apt install bubblewrap"
    reason = plain(shortened(bubblewrap(), 200))
    return (
        "allow this user to create namespaces; in a container, change the container's rules "
        f"({reason})"
    )
