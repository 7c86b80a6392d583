"""What the tutorials and the first page show is so.

The blocks of a page are followed from top to bottom: a model that begins with its file's name is
written, a patch is applied, a command of ours is run, and the output that a page shows is compared.
"""

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
PAGES = [ROOT / "docs/index.md", *sorted({*RULE.parent.glob("*.md")} - {RULE})]
_BLOCK = re.compile(r"(?ms)^```(\w+)\n(.*?)^```")
_HUNK = re.compile(r"@@ -(\d+).*\n((?:-.*\n)*)((?:\+.*\n)*)")
_CODE = re.compile(r"exit code (\d)")
_ELSEWHERE = ("serve", "submit", "path/to/your_robot")
"""What needs a port, or the reader's robot."""
_USED = (
    *("acme_scout", "broken_acme_scout", "husky_description"),
    "husky_migration_sensor_config_1",
)


def blocks(page: Path, language: str) -> list[str]:
    return re.findall(rf"(?ms)^```{language}\n(.*?)^```", page.read_text("utf-8"))


def ours(line: str) -> Iterator[tuple[list[str], int]]:
    """Yield the words of a command of ours in a line, and the exit code that the page tells."""
    words = shlex.split(line, comments=True)
    if words[:1] == ["subt-check"] and not set(words) & set(_ELSEWHERE):
        told = _CODE.search(line)
        yield words[1:], int(told[1]) if told else 0


def commands(page: Path) -> Iterator[tuple[list[str], int]]:
    for line in "".join(blocks(page, "sh")).splitlines():
        yield from ours(line)


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the samples that the tutorials use."""
    for name in _USED:
        shutil.copytree(SAMPLES / name, tmp_path / "samples" / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_a_page_shows_what_is_so(
    page: Path, folder: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    ran = 0
    for language, text in _BLOCK.findall(page.read_text("utf-8")):
        match language:
            case "xml" if name := re.match(r"<!-- ([\w.]+) -->\n", text):
                (folder / name[1]).write_text(text, "utf-8")
            case "diff":
                apply_patch(text, folder)
            case "sh":
                for line in text.splitlines():
                    for words, code in ours(line):
                        printed(words, code, capsys)
                        ran += 1
            case "console":
                line, _, shown = text.removeprefix("$ ").partition("\n")
                ((words, code),) = ours(line)
                assert_shown(shown, printed(words, code, capsys))
                ran += 1
    assert ran


def apply_patch(patch: str, folder: Path) -> None:
    """Apply a patch that has no lines of context."""
    _, *parts = re.split(r"(?m)^--- a/.+\n\+\+\+ b/(.+)\n", patch)
    for name, hunks in zip(parts[::2], parts[1::2], strict=True):
        lines = (folder / name).read_text("utf-8").splitlines()
        for start, old, new in reversed(re.findall(_HUNK, hunks)):
            gone = [line[1:] for line in old.splitlines()]
            first = int(start) - bool(gone)
            assert lines[first : first + len(gone)] == gone, (name, start)
            lines[first : first + len(gone)] = [line[1:] for line in new.splitlines()]
        (folder / name).write_text("\n".join([*lines, ""]), "utf-8")


def printed(words: list[str], code: int, capsys: pytest.CaptureFixture[str]) -> str:
    """Run a command of ours and return its output."""
    assert main(words) == code, (words, capsys.readouterr())
    done = capsys.readouterr()
    assert "Traceback" not in done.err
    return done.out


def assert_shown(shown: str, output: str) -> None:
    """Compare what a page shows with an output; a line of `...` replaces any number of lines."""
    parts = re.split(r"(?m)^\.\.\.\n", shown)
    pattern = r"(?:.*\n)*?".join(map(re.escape, parts))
    assert re.fullmatch(pattern, output), f"{shown}is not what is printed:\n{output}"


@pytest.mark.parametrize("shown", ["a\nb\nc\n", "a\n...\nc\n", "...\nc\n", "...\nb\n...\n"])
def test_what_is_in_an_output_is_found(shown: str) -> None:
    assert_shown(shown, "a\nb\nc\n")


@pytest.mark.parametrize("shown", ["a\nb\n", "b\nc\n", "a\nc\n", "c\n...\na\n", "...\nd\n"])
def test_what_is_not_in_an_output_is_not_found(shown: str) -> None:
    with pytest.raises(AssertionError):
        assert_shown(shown, "a\nb\nc\n")


@pytest.mark.install
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
