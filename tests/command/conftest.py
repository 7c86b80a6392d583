"""The command as users run it: in a process of its own."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.rule_testing import write_example
from tests.conftest import SAMPLES

Run = Callable[..., subprocess.CompletedProcess[str]]

GOOD = "husky_migration_sensor_config_1"
BROKEN = "broken_rover_sensor_config_1"
SECONDS = 30
"""No input may keep the command busy for longer; most take well below a second."""


@pytest.fixture
def run(tmp_path: Path) -> Run:
    """Run the command in the temporary folder; no traceback and no control character comes out."""

    def run(*arguments: object, **environment: str) -> subprocess.CompletedProcess[str]:
        done = subprocess.run(
            [sys.executable, "-m", "checker.cli", *map(str, arguments)],
            capture_output=True,
            check=False,
            cwd=tmp_path,
            env=clean_environment() | environment,
            timeout=SECONDS,
        )
        out, err = done.stdout.decode("utf-8"), done.stderr.decode("utf-8")
        assert "Traceback" not in err, err
        assert "internal error" not in err, err
        return subprocess.CompletedProcess(done.args, done.returncode, out, err)

    return run


def clean_environment() -> dict[str, str]:
    unwanted = {"NO_COLOR", "FORCE_COLOR", "SUBT_CHECK_DEBUG", "SUBT_CHECK_TOKEN"}
    return {name: value for name, value in os.environ.items() if name not in unwanted}


@pytest.fixture
def good(tmp_path: Path) -> Path:
    return Path(shutil.copytree(SAMPLES / GOOD, tmp_path / GOOD))


@pytest.fixture
def broken(tmp_path: Path) -> Path:
    return Path(shutil.copytree(SAMPLES / BROKEN, tmp_path / BROKEN))


@pytest.fixture
def rover(tmp_path: Path) -> Path:
    """A minimal package, to be spoilt."""
    return write_example("<link name='wheel'/>", tmp_path)
