"""The command as users run it: most tests call it here, some start a process of its own."""

from __future__ import annotations

import io
import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.cli import main
from checker.rule_testing import write_example
from tests.conftest import SAMPLES
from tests.effort import limited

Done = subprocess.CompletedProcess[str]
Run = Callable[..., Done]

GOOD = "husky_migration_sensor_config_1"
BROKEN = "broken_rover_sensor_config_1"
SECONDS = 30
"""No input may keep the command busy for longer; most take well below a second."""
_UNWANTED = ("NO_COLOR", "FORCE_COLOR", "SUBT_CHECK_DEBUG", "SUBT_CHECK_TOKEN")


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Run:
    """Run the command in the temporary folder; no traceback and no control character comes out."""

    def run(*arguments: object, **environment: str) -> Done:
        out, err = (io.TextIOWrapper(io.BytesIO(), "utf-8", newline="") for _ in range(2))
        with monkeypatch.context() as patch:
            patch.chdir(tmp_path)
            patch.setattr(sys, "stdout", out)
            patch.setattr(sys, "stderr", err)
            patch.setattr(tempfile, "tempdir", None)  # TMPDIR is looked at once
            for name in _UNWANTED:
                patch.delenv(name, raising=False)
            for name, value in environment.items():
                patch.setenv(name, value)
            words = list(map(str, arguments))
            with limited(SECONDS):
                code = _code_of(words)
        return _looked_at(words, code, _written(out), _written(err))

    return run


@pytest.fixture
def run_apart(tmp_path: Path) -> Run:
    """Do the same in a process of its own, for what an interpreter does at its start and end."""

    def run_apart(*arguments: object, **environment: str) -> Done:
        done = subprocess.run(
            [sys.executable, "-m", "checker.cli", *map(str, arguments)],
            capture_output=True,
            check=False,
            cwd=tmp_path,
            env=clean_environment() | environment,
        )
        return _looked_at(done.args, done.returncode, done.stdout, done.stderr)

    return run_apart


def _code_of(words: list[str]) -> int:
    try:
        return main(words)
    except SystemExit as ended:
        return int(ended.code or 0)


def _written(stream: io.TextIOWrapper) -> bytes:
    stream.flush()
    buffer = stream.buffer
    assert isinstance(buffer, io.BytesIO)
    return buffer.getvalue()


def _looked_at(words: list[str], code: int, out: bytes, err: bytes) -> Done:
    done = subprocess.CompletedProcess(words, code, out.decode("utf-8"), err.decode("utf-8"))
    assert "Traceback" not in done.stderr, done.stderr
    assert "internal error" not in done.stderr, done.stderr
    return done


def clean_environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if name not in _UNWANTED}


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
