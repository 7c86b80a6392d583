"""Exit codes mean the same for every command."""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

from checker.base.output import EXIT_CRASH, EXIT_USAGE
from checker.cli import COMMANDS, main
from checker.service.jobs.durable import worker
from checker.service.jobs.port import JobsUnreachable

USAGE = Path(__file__).parents[2] / "docs" / "usage.md"
CANNOT_BE_DONE = {
    "check": ("nowhere",),
    "robot": ("nowhere",),
    "export": ("nowhere", "--format", "urdf", "--output", "made.urdf"),
    "migrate": ("nowhere", "made", "--organization", "acme"),
    "submit": ("nowhere", "--server", "http://127.0.0.1:1"),
    "server": ("--port", "1"),
    "mcp": ("nowhere",),
    "serve": ("--host", "no host", "--data", "data"),
    "worker": ("--data", "file/data"),
    "admin": ("list", "--data", "nowhere"),
    "init": ("nowhere",),
    "doctor": ("nowhere",),
    "rule": ("GEO999",),
    "rules": ("GEO",),
    "completion": ("tcsh",),
}
"""By command, arguments by which it cannot do what is asked for."""


def code_of(*arguments: str) -> object:
    try:
        return main(arguments)
    except SystemExit as ended:  # by argparse
        return ended.code


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Work in a folder with a file in it; what commands change of this process is put back."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("SUBT_CHECK_DATA", str(tmp_path / "data"))
    Path("file").touch()
    mask = os.umask(0o022)
    yield
    os.umask(mask)


def test_every_command_is_tried_and_in_the_table() -> None:
    assert {*CANNOT_BE_DONE} == {*COMMANDS}
    table = USAGE.read_text().partition("They mean the same for every command")[2]
    assert [name for name in COMMANDS if f"`{name}`" not in table] == []


@pytest.mark.parametrize("command", COMMANDS)
def test_wrong_usage(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert code_of(command, "--nonsense") == EXIT_USAGE
    assert "error: " in capsys.readouterr().err


@pytest.mark.parametrize("command", COMMANDS)
def test_what_cannot_be_done(command: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert code_of(command, *CANNOT_BE_DONE[command]) == EXIT_USAGE
    told = capsys.readouterr()
    assert "internal error" not in told.err
    assert told.err or "nowhere" in told.out


def test_a_database_that_is_away_is_no_wrong_usage(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def work(_: object) -> None:
        raise JobsUnreachable("the database does not answer")

    monkeypatch.setattr(worker, "work", work)
    assert code_of("worker", "--data", "data") == EXIT_CRASH
    assert capsys.readouterr().err == "subt-check: the database does not answer\n"
