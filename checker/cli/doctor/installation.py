"""Looks at what is installed: the tool, Python, and the libraries in their versions."""

from __future__ import annotations

import platform
import re
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires

from checker.base.resources import UNKNOWN, tool_version, version_of
from checker.base.words import plain, shortened
from checker.cli.doctor.library_imports import import_troubles
from checker.cli.doctor.result import INSTALL_AGAIN, Result, State

LEAST_PYTHON = (3, 11)
_NEEDED = re.compile(r"([\w.-]+)\s*>=\s*([\d.]+)")
"""A requirement of `pyproject.toml` that holds everywhere; those of extras end otherwise."""


def installation() -> Iterator[Result]:
    """Yield the tool with its surroundings, and its libraries."""
    yield Result(State.OK, f"subt-check {tool_version()}")
    yield _python()
    yield Result(State.OK, f"{platform.platform()}; no Ruby, Gazebo or ROS is needed")
    yield from _libraries()


def _python() -> Result:
    what = f"Python {platform.python_version()} ({sys.executable})"
    if sys.version_info >= LEAST_PYTHON:
        return Result(State.OK, what)
    least = ".".join(map(str, LEAST_PYTHON))
    return Result(State.PROBLEM, what, f"install subt-check with Python {least} or newer")


def _libraries() -> Iterator[Result]:
    try:
        needed = [_NEEDED.fullmatch(each) for each in requires("subt-check") or ()]
    except PackageNotFoundError:
        yield Result(State.NOTE, "subt-check runs without being installed", "see README.md")
        return
    fitting: dict[str, str] = {}
    for match in filter(None, needed):
        name, least = match.groups()
        version = version_of(name)
        if version == UNKNOWN:
            yield Result(State.PROBLEM, f"{name} is not installed", f"pip install '{match[0]}'")
        elif numbers(version) < numbers(least):
            what = f"{name} is {version}, expected {least} or newer"
            yield Result(State.PROBLEM, what, f"pip install --upgrade '{match[0]}'")
        else:
            fitting[name] = version
    troubles = import_troubles(fitting)
    for name, trouble in troubles.items():
        said = plain(shortened(trouble, 300))
        yield Result(State.PROBLEM, f"{name} cannot be imported ({said})", INSTALL_AGAIN)
    well = [f"{name} {version}" for name, version in fitting.items() if name not in troubles]
    yield Result(State.OK, f"libraries: {', '.join(well)}")


def numbers(version: str) -> tuple[int, ...]:
    """Return the leading numbers of a version, without zeros at the end, to be compared."""
    found = [int(number) for number in re.findall(r"\d+", (re.match(r"[\d.]*", version) or "")[0])]
    while found and found[-1] == 0:
        found.pop()
    return tuple(found)
