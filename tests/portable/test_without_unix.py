"""What Windows does not have is taken away from Python: the command gives the same reports.

Neither `fork` nor limits of `resource`, locks of `fcntl`, accounts, `poll` and most signals are
there, in the command and in all processes that it starts (`without_unix/sitecustomize.py`).
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).parents[2]
SAMPLES = ROOT / "samples"
WITHOUT_UNIX = Path(__file__).parent / "without_unix"


def run(*arguments: object, without_unix: bool) -> subprocess.CompletedProcess[str]:
    """Run the command, with nothing in its cache."""
    added = {"PYTHONPATH": str(WITHOUT_UNIX)} if without_unix else {}
    return subprocess.run(
        [sys.executable, "-m", "checker.cli", *map(str, arguments)],
        env={**os.environ, **added}, cwd=ROOT, capture_output=True, text=True, check=False,
        encoding="utf-8", timeout=300,
    )  # fmt: skip


def packages(done: subprocess.CompletedProcess[str]) -> list[Any]:
    """Return what a report in JSON states about packages, without times."""
    assert done.returncode in (0, 1), done.stderr
    return [{**package, "timings": {}} for package in json.loads(done.stdout)["packages"]]


@pytest.mark.parametrize(
    "sample", ["acme_scout", "broken_acme_scout", "subtcheck_buggy_sensor_config_1"]
)
def test_the_report_is_the_same(sample: str) -> None:
    options = ("check", SAMPLES / sample, "--output-format", "json", "--no-cache")
    here, there = run(*options, without_unix=False), run(*options, without_unix=True)
    assert packages(there) == packages(here)


def test_doctor_names_the_layers_that_are_missing() -> None:
    done = run("doctor", without_unix=True)
    assert done.returncode == 0, done.stdout + done.stderr
    assert "sandbox: none; Linux has no namespaces, account, landlock, seccomp" in done.stdout


@pytest.mark.parametrize("command", ["serve", "worker"])
def test_the_service_says_where_it_runs(command: str) -> None:
    done = run(command, without_unix=True)
    assert done.returncode == 2
    assert f"{command} runs on Linux and macOS" in done.stderr
    assert done.stderr.count("\n") == 1


def test_a_work_that_fails_leaves_the_others(tmp_path: Path) -> None:
    (tmp_path / "work.py").write_text(
        "import os\n"
        "from checker.base.forked_work import run_all_in_forks\n"
        "def fails(): raise ValueError('no')\n"
        "done = run_all_in_forks([lambda: b'1', fails, lambda: b'3'], 5, 1e9, 'late')\n"
        "print(done[0], done[1].reason, done[2])\n"
    )
    path = os.pathsep.join((str(WITHOUT_UNIX), str(ROOT)))
    done = subprocess.run(
        [sys.executable, tmp_path / "work.py"], env={**os.environ, "PYTHONPATH": path},
        capture_output=True, text=True, check=True,
    )  # fmt: skip
    assert done.stdout.split("\n")[0] == "b'1' failed with an error b'3'"


def test_a_process_that_takes_too_long_is_ended(tmp_path: Path) -> None:
    (tmp_path / "slow.py").write_text(
        "import time\ndef answer(request, files):\n    time.sleep(600)\n"
    )
    (tmp_path / "ask.py").write_text(
        "from checker.base import child_process\n"
        "child_process._STARTUP_SECONDS = 1.0\n"
        "print(child_process.ask('slow', b'{}', child_process.Limits(0.1)).reason)\n"
    )
    path = os.pathsep.join((str(WITHOUT_UNIX), str(ROOT), str(tmp_path)))
    done = subprocess.run(
        [sys.executable, tmp_path / "ask.py"], env={**os.environ, "PYTHONPATH": path},
        capture_output=True, text=True, check=True, timeout=60,
    )  # fmt: skip
    assert "took longer than" in done.stdout
