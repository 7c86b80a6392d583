"""The oracles: other programs that read robots, asked about the same files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Protocol

import pytest

from support import fortress as fortress_program
from support.oracles import compiled, is_installed
from tests.oracle.libsdformat import LIBRARIES, SOURCE, Loaded, load

Build = Callable[[Path, Sequence[str]], Path]
"""Compiles a source with some libraries, and returns the program."""


class Load(Protocol):
    """Loads files, in their order; on demand with all their elements."""

    def __call__(self, files: Sequence[Path], elements: bool = False) -> Sequence[Loaded]: ...


@pytest.fixture(scope="session")
def build(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Build:
    """Return what compiles a program once; without its libraries the test is skipped."""
    shared: pytest.Cache | None = getattr(pytestconfig, "cache", None)
    folder = shared.mkdir("oracle") if shared else tmp_path_factory.mktemp("oracle")

    def build(source: Path, libraries: Sequence[str]) -> Path:
        if not is_installed(libraries):
            pytest.skip(f"not installed: one of {', '.join(libraries)}")
        return compiled(source, libraries, folder)

    return build


@pytest.fixture(scope="session")
def libsdformat(build: Build) -> Load:
    """Debian's libsdformat 12."""
    return partial(load, build(SOURCE, LIBRARIES))


@pytest.fixture(scope="session")
def fortress(build: Build) -> Path:
    """Debian's ign-physics 5."""
    return build(fortress_program.SOURCE, fortress_program.LIBRARIES)
