"""Looks at what makes reports quicker or richer: the cache, OpenGL, the 3D viewer."""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import closing
from itertools import islice
from pathlib import Path

from checker.base.cache import SIZE_LIMIT, cache_folder
from checker.base.child_process import Limits, ask
from checker.base.errors import WorkerFailed
from checker.base.resources import templates
from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.layers import ACCOUNT, LANDLOCK, NAMESPACES, SECCOMP, Layer
from checker.base.sandbox.namespaces import bubblewrap
from checker.base.words import plain, shortened
from checker.cli.doctor.result import INSTALL_AGAIN, Result, State

# Looks at the sandbox of processes that read what others have made; see `checker.base.sandbox`.


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


_ENTRIES_LIMIT = 100_000
_LIMITS = Limits(10.0, 16_000_000_000, draws=True)
"""Software renderers map far more memory than they use."""


def surroundings() -> Iterator[Result]:
    """Yield what the checker can do without, and would like to have."""
    yield _cache(cache_folder())
    yield _drawing()
    yield _viewer()


def _cache(folder: Path) -> Result:
    place = f"cache {plain(str(folder))}"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=folder):
            pass
    except OSError as error:
        what = f"{place} cannot be written to ({error.strerror}), so the cache is not used"
        return Result(State.NOTE, what, "set SUBT_CHECK_CACHE to a writable folder")
    sizes = [_size(path) for path in islice(folder.glob("*/??/*.json"), _ENTRIES_LIMIT)]
    used = f"{len(sizes)} entries, {sum(sizes) / 1e6:.1f} of {SIZE_LIMIT / 1e6:.0f} MB"
    return Result(State.OK, f"{place}: {used}")


def _size(path: Path) -> int:
    try:
        return os.lstat(path).st_size
    except OSError:
        return 0


def _drawing() -> Result:
    said = ask("checker.cli.doctor.opengl_frame", b"", _LIMITS)
    if not isinstance(said, WorkerFailed) and said != b"none":
        return Result(State.OK, f"pictures: MuJoCo draws with {said.decode()}")
    reason = (
        f"the process that draws {said.reason}" if isinstance(said, WorkerFailed) else "no OpenGL"
    )
    packages = "libegl1, libopengl0 and libgl1-mesa-dri, or libosmesa6"
    advice = f"install EGL or OSMesa (Debian: {packages}) for reports with pictures"
    return Result(State.NOTE, f"pictures: {reason}", advice)


def _viewer() -> Result:
    if templates("report").joinpath("viewer.js").is_file():
        return Result(State.OK, "3D viewer for reports is built")
    advice = "reports show pictures instead"
    return Result(State.NOTE, "3D viewer for reports is not built", advice)
