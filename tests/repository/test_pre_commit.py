"""The hooks as pre-commit installs and runs them: a clone of this repository, and all from pip."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from checker import cli
from tests.conftest import SAMPLES
from tests.repository.conftest import (
    BROKEN,
    GOOD,
    ROOT,
    commit_all,
    copy_of_this_checkout,
    git,
    repository,
)

_CONFIGURATION = """repos:
  - repo: {repository}
    rev: {commit}
    hooks:
      - id: subt-check
        verbose: true
      - id: subt-check-trial
        verbose: true
"""


def hooks() -> list[dict[str, Any]]:
    return list(yaml.safe_load((ROOT / ".pre-commit-hooks.yaml").read_text("utf-8")))


@pytest.mark.parametrize("hook", hooks(), ids=lambda hook: hook["id"])
def test_the_command_of_a_hook_is_understood(hook: dict[str, Any]) -> None:
    name, *words = hook["entry"].split()
    names = ["a.sdf", "b/c.dae", "--fix", "--output=/x"]
    options = cli.build_parser().parse_args([*words, *hook["args"], *names])
    assert name == "subt-check"
    assert options.files
    assert options.paths == names
    assert not options.fix
    assert options.output is None
    assert options.no_trial == (hook.get("stages") != ["manual"])


def test_the_page_tells_of_all_hooks() -> None:
    page = (ROOT / "docs/pre-commit.md").read_text("utf-8")
    ids = [hook["id"] for hook in hooks()]
    assert re.findall(r"(?m)^\| `([\w-]+)` \|", page) == ids
    first, richer, second = re.findall(r"(?s)```yaml\n(.*?)```", page)
    (repository,) = yaml.safe_load(first)["repos"]
    assert [hook["id"] for hook in repository["hooks"]] == ids
    (hook,) = yaml.safe_load(richer)
    assert hook["additional_dependencies"] == hooks()[1]["additional_dependencies"]
    (hook,) = yaml.safe_load(second)
    assert hook["args"][-1] == "--"
    cli.build_parser().parse_args(["check", *hook["args"], "a.sdf"])


@pytest.fixture(scope="module")
def robots(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A repository with two packages and a page, all of them staged, whose hooks are ours."""
    folder = tmp_path_factory.mktemp("repositories")
    tool = copy_of_this_checkout(folder / "tool")
    robots = repository(folder / "robots")
    (robots / ".pre-commit-config.yaml").write_text(
        _CONFIGURATION.format(repository=tool, commit=commit_all(tool))
    )
    (robots / "README.md").write_text("Our robots\n")
    for name in (GOOD, BROKEN):
        shutil.copytree(SAMPLES / name, robots / "submitted_models" / name)
    commit_all(robots)
    return robots


@pytest.fixture(scope="module")
def home() -> Iterator[dict[str, str]]:
    """An environment in which pre-commit has nothing installed; it is some 1 GB in the end."""
    with tempfile.TemporaryDirectory() as folder:
        own = {"PRE_COMMIT_HOME": folder, "PIP_CONSTRAINT": str(ROOT / "constraints.txt")}
        yield {**os.environ, **own, "SUBT_CHECK_CACHE": f"{folder}/reports"}


def run(robots: Path, home: dict[str, str], *arguments: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pre_commit", "run", "--color", "never", *arguments]
    return subprocess.run(
        command, cwd=robots, env=home, capture_output=True, text=True, check=False
    )


def test_a_commit_is_checked_package_by_package(robots: Path, home: dict[str, str]) -> None:
    (robots / "README.md").write_text("Our two robots\n")
    git(robots, "add", "README.md")
    nothing = run(robots, home)
    assert nothing.returncode == 0, nothing.stdout + nothing.stderr
    assert re.search(r"(?m)^subt-check\.+Passed$", nothing.stdout)
    assert "with trial" not in nothing.stdout
    assert "Ready" not in nothing.stdout

    good = robots / "submitted_models" / GOOD
    for name in ("specifications.md", "package.xml"):
        (good / name).write_text((good / name).read_text("utf-8") + "\n", "utf-8")
    git(robots, "add", "submitted_models")
    passed = run(robots, home)
    assert passed.returncode == 0, passed.stdout + passed.stderr
    assert (
        passed.stdout.count(
            f"{GOOD}: Ready: nothing to fix (trial not run, physics is not installed)"
        )
        == 1
    )
    assert BROKEN not in passed.stdout

    failed = run(robots, home, "--files", f"submitted_models/{BROKEN}/model.sdf")
    assert failed.returncode == 1
    assert "exit code: 1" in failed.stdout
    assert f"submitted_models/{BROKEN}/model.sdf:39:18 error REF001" in failed.stdout

    for name in ("--fix", "--output=made"):
        (robots / name).write_text("")
        (good / name).write_text("")
    git(robots, "add", "--all")
    named = run(robots, home)
    assert f"{GOOD}: Ready" in named.stdout, named.stdout + named.stderr
    assert not (robots / "made").exists()

    driven = run(robots, home, "--all-files", "--hook-stage", "manual", "subt-check-trial")
    assert driven.returncode == 1
    assert f"{GOOD}: Ready: nothing to fix\n" in driven.stdout
    assert f"{BROKEN}: Not ready" in driven.stdout
