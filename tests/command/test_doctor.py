"""`subt-check doctor`: what is needed works, and what is missing is named."""

from __future__ import annotations

import platform
import re
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.base.sandbox.layers import ALL, Layer
from checker.cli import main
from checker.cli.doctor import installation, self_test
from checker.cli.doctor import installation as of_sandbox
from checker.cli.doctor.installation import Result, State, numbers, result, sandbox, surroundings
from tests.command.conftest import Run
from tests.conftest import SAMPLES

BROKEN = "broken_rover_sensor_config_1"


def states(text: str) -> dict[str, str]:
    """Return `ok`, `note` or `problem` by the first word of what it is said of."""
    lines = [line.split() for line in text.splitlines()[:-1]]
    return {words[1].rstrip(":"): words[0] for words in lines}


def test_all_that_is_needed_works_here(run: Run, tmp_path: Path) -> None:
    done = run("doctor", SUBT_CHECK_CACHE=str(tmp_path / "cache"))
    assert (done.returncode, done.stderr) == (0, ""), done.stdout
    assert done.stdout.endswith("everything that is needed works\n")
    said = states(done.stdout)
    needed = {"subt-check", "Python", "libraries", "cache", "self-test"}
    assert {said[each] for each in needed} == {"ok"}
    assert {said["pictures"], said["3D"]} <= {"ok", "note"}
    layers = re.findall(r"(?m)^(?:ok|note) +sandbox: (?:no )?(\w+)", done.stdout)
    assert tuple(layers) == ALL
    assert f"cache {tmp_path}/cache: 0 entries" in done.stdout
    assert f"Python {platform.python_version()} ({sys.executable})" in done.stdout


