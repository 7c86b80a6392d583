"""Report of the installation: the tool, Python, library versions, the sandbox, the viewer."""

from __future__ import annotations

import os
import platform
import re
import shutil
import sys
import tempfile
from collections.abc import Collection, Iterator
from contextlib import closing
from enum import StrEnum
from importlib.metadata import PackageNotFoundError, requires
from itertools import islice
from pathlib import Path

from checker.base.cache import SIZE_LIMIT, cache_folder
from checker.base.child_process import Limits, ask
from checker.base.extras import PHYSICS
from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.base.resources import UNKNOWN, templates, tool_version, version_of
from checker.base.sandbox.launcher import OwnLauncher
from checker.base.sandbox.layers import ACCOUNT, ALL, LANDLOCK, NAMESPACES, SECCOMP, Layer
from checker.base.sandbox.namespaces import bubblewrap
from checker.base.system import FORKS
from checker.base.words import plain, shortened
from checker.cli.doctor.library_imports import import_troubles

# What is found out about one thing that the checker needs, or would like to have.


INSTALL_AGAIN = "install subt-check and its libraries again"


class State(StrEnum):
    """`NOTE`: something is missing that the checker can do without."""

    OK = "ok"
    NOTE = "note"
    PROBLEM = "problem"


class Result(Record):
    """Result of one test of the installation.

    Attributes:
        state: State of the thing: in order or not.
        what: The thing and its state, in words.
        advice: What to do; empty if nothing.
    """

    state: State
    what: str
    advice: str = ""

    def __str__(self) -> str:
        """Return it as a line."""
        return f"{self.state:<8}{self.what}" + (f"; {self.advice}" if self.advice else "")


# Looks at what makes reports quicker or richer: the cache, OpenGL, the 3D viewer.


# Looks at the sandbox of processes that read what others have made; see `checker.base.sandbox`.


_ADVICE = {
    ACCOUNT: (
        "a service started by root has it, in full where all may read the folders of this program; "
        "a command for your own packages does not need it"
    ),
    LANDLOCK: "use Linux 5.13 or newer with `landlock` among the names in "
    "/sys/kernel/security/lsm, and in a container rules that allow its system calls",
    SECCOMP: "use Linux on x86-64 or arm64 with CONFIG_SECCOMP_FILTER",
}


def sandbox() -> Iterator[Result]:
    """Yield each layer, whether it is active on this machine, and how to get it."""
    if not FORKS:
        what = f"sandbox: none; {platform.system()} has no {', '.join(ALL)}"
        advice = "check packages of others on Linux: in WSL, a container, or the web service"
        yield Result(State.NOTE, what, advice)
        return
    with closing(OwnLauncher()) as starter:
        layers = starter.layers
    if not layers:
        yield Result(State.PROBLEM, "sandbox: its first process ends immediately", INSTALL_AGAIN)
    yield from map(result, layers)


def result(layer: Layer) -> Result:
    """Return the message about one of them."""
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
    if PHYSICS.is_installed:
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
    answer = ask(f"{__package__}.opengl_frame", b"", _LIMITS)
    if not isinstance(answer, WorkerFailed) and answer != b"none":
        return Result(State.OK, f"pictures: MuJoCo draws with {answer.decode()}")
    reason = (
        f"the process that draws {answer.reason}"
        if isinstance(answer, WorkerFailed)
        else "no OpenGL"
    )
    packages = "libegl1, libopengl0 and libgl1-mesa-dri, or libosmesa6"
    advice = f"install EGL or OSMesa (Debian: {packages}) for reports with pictures"
    return Result(State.NOTE, f"pictures: {reason}", advice)


def _viewer() -> Result:
    if templates("report").joinpath("viewer.js").is_file():
        return Result(State.OK, "3D viewer for reports is built")
    # The wheel of a release has it; one that was built where npm is not may lack it.
    advice = (
        "reports show pictures instead; install Node.js with npm, then install subt-check again "
        "(in a checkout: `make viewer`)"
    )
    return Result(State.NOTE, "3D viewer for reports is not built", advice)


LEAST_PYTHON = (3, 11)
_NEEDED = re.compile(
    r"(([\w.-]+)(?:\[\w+\])?\s*>=\s*([\d.]+))(?:\s*;(?:.* and)?\s*extra\s*==\s*['\"](\w+)['\"])?"
)
"""A requirement of `pyproject.toml`, of everybody or of an extra."""


def installation() -> Iterator[Result]:
    """Yield the tool with its surroundings, and its libraries."""
    yield Result(State.OK, f"subt-check {tool_version()}")
    yield _python()
    yield Result(State.OK, f"{platform.platform()}; no Ruby, Gazebo or ROS is needed")
    yield from _libraries(("", PHYSICS.name) if PHYSICS.is_installed else ("",))
    if not PHYSICS.is_installed:
        what = "physics is not installed: no meshes, masses, views of sensors, trials or 3D view"
        yield Result(State.NOTE, what, PHYSICS.remedy)


def _python() -> Result:
    what = f"Python {platform.python_version()} ({sys.executable})"
    if sys.version_info >= LEAST_PYTHON:
        return Result(State.OK, what)
    least = ".".join(map(str, LEAST_PYTHON))
    return Result(State.PROBLEM, what, f"install subt-check with Python {least} or newer")


def _libraries(extras: Collection[str]) -> Iterator[Result]:
    """Yield what is wrong with libraries, then those that are well.

    Args:
        extras: The extras to examine; empty for the required ones.
    """
    try:
        needed = [_NEEDED.fullmatch(requirement) for requirement in requires("subt-check") or ()]
    except PackageNotFoundError:
        yield Result(State.NOTE, "subt-check runs without being installed", "see README.md")
        return
    fitting: dict[str, str] = {}
    for match in filter(None, needed):
        wanted, name, least, extra = match.groups(default="")
        if extra not in extras:
            continue
        version = version_of(name)
        if version == UNKNOWN:
            yield Result(State.PROBLEM, f"{name} is not installed", f"pip install '{wanted}'")
        elif numbers(version) < numbers(least):
            what = f"{name} is {version}, expected {least} or newer"
            yield Result(State.PROBLEM, what, f"pip install --upgrade '{wanted}'")
        else:
            fitting[name] = version
    troubles = import_troubles(fitting)
    for name, trouble in troubles.items():
        reason = plain(shortened(trouble, 300))
        yield Result(State.PROBLEM, f"{name} cannot be imported ({reason})", INSTALL_AGAIN)
    well = [f"{name} {version}" for name, version in fitting.items() if name not in troubles]
    yield Result(State.OK, f"libraries: {', '.join(well)}")


def numbers(version: str) -> tuple[int, ...]:
    """Return the leading numbers of a version, without zeros at the end, to be compared."""
    parts = [int(number) for number in re.findall(r"\d+", (re.match(r"[\d.]*", version) or "")[0])]
    while parts and parts[-1] == 0:
        parts.pop()
    return tuple(parts)
