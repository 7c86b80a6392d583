"""The oracles: other programs that read robots, asked about the same files."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path

import pytest

from tests.oracle.libsdformat import Loaded, compiled, load

Load = Callable[[Sequence[Path]], Sequence[Loaded]]


@pytest.fixture(scope="session")
def libsdformat(pytestconfig: pytest.Config, tmp_path_factory: pytest.TempPathFactory) -> Load:
    """Debian's libsdformat 12, in a program that is compiled once."""
    shared: pytest.Cache | None = getattr(pytestconfig, "cache", None)
    folder = shared.mkdir("oracle") if shared else tmp_path_factory.mktemp("oracle")
    return partial(load, compiled(folder))
