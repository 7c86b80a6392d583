"""What lies outside the layers, and which layers this machine has."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import closing
from pathlib import Path

import pytest

from checker.base.sandbox.launcher import OwnLauncher
from tests.sandbox.assets import Outside, laid_out

HERE = Path(__file__).parent


@pytest.fixture
def outside(monkeypatch: pytest.MonkeyPatch) -> Iterator[Outside]:
    """Lay out what is to be reached, and let launchers find the hostile modules."""
    with laid_out() as outside:
        found = os.environ.get("PYTHONPATH", "")
        paths = (str(HERE), outside.given["program"], found)
        monkeypatch.setenv("PYTHONPATH", os.pathsep.join(filter(None, paths)))
        monkeypatch.setenv("PYTHONDONTWRITEBYTECODE", "1")
        monkeypatch.setenv("TOKEN", "SECRET-token")
        monkeypatch.setenv("SUBT_CHECK_TOKENS", "SECRET-tokens")
        yield outside


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Say which layers this machine has."""
    with closing(OwnLauncher()) as starter:
        said = [f"{each.name} {'' if each.held else 'NOT '}held" for each in starter.layers]
    terminalreporter.write_line(f"layers of this machine: {', '.join(said)}")
