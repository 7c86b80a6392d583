"""Completion in bash, zsh and fish, as these shells do it."""

from __future__ import annotations

import os
import pty
import select
import shutil
import subprocess
from pathlib import Path
from time import monotonic

import pytest

from checker.cli import COMMANDS, completion, main
from checker.rulebook.discovery import all_rules

pytestmark = pytest.mark.programs
_SECONDS = 60
"""For a shell that draws a prompt; it takes a tenth of a second."""
GEO = {rule.id for rule in all_rules() if rule.group == "GEO"}
ASKED = [
    ("subt-check ru", {"rule", "rules"}),
    ("subt-check rule GEO0", GEO),
    ("subt-check check --select GEO0", GEO),
    ("subt-check rule unknown-joint-l", {"unknown-joint-link"}),
    ("subt-check check --fail-on ", {"error", "warning"}),
    ("subt-check check mod", {"model.sdf"}),
    ("subt-check model.sdf --fail-on ", {"error", "warning"}),
    ("subt-check model.sdf --select GEO0", GEO),
    ("subt-check model.sdf --write-b", {"--write-baseline"}),
]
"""What is asked, and all that may be answered; without a command, `check` is meant."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("completion")
    (folder / "model.sdf").touch()
    for shell in completion.SHELLS:
        (folder / f"script.{shell}").write_text(completion.script(shell), "utf-8")
    return folder


def program(name: str) -> str:
    found = shutil.which(name)
    if found is None:
        pytest.fail(f"{name} is not installed")
    return found


def bash(code: str, folder: Path) -> str:
    command = [program("bash"), "--norc", "-c", code]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=True)
    return done.stdout


@pytest.mark.parametrize(("line", "expected"), ASKED)
def test_bash(folder: Path, line: str, expected: set[str]) -> None:
    words = line.split(" ")
    quoted = " ".join(f"'{word}'" for word in words)
    code = (
        f". ./script.bash; COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1};"
        f"_shtab_subt_check subt-check '{words[-1]}' '{words[-2]}' 2>/dev/null;"
        'printf "%s\\n" "${COMPREPLY[@]}"'
    )
    assert set(bash(code, folder).split()) == expected


def test_bash_completes_files_where_there_is_no_command(folder: Path) -> None:
    code = ". ./script.bash; complete -p subt-check"
    assert "-o default" in bash(code, folder)


@pytest.mark.parametrize(("line", "expected"), [*ASKED, ("subt-check mod", {"model.sdf"})])
def test_fish(folder: Path, line: str, expected: set[str]) -> None:
    done = subprocess.run(
        [program("fish"), "--no-config", "-c", f"source script.fish; complete -C '{line}'"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
        env=os.environ | {"HOME": str(folder)},
    )
    found = {said.split("\t")[0] for said in done.stdout.splitlines()}
    assert {word for word in found if not word.startswith("-") or line[-1] != " "} == expected


@pytest.mark.parametrize(
    ("line", "shown"),
    [
        ("subt-check rule unknown-joint-l", "unknown-joint-link"),
        ("subt-check check --select GEO00", "GEO002"),
        ("subt-check comp", "completion"),
        ("subt-check check mod", "model.sdf"),
        ("subt-check mod", "model.sdf"),
        ("subt-check model.sdf --write-b", "--write-baseline"),
    ],
)
def test_zsh(folder: Path, line: str, shown: str) -> None:
    """A terminal in which the key for completion is pressed."""
    id, terminal = pty.fork()
    if id == 0:
        os.chdir(folder)
        own = {"PATH": os.environ["PATH"], "HOME": str(folder), "TERM": "dumb"}
        os.execve(program("zsh"), ["zsh", "-f", "-i"], own)  # noqa: S606
    try:
        start = "autoload -U compinit; compinit -u -D; eval \"$(cat script.zsh)\"; print rea''dy\n"
        os.write(terminal, start.encode())
        assert "ready" in until(terminal, "ready")
        os.write(terminal, f"{line}\t".encode())
        assert shown in until(terminal, shown)
    finally:
        os.close(terminal)
        os.waitpid(id, 0)


def until(terminal: int, words: str) -> str:
    """Return what a terminal shows until some words are among it, or nothing more comes."""
    said, end = "", monotonic() + _SECONDS
    while words not in said and monotonic() < end:
        if select.select([terminal], [], [], _SECONDS)[0]:
            said += os.read(terminal, 4096).decode(errors="replace")
    return said


def test_it_names_all_commands(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["completion", "fish"]) == 0
    said = capsys.readouterr().out
    assert all(f"-a {command} " in said for command in COMMANDS)
