"""The command drives the robot, says that it does, and leaves it when told to."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

import pytest

from tests.command.conftest import GOOD, Run, clean_environment

STATIC = "SDF,PKG001"


@pytest.fixture(autouse=True)
def own_cache(tmp_path_factory: pytest.TempPathFactory, monkeypatch: pytest.MonkeyPatch) -> Path:
    folder = tmp_path_factory.mktemp("own") / "cache"
    monkeypatch.setenv("SUBT_CHECK_CACHE", str(folder))
    return folder


def report(text: str) -> dict[str, Any]:
    (package,) = json.loads(text)["packages"]
    return dict(package)


def test_the_robot_is_driven_and_the_figures_are_shown(run: Run, good: Path) -> None:
    shown = run(good, "--select", "TRI").stdout
    assert "\ntrial: skid-steer drive, 15 s in MuJoCo " in shown
    (speed,) = (line for line in shown.splitlines() if "speed reached / commanded" in line)
    assert speed.split()[-1] == "ok"
    table = shown.partition("\ntrial: ")[2].partition("\nrobot ")[0]
    assert len(table.splitlines()) <= 15


def test_the_json_has_the_trial_the_time_and_the_facts(run: Run, good: Path) -> None:
    package = report(run(good, "--select", "TRI", "--format", "json").stdout)
    assert {leg["name"] for leg in package["trial"]["course"]} >= {"settle", "drive", "turn"}
    assert set(package["timings"]) >= {"open", "trial", "rules"}
    assert len(set(map(len, package["trial"]["series"].values()))) == 1


def test_no_trial(run: Run, good: Path) -> None:
    done = run(good, "--select", f"TRI,{STATIC}", "--no-trial")
    assert done.stdout.endswith(f"{GOOD}: Ready: nothing to fix (trial not run)\n")
    assert "trial: " not in done.stdout
    package = report(run(good, "--no-trial", "--format", "json").stdout)
    assert (package["trial"], package["verdict"]) == (None, "ready")
    off = [each for each in package["not_checked"] if each["rule"].startswith("TRI")]
    assert {each["cause"] for each in off} == {"switched_off"}


def test_settings_can_switch_the_trial_off(run: Run, good: Path) -> None:
    (good / "subt-check.toml").write_text("trial = false\n")
    assert "(trial not run)" in run(good, "--select", "TRI001").stdout


def test_nothing_is_driven_or_read_for_rules_that_need_it_not(run: Run, good: Path) -> None:
    package = report(run(good, "--select", STATIC, "--format", "json").stdout)
    assert package["trial"] is None
    assert set(package["timings"]) == {"open", "rules"}
    assert set(package["facts"]) == {
        *("robot", "mass_kg", "links", "joints", "sensors", "plugins", "drive"),
    }


def test_thorough_drives_it_again(run: Run, good: Path) -> None:
    done = run(good, "--select", "TRI", "--thorough", "--format", "json")
    assert report(done.stdout)["verdict"] == "ready"
    assert not report(done.stdout)["not_checked"]


def test_an_unchanged_package_answers_from_the_cache(run: Run, good: Path, own_cache: Path) -> None:
    first, again = (run(good, "--select", STATIC, "--format", "json").stdout for _ in range(2))
    assert set(report(again)["timings"]) == {"open", "recall"}
    assert {**report(again), "timings": 0} == {**report(first), "timings": 0}
    assert list(own_cache.iterdir())


def test_no_cache(run: Run, good: Path, own_cache: Path) -> None:
    for _ in range(2):
        done = run(good, "--select", STATIC, "--format", "json", "--no-cache")
        assert "recall" not in report(done.stdout)["timings"]
    assert not own_cache.exists()


def test_progress_is_for_terminals_alone(run: Run, good: Path, tmp_path: Path) -> None:
    assert run(good, "--select", "TRI").stderr == ""
    leader, terminal = os.openpty()
    subprocess.run(
        [sys.executable, "-m", "checker.cli", good.name, "--no-cache", "--select", "TRI,REF"],
        stdout=subprocess.DEVNULL,
        stderr=terminal,
        check=False,
        cwd=tmp_path,
        env=clean_environment(),
    )
    os.close(terminal)
    read = b""
    with suppress(OSError):  # the end of a terminal without a program
        while piece := os.read(leader, 10_000):
            read += piece
    os.close(leader)
    assert read.decode().split("\r\x1b[K") == [
        "",
        f"{GOOD}: rules",
        f"{GOOD}: driving the robot on its course in MuJoCo",
        "",
    ]