def test_a_cache_that_cannot_be_written_is_a_note(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("SUBT_CHECK_CACHE", str(tmp_path / "file/cache"))
    found = next(surroundings())
    assert found.state is State.NOTE
    assert found.what.startswith(f"cache {tmp_path}/file/cache cannot be written to (Not a dir")


def test_a_viewer_that_is_not_built_is_a_note(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(installation, "templates", lambda _: tmp_path)
    *_, found = surroundings()
    assert found.state is State.NOTE
    assert found.advice.endswith(
        "install Node.js with npm, then install subt-check again (in a checkout: `make viewer`)"
    )


@pytest.mark.parametrize(
    ("layer", "line"),
    [
        (Layer("landlock", True, "version 7", hides=True), "ok      sandbox: landlock (version 7)"),
        (Layer("seccomp", True, "7 calls"), "ok      sandbox: seccomp (7 calls)"),
        (
            Layer("seccomp", False, "none"),
            "note    sandbox: no seccomp (none); use Linux on x86-64",
        ),
        (
            Layer("landlock", False, "the kernel has no Landlock"),
            "note    sandbox: no landlock (the kernel has no Landlock); use Linux 5.13 or newer",
        ),
        (
            Layer("account", False, "it is not started by root"),
            "note    sandbox: no account (it is not started by root); a service started by root",
        ),
        (
            Layer("account", True, "user 61200; it may read more"),
            "note    sandbox: account partly (user 61200; it may read more); a service started by",
        ),
    ],
)
def test_a_layer_that_is_missing_is_a_note_that_says_how_to_get_it(layer: Layer, line: str) -> None:
    assert str(result(layer)).startswith(line)


@pytest.mark.parametrize(
    ("place", "advice"),
    [
        (None, "; apt install bubblewrap"),
        ("/usr/bin/bwrap", "; allow this user to create namespaces; in"),
    ],
)
def test_namespaces_without_bubblewrap_hold_in_part(
    place: str | None, advice: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(of_sandbox.shutil, "which", lambda _: place)
    monkeypatch.setattr(of_sandbox, "bubblewrap", lambda: "bubblewrap fails: no rights")
    said = str(result(Layer("namespaces", True, "no network")))
    assert said.startswith(f"note    sandbox: namespaces partly (no network){advice}")
    said = str(result(Layer("namespaces", False, "not allowed")))
    assert said.startswith(f"note    sandbox: no namespaces (not allowed){advice}")


def test_a_sandbox_that_nothing_keeps_is_a_problem(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(of_sandbox.OwnLauncher, "layers", ())
    assert [each.state for each in sandbox()] == [State.PROBLEM]


@pytest.mark.slow
def test_a_missing_library_is_a_problem(run_apart: Run, tmp_path: Path) -> None:
    """A folder that comes first on the path and has a library that cannot be imported."""
    (tmp_path / "lxml").mkdir()
    (tmp_path / "lxml/__init__.py").write_text("raise ImportError('no lxml here')")
    done = run_apart("doctor", PYTHONPATH=str(tmp_path))
    assert done.returncode == 1
    assert (
        "problem lxml cannot be imported (ImportError: no lxml here); install subt-check "
        "and its libraries again\n"
    ) in done.stdout
    assert "note    the self-test is skipped" in done.stdout
    assert "please report" not in done.stdout


def test_a_library_that_ends_the_process_is_a_problem(run_apart: Run, tmp_path: Path) -> None:
    (tmp_path / "yaml").mkdir()
    (tmp_path / "yaml/__init__.py").write_text("import os; os.abort()")
    done = run_apart("doctor", PYTHONPATH=str(tmp_path))
    assert done.returncode == 1
    said = "problem libraries cannot be imported (the process that imports them crashed"
    assert said in done.stdout


@pytest.mark.slow
def test_a_part_of_a_library_that_is_missing_is_to_be_installed_again(
    run_apart: Run, tmp_path: Path
) -> None:
    """It can be imported, but what a rule asks of it cannot."""
    (tmp_path / "jinja2").mkdir()
    (tmp_path / "jinja2/__init__.py").write_text("")
    done = run_apart("doctor", PYTHONPATH=str(tmp_path))
    assert done.returncode == 1
    assert re.search(
        r"(?m)^problem the self-test fails: .*; install subt-check and its libraries ", done.stdout
    )
    assert "please report" not in done.stdout


def test_a_library_that_is_missing_or_too_old_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    wanted = ["lxml>=999.1", "no-such-library>=1.0", "dbos>=999; extra == 'service'", "numpy>=2.0"]
    monkeypatch.setattr(installation, "requires", lambda _: wanted)
    old, missing, rest = list(installation.installation())[-3:]
    assert (old.state, missing.state, rest.state) == (State.PROBLEM, State.PROBLEM, State.OK)
    assert old.what.endswith("expected 999.1 or newer")
    assert old.advice == "pip install --upgrade 'lxml>=999.1'"
    assert str(missing) == (
        "problem no-such-library is not installed; pip install 'no-such-library>=1.0'"
    )


def test_without_an_installation_the_versions_are_unknown(monkeypatch: pytest.MonkeyPatch) -> None:
    def nothing(name: str) -> list[str]:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(installation, "requires", nothing)
    assert list(installation.installation())[-1].state is State.NOTE


@pytest.mark.slow
def test_a_robot_with_faults_fails_the_self_test(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(self_test, "sample", lambda: SAMPLES / BROKEN)
    assert main(["doctor"]) == 1
    assert "problem the self-test fails: " in capsys.readouterr().out


def test_a_sample_that_is_not_there_fails_the_self_test(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    monkeypatch.setattr(self_test, "sample", lambda: tmp_path / "gone")
    assert self_test.self_test().state is State.PROBLEM


@pytest.mark.parametrize(
    ("version", "expected"),
    [("2.0", (2,)), ("4.1.0rc1", (4, 1)), ("1.0.0.post1", (1,)), ("", ()), ("unknown", ())],
)
def test_numbers_of_a_version(version: str, expected: tuple[int, ...]) -> None:
    assert numbers(version) == expected


@given(*[st.lists(st.integers(0, 99), min_size=1, max_size=4)] * 2)
def test_versions_are_ordered_by_their_numbers(one: list[int], other: list[int]) -> None:
    length = max(len(one), len(other))
    padded = [each + [0] * (length - len(each)) for each in (one, other)]
    shown = [numbers(".".join(map(str, each))) for each in (one, other)]
    assert (shown[0] < shown[1]) == (padded[0] < padded[1])


def test_a_line_says_what_to_do() -> None:
    assert str(Result(State.OK, "cache")) == "ok      cache"
    assert str(Result(State.NOTE, "no OpenGL", "install it")) == "note    no OpenGL; install it"
