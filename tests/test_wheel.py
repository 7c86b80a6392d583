"""The wheel, installed elsewhere, checks the samples that it carries."""

from __future__ import annotations

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from tests.conftest import SAMPLES
from tests.installing import borrow_running_packages, packages

ROOT = SAMPLES.parent
SAMPLE = "husky_migration_sensor_config_1"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(folder)]
    done = subprocess.run([*command, str(ROOT)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def environment(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A virtual environment with the wheel; what it depends on comes from the running one."""
    folder = tmp_path_factory.mktemp("environment")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    pip = [
        sys.executable,
        "-m",
        "pip",
        "--python",
        str(folder / "bin/python"),
        "install",
        "--quiet",
    ]
    subprocess.run([*pip, "--no-deps", "--no-index", str(wheel)], check=True)
    borrow_running_packages(folder)
    return folder


def run(environment: Path, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(
        [environment / "bin/subt-check", *arguments],
        capture_output=True,
        text=True,
        check=False,
        cwd=cwd,
        env=clean,
    )


def test_it_carries_code_rules_data_and_samples(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    expected = {
        *(ROOT.glob("checker/**/*.py")),
        *(ROOT.glob("rules/**/*.py")),
        *(ROOT.glob("checker/data/*.json")),
        ROOT / "checker/report/report.schema.json",
    }
    assert {path.relative_to(ROOT).as_posix() for path in expected} <= names
    templates = {path for path in (ROOT / "templates").rglob("*") if path.is_file()}
    assert {f"checker/{path.relative_to(ROOT).as_posix()}" for path in templates} <= names
    files = {path for path in (SAMPLES / SAMPLE).rglob("*") if path.is_file()}
    assert {f"checker/samples/{path.relative_to(SAMPLES).as_posix()}" for path in files} <= names


def test_it_carries_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        size = sum(info.file_size for info in archive.infolist())
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"checker", "rules"}
    assert not [name for name in names if "__pycache__" in name or name.endswith(".pyc")]
    assert not [name for name in names if "/tests/" in name or "/bench/" in name]
    assert size < 20_000_000


def test_it_names_its_licence_and_its_command(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        about = {
            name.split(".dist-info/")[1]: name for name in archive.namelist() if "-info/" in name
        }
        assert {"licenses/LICENSE", "licenses/NOTICE"} <= about.keys()
        assert b"subt-check = checker.cli:main" in archive.read(about["entry_points.txt"])


def test_the_code_that_runs_is_the_installed_one(environment: Path, tmp_path: Path) -> None:
    where = "import checker, rules; print(checker.__file__); print(rules.__file__)"
    command = [str(environment / "bin/python"), "-I", "-c", where]
    done = subprocess.run(command, capture_output=True, text=True, check=True, cwd=tmp_path)
    assert all(line.startswith(str(packages(environment))) for line in done.stdout.splitlines())


def test_a_sample_from_the_wheel_is_ready(environment: Path, tmp_path: Path) -> None:
    sample = packages(environment) / "checker/samples" / SAMPLE
    done = run(environment, str(sample), cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith(f"{SAMPLE}: Ready: nothing to fix\n")


def test_the_installed_command_migrates(environment: Path, tmp_path: Path) -> None:
    sample = packages(environment) / "checker/samples/husky_description"
    done = run(environment, "migrate", str(sample), "made", "--no-trial", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tmp_path / "made/my_team_husky_sensor_config_1/launch/spawner.rb").is_file()


def test_the_broken_sample_gets_the_same_findings_as_here(
    environment: Path, tmp_path: Path
) -> None:
    sample = packages(environment) / "checker/samples/broken_rover_sensor_config_1"
    installed = run(environment, str(sample), cwd=tmp_path)
    here = subprocess.run(
        [sys.executable, "-m", "checker.cli", SAMPLES / sample.name],
        capture_output=True,
        text=True,
        check=False,
    )
    assert installed.returncode == here.returncode == 1
    assert installed.stdout.replace(str(sample.parent), str(SAMPLES)) == here.stdout
