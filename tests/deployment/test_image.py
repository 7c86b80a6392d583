"""What the Dockerfile puts together works for a user without name, home or rights."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.base.resources import tool_version
from support.started import address, process
from tests.deployment.bare import bare_command, bare_environment
from tests.deployment.dockerfile import stages
from tests.deployment.image import ROOT, Image, context_of
from tests.installing import packages

STAGES = {stage.name: stage for stage in stages((ROOT / "Dockerfile").read_text("utf-8"))}


@pytest.fixture(scope="module")
def environment(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """What the run-time image gets from the build stage."""
    folder = tmp_path_factory.mktemp("image")
    image = Image(folder / "root")
    image.build(STAGES["build"], context_of(ROOT, folder / "context"))
    return image.environment


@pytest.fixture
def nowhere(tmp_path: Path) -> Iterator[Path]:
    """A working folder that cannot be written."""
    folder = tmp_path / "nowhere"
    folder.mkdir(mode=0o555)
    yield folder
    assert not list(folder.iterdir())


def run(
    environment: Path, cwd: Path, data: Path, *arguments: str
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        bare_command(environment, *arguments),
        capture_output=True,
        text=True,
        check=False,
        cwd=cwd,
        env=bare_environment(environment, data),
    )


def test_it_holds_the_project_and_not_the_checkout(environment: Path, nowhere: Path) -> None:
    where = "import subt_check.rules; print(subt_check.__file__); print(subt_check.rules.__file__)"
    done = subprocess.run(
        [environment / "bin/python", "-I", "-c", where],
        capture_output=True,
        text=True,
        check=True,
        cwd=nowhere,
    )
    assert all(line.startswith(str(packages(environment))) for line in done.stdout.splitlines())
    assert (packages(environment) / "subt_check/templates/report/viewer.js").is_file()


def test_it_says_its_version(environment: Path, nowhere: Path, tmp_path: Path) -> None:
    done = run(environment, nowhere, tmp_path, "--version")
    assert (done.returncode, done.stdout) == (0, f"subt-check {tool_version()}\n")


def test_it_checks_and_drives_a_robot(environment: Path, nowhere: Path, tmp_path: Path) -> None:
    sample = packages(environment) / "subt_check/samples/subtcheck_buggy_sensor_config_1"
    report = tmp_path / "report"
    done = run(environment, nowhere, tmp_path, str(sample), "--report", str(report))
    assert (done.returncode, done.stderr) == (0, "")
    assert {path.name for path in report.iterdir()} == {
        *("report.html", "report.json", "report.sarif", "robot.glb"),
    }


def test_it_is_not_open_by_mistake(environment: Path, nowhere: Path, tmp_path: Path) -> None:
    command = ["0" if word == "8000" else word for word in json.loads(STAGES[""].only("CMD"))]
    done = run(environment, nowhere, tmp_path, *command)
    assert (done.returncode, done.stdout) == (2, "")
    assert "SUBT_CHECK_TOKENS" in done.stderr


def test_the_service_passes_its_health_check(
    environment: Path, nowhere: Path, tmp_path: Path
) -> None:
    command = json.loads(STAGES[""].only("HEALTHCHECK").partition("CMD ")[2])
    serve = bare_command(environment, "serve", "--port", "0", "--workers", "0")
    told = bare_environment(environment, tmp_path)
    with process(serve, nowhere, told, tmp_path / "log") as started:
        script = command[2].replace("8000", address(started).rpartition(":")[2])
        done = subprocess.run([sys.executable, *command[1:2], script], check=False)
        assert done.returncode == 0
    done = subprocess.run([sys.executable, "-c", script], check=False, stderr=subprocess.DEVNULL)
    assert done.returncode != 0, "nobody answers any more"
