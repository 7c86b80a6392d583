"""What the tutorials tell people to type works as they say, one after the other."""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.cli import main
from tests.conftest import SAMPLES

ROOT = SAMPLES.parent
RULE = ROOT / "docs/tutorials/write-a-rule.md"
PAGES = sorted({*RULE.parent.glob("*.md")} - {RULE})
_CODE = re.compile(r"exit code (\d)")
_ELSEWHERE = ("serve", "submit", "path/to/your_robot")
"""What needs a port, or the reader's robot."""
_USED = (
    *("acme_scout", "broken_acme_scout", "husky_description"),
    "husky_migration_sensor_config_1",
)


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```", page.read_text("utf-8"))


def commands(page: Path) -> Iterator[tuple[list[str], int]]:
    """Yield the words of our own commands, and the exit code that the page tells."""
    for line in "".join(blocks(page, "sh")).splitlines():
        words = shlex.split(line, comments=True)
        if words[:1] == ["subt-check"] and not set(words) & set(_ELSEWHERE):
            told = _CODE.search(line)
            yield words[1:], int(told[1]) if told else 0


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the samples that the tutorials use."""
    for name in _USED:
        shutil.copytree(SAMPLES / name, tmp_path / "samples" / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.usefixtures("folder")
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_each_command_ends_as_the_page_says(page: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ours = list(commands(page))
    assert ours
    for words, code in ours:
        assert main(words) == code, (words, capsys.readouterr())
        assert "Traceback" not in capsys.readouterr().err


def test_the_rule_that_is_written_is_tested_and_runs(folder: Path) -> None:
    for block in (*blocks(RULE, "python"), *blocks(RULE, "toml")):
        name, _, text = block.partition("\n")
        file = folder / name.removeprefix("# ")
        file.parent.mkdir(exist_ok=True)
        file.write_text(text, "utf-8")
    (folder / "acme_rules/__init__.py").touch()
    _install(folder)
    tests = _run(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", "test_acme_rules.py")
    assert "2 passed" in tests.stdout, tests.stdout
    said = ""
    for words, code in commands(RULE):
        done = _run(folder, "-m", "checker.cli", *words)
        assert (done.returncode, done.stderr) == (code, "")
        said += done.stdout
    assert "A link that two people cannot lift." in said
    assert "Ready: nothing to fix" in said


def _install(folder: Path) -> None:
    """Write what pip would write for the distribution."""
    project = tomllib.loads((folder / "pyproject.toml").read_text("utf-8"))["project"]
    about = folder / "acme_rules-1.0.dist-info"
    about.mkdir()
    head = f"Metadata-Version: 2.1\nName: {project['name']}\nVersion: {project['version']}\n"
    (about / "METADATA").write_text(head)
    ((group, entries),) = project["entry-points"].items()
    lines = [f"{name} = {value}" for name, value in entries.items()]
    (about / "entry_points.txt").write_text("\n".join([f"[{group}]", *lines, ""]))


def _run(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    path = os.pathsep.join([str(folder), str(ROOT)])
    return subprocess.run(
        [sys.executable, *words],
        cwd=folder,
        env=os.environ | {"PYTHONPATH": path},
        capture_output=True,
        text=True,
        check=False,
    )
