"""The wheel, installed elsewhere: what it holds, and that it works with and without the extras."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
import tarfile
import zipfile
from pathlib import Path

import pytest

from tests.conftest import SAMPLES
from tests.engine.test_discovery import RULE
from tests.installing import (
    borrow_running_packages,
    build,
    built_wheel,
    make_environment,
    packages,
    pip_install,
    shared,
)

ROOT = SAMPLES.parent
SAMPLE = "husky_migration_sensor_config_1"
BROKEN = "broken_acme_scout"
LIGHT = 120_000_000
"""Bytes that the static rules may take, with all that they need."""
REMEDY = "pip install 'subt-check[physics]'"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return built_wheel(tmp_path_factory)


@pytest.fixture(scope="module")
def environment(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A virtual environment with the wheel; what it depends on comes from the running one."""

    def make(folder: Path) -> None:
        make_environment(folder)
        pip_install(folder, "--no-deps", "--no-index", str(wheel))
        borrow_running_packages(folder)

    return shared(tmp_path_factory, "environment", make)


@pytest.fixture(scope="module")
def light(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A virtual environment with the wheel and what it asks for, beside django-rules."""

    def make(folder: Path) -> None:
        make_environment(folder)
        pip_install(folder, "-c", str(ROOT / "constraints.txt"), str(wheel), "rules")

    return shared(tmp_path_factory, "light", make)


def run(
    environment: Path, *arguments: object, cwd: Path, program: str = "subt-check"
) -> subprocess.CompletedProcess[str]:
    clean = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"}
    return subprocess.run(
        [environment / "bin" / program, *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
        cwd=cwd,
        env=clean,
    )


def python(environment: Path, code: str, cwd: Path) -> str:
    done = run(environment, "-c", code, cwd=cwd, program="python")
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_it_carries_code_rules_data_and_samples(wheel: Path) -> None:
    names = set(zipfile.ZipFile(wheel).namelist())
    code = [*(ROOT / "checker").rglob("*.py"), *(ROOT / "checker/data").glob("*.json")]
    code += [ROOT / "checker/report/report.schema.json", ROOT / "checker/py.typed"]
    assert {f"subt_check/{path.relative_to(ROOT / 'checker').as_posix()}" for path in code} <= names
    others = [*(ROOT / "rules").rglob("*.py"), *(ROOT / "templates").rglob("*.*")]
    others += [path for path in (SAMPLES / SAMPLE).rglob("*") if path.is_file()]
    others = [path for path in others if path.is_file()]
    assert {f"subt_check/{path.relative_to(ROOT).as_posix()}" for path in others} <= names


def test_it_carries_the_viewer(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        viewer = archive.read("subt_check/templates/report/viewer.js")
    assert b"SubtCheckViewer" in viewer
    assert len(viewer) > 100_000


def test_an_sdist_brings_the_viewer_to_where_npm_is_not(tmp_path: Path) -> None:
    with tarfile.open(build(ROOT, "sdist", tmp_path / "sdist")) as archive:
        archive.extractall(tmp_path, filter="data")
    (source,) = tmp_path.glob("subt_check-*")
    viewer = source / "templates/report/viewer.js"
    for number, is_there in enumerate((True, False)):
        assert viewer.is_file() == is_there
        wheel = build(source, "wheel", tmp_path / str(number), PATH=str(tmp_path / "nothing"))
        names = zipfile.ZipFile(wheel).namelist()
        assert ("subt_check/templates/report/viewer.js" in names) == is_there
        viewer.unlink(missing_ok=True)


def test_it_carries_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
        size = sum(info.file_size for info in archive.infolist())
    tops = {name.split("/")[0] for name in names}
    assert {top for top in tops if not top.endswith(".dist-info")} == {"subt_check"}
    assert not [name for name in names if "__pycache__" in name or name.endswith(".pyc")]
    assert not [name for name in names if "/tests/" in name or "/bench/" in name]
    assert size < 20_000_000


def test_lines_are_those_of_the_source(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        for name in ("pipeline.py", "rule.py", "engine/subject.py"):
            installed = archive.read(f"subt_check/{name}").decode().splitlines()
            source = (ROOT / "checker" / name).read_text("utf-8").splitlines()
            changed = [old for old, new in zip(source, installed, strict=True) if old != new]
            assert changed
            assert all(re.match(r"\s*from (checker|rules)\b", line) for line in changed)


def test_it_names_its_licence_and_its_command(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        about = {
            name.split(".dist-info/")[1]: name for name in archive.namelist() if "-info/" in name
        }
        assert {"licenses/LICENSE", "licenses/NOTICE"} <= about.keys()
        assert b"subt-check = subt_check.cli:main" in archive.read(about["entry_points.txt"])


def test_the_code_that_runs_is_the_installed_one(environment: Path, tmp_path: Path) -> None:
    code = "import subt_check.rules; print(subt_check.__file__); print(subt_check.rules.__file__)"
    lines = python(environment, code, tmp_path).splitlines()
    assert len(lines) == 2
    assert all(line.startswith(str(packages(environment))) for line in lines)


def test_a_sample_from_the_wheel_is_ready(environment: Path, tmp_path: Path) -> None:
    sample = packages(environment) / "subt_check/samples" / SAMPLE
    done = run(environment, sample, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout.endswith(f"{SAMPLE}: Ready: nothing to fix\n")


def test_the_installed_command_migrates(environment: Path, tmp_path: Path) -> None:
    sample = packages(environment) / "subt_check/samples/husky_description"
    done = run(environment, "migrate", sample, "made", "--no-trial", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (1, "")
    assert "TODO" in done.stdout  # what only the author knows
    assert (tmp_path / "made/my_team_husky_sensor_config_1/launch/spawner.rb").is_file()


def test_the_broken_sample_gets_the_same_findings_as_here(
    environment: Path, tmp_path: Path
) -> None:
    sample = packages(environment) / "subt_check/samples/broken_rover_sensor_config_1"
    installed = run(environment, sample, cwd=tmp_path)
    here = subprocess.run(
        [sys.executable, "-m", "checker.cli", SAMPLES / sample.name],
        capture_output=True,
        text=True,
        check=False,
    )
    assert installed.returncode == here.returncode == 1
    assert installed.stdout.replace(str(sample.parent), str(SAMPLES)) == here.stdout


def test_rules_of_another_distribution_import_it(environment: Path, tmp_path: Path) -> None:
    (tmp_path / "cheese_rules.py").write_text(RULE.format(id="CHE001"))
    about = tmp_path / "cheese_rules-1.0.dist-info"
    about.mkdir()
    (about / "METADATA").write_text("Metadata-Version: 2.1\nName: cheese-rules\nVersion: 1.0\n")
    (about / "entry_points.txt").write_text("[subt_check.rules]\ncheese = cheese_rules\n")
    code = (
        "import sys; sys.path.insert(0, '.'); from subt_check.cli import main;"
        f"sys.exit(main([{str(SAMPLES / SAMPLE)!r}, '--select', 'CHE']))"
    )
    assert "smells of cheese" in python(environment, code, tmp_path)
    code = (
        "import sys; sys.path.insert(0, '.'); from subt_check.rule_testing import rules_in;"
        "print(rules_in('cheese_rules')[0].id)"
    )
    assert python(environment, code, tmp_path) == "CHE001\n"


def test_the_static_rules_are_light(light: Path) -> None:
    assert sum(path.stat().st_size for path in packages(light).rglob("*") if path.is_file()) < LIGHT
    installed = {path.name.lower() for path in packages(light).iterdir()}
    heavy = {"mujoco", "numpy", "pil", "pinocchio", "scipy", "trimesh", "yourdfpy", "cmeel.prefix"}
    assert "lxml" in installed
    assert not installed & heavy


def test_the_static_rules_find_faults_and_say_what_is_not_checked(
    light: Path, tmp_path: Path
) -> None:
    done = run(light, SAMPLES / BROKEN, "--format", "json", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (1, "")
    (package, *_) = json.loads(done.stdout)["packages"]
    report = json.loads((SAMPLES / f"{BROKEN}.report.json").read_text("utf-8"))
    missed = {each["rule"] for each in package["not_checked"] if each["reason"].endswith(REMEDY)}
    assert {"INE001", "TRI002", "SEN019"} <= missed
    (golden, *_) = report["packages"]
    expected = {found["rule"] for found in golden["findings"]} - missed
    assert {found["rule"] for found in package["findings"]} == expected != set()
    assert package["verdict"] == "not_ready"


def test_no_command_ends_in_a_traceback_without_the_extras(light: Path, tmp_path: Path) -> None:
    shutil.copytree(SAMPLES / BROKEN, tmp_path / BROKEN)
    for words, code in (
        (["check", BROKEN, "--report", "report"], 1),
        (["check", BROKEN, "--fix"], 1),
        (["rule", "INE001"], 0),
        (["rules"], 0),
        (["init"], 0),
        (["robot", BROKEN], 0),
        (["doctor"], 0),
        (["export", BROKEN, "--format", "urdf"], 2),
        (["migrate", str(SAMPLES / "husky_description"), "made"], 2),
        (["submit", BROKEN, "--server", "http://127.0.0.1:1"], 2),
        (["serve"], 2),
        (["worker"], 2),
        (["admin", "list"], 2),
        (["mcp"], 2),
    ):
        done = run(light, *words, cwd=tmp_path)
        assert done.returncode == code, f"{words}\n{done.stdout}{done.stderr}"
        assert "Traceback" not in done.stdout + done.stderr
        assert "internal error" not in done.stdout + done.stderr
        if code == 2:
            assert re.search(
                r"pip install 'subt-check\[(physics|service|mcp)\]'$", done.stderr.strip()
            )
    assert {path.name for path in (tmp_path / "report").iterdir()} >= {"index.html"}


def test_it_lies_beside_the_package_rules_of_others(light: Path, tmp_path: Path) -> None:
    before = (packages(light) / "rules/__init__.py").read_text("utf-8")
    assert "subt" not in before
    code = (
        "import rules; from subt_check import Settings, check;"
        "from subt_check.rulebook.discovery import all_rules;"
        "rules.add_rule('is_robot', rules.predicate(lambda user: user == 'robot'));"
        f"found = check({str(SAMPLES / BROKEN)!r}, Settings(cache=False));"
        "print(rules.test_rule('is_robot', 'robot'), len(all_rules()) > 200,"
        "len(found.packages[0].findings) > 5, rules.__file__.count('subt_check'))"
    )
    assert python(light, code, tmp_path) == "True True True 0\n"
