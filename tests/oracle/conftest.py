"""The oracles: other programs that read robots, asked about the same files."""

from __future__ import annotations

import shutil
import subprocess
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Protocol

import pytest

from tests.oracle.libsdformat import ASKED, Loaded, compiled, load


class Load(Protocol):
    """Loads files, in their order; on demand with all their elements."""

    def __call__(self, files: Sequence[Path], elements: bool = False) -> Sequence[Loaded]: ...


@pytest.fixture(scope="session")
def libsdformat(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Load:
    """Debian's libsdformat 12, in a program that is compiled once."""
    if shutil.which("pkg-config") is None or subprocess.call([*ASKED, "--exists"]) != 0:
        pytest.skip("libsdformat-dev is not installed")
    shared: pytest.Cache | None = getattr(pytestconfig, "cache", None)
    folder = shared.mkdir("oracle") if shared else tmp_path_factory.mktemp("oracle")
    return partial(load, compiled(folder))
