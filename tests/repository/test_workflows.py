"""The workflows: what they run is there, and they hold to the versions of pyproject.toml."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from checker import cli
from tests.conftest import SAMPLES
from tests.each import of_each

ROOT = SAMPLES.parent
FILES = sorted((ROOT / ".github/workflows").glob("*.yml"))
PROJECT: dict[str, Any] = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]


def jobs() -> Iterator[tuple[str, dict[str, Any]]]:
    for file in FILES:
        yield from yaml.safe_load(file.read_text("utf-8"))["jobs"].items()


def commands() -> list[str]:
    steps = (step for _, job in jobs() for step in job["steps"])
    return [step["run"] for step in steps if "run" in step]


@pytest.mark.parametrize(
    ("schema", "files"), [("workflows", FILES), ("actions", [ROOT / "action.yml"])]
)
def test_they_are_of_the_published_form(schema: str, files: list[Path]) -> None:
    words = ["-m", "check_jsonschema", "--builtin-schema", f"vendor.github-{schema}"]
    done = subprocess.run(
        [sys.executable, *words, *files], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout


def test_each_python_is_tried() -> None:
    told = "Programming Language :: Python :: "
    versions = [it.removeprefix(told) for it in PROJECT["classifiers"] if it.startswith(told)]
    tried = (job for _, job in jobs() if "matrix.python" in str(job))
    matrices = [job["strategy"]["matrix"]["python"] for job in tried]
    assert matrices == [versions, versions]


def test_what_they_run_is_there() -> None:
    makefile = (ROOT / "Makefile").read_text("utf-8")
    targets = [word for run in commands() for word in re.findall(r"^make (.+)$", run, re.M)]
    assert {"test", "docs"} <= {each for words in targets for each in words.split()}
    for target in (each for words in targets for each in words.split()):
        assert re.search(rf"(?m)^{target}:", makefile), target
    for script in (
        word for run in commands() for word in re.findall(r"(?:scripts/|\.ci/)\w+", run)
    ):
        assert (ROOT / script).is_file(), script


def test_the_commands_are_understood() -> None:
    own = [run.split()[1:] for run in commands() if run.startswith("subt-check ")]
    assert len(own) > 1
    for words in own:
        cli.build_parser().parse_args(words if words[0] in cli.COMMANDS else ["check", *words])


def test_whatever_pip_installs_is_pinned() -> None:
    installs = [run for run in commands() if "pip install" in run]
    assert installs
    assert all("--constraint constraints.txt" in run for run in installs)


def test_whatever_is_asked_for_has_a_version() -> None:
    """Names of distributions, as pip compares them."""
    lines = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    pinned = {_name(line) for line in lines if "==" in line}
    asked = [*PROJECT["dependencies"], "build", "cyclonedx-bom"]
    for name, extra in PROJECT["optional-dependencies"].items():
        asked += extra if name != "all" else []
    for file in ROOT.glob("requirements-*.txt"):
        lines = file.read_text("utf-8").splitlines()
        asked += [line for line in lines if line[:1] not in ("#", "-", "")]
    assert len(asked) > 40
    assert {_name(requirement) for requirement in asked} <= pinned


def _name(requirement: str) -> str:
    return re.split(r"[=>\[]", requirement)[0].lower().replace("_", "-")


def test_only_what_publishes_may_write() -> None:
    for file in FILES:
        assert yaml.safe_load(file.read_text("utf-8"))["permissions"] == {"contents": "read"}
    writers = {name for name, job in jobs() if "write" in (job.get("permissions") or {}).values()}
    assert writers == {"publish", "image"}
    for name, job in jobs():
        assert (name in writers) == ("refs/tags/" in str(job.get("if", "")))


@of_each("run", commands())
def test_nothing_that_a_stranger_names_stands_in_a_script(run: str) -> None:
    assert "${{" not in run


@pytest.mark.programs
def test_one_command_writes_who_keeps_the_repository(tmp_path: Path) -> None:
    copy, owner = tmp_path / "copy", PROJECT["urls"]["Homepage"].split("/")[-2]
    subprocess.run(["git", "clone", "--quiet", ROOT, copy], check=True)
    shutil.copy(ROOT / "scripts/owner", copy / "scripts/owner")
    command = [sys.executable, copy / "scripts/owner", "acme-robots"]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert {"README.md", "pyproject.toml", "checker/report/sarif.py"} <= {*done.stdout.split()}
    assert '"publisher": "acme-robots"' in (copy / "editors/vscode/package.json").read_text()
    left = subprocess.run(
        ["git", "grep", "--extended-regexp", rf'{owner}(/|\.github\.io/)subt-check|: "{owner}"'],
        check=False,
        capture_output=True,
        text=True,
        cwd=copy,
    )
    assert left.stdout == ""
