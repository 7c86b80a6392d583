"""What is printed while packages are checked, and what an interruption leaves."""

from __future__ import annotations

import os
import pty
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from tests.command.conftest import BROKEN, GOOD, Run, clean_environment
from tests.conftest import SAMPLES

ALL = sorted(path.name for path in SAMPLES.iterdir() if path.name.endswith("_sensor_config_1"))


@pytest.fixture
def samples(tmp_path: Path) -> Path:
    for name in ALL:
        shutil.copytree(SAMPLES / name, tmp_path / "robots" / name)
    return tmp_path / "robots"


def test_concise_is_one_line_a_finding_as_compilers_have_it(run: Run, broken: Path) -> None:
    done = run(broken.name, "--no-trial", "--output-format", "concise")
    *findings, verdict = done.stdout.splitlines()
    form = re.compile(rf"{BROKEN}/[^:]*(:\d+:\d+)?: (error|warning): .+ \[[A-Z0-9]{{3}}\d{{3}}\]")
    assert [line for line in findings if not form.fullmatch(line)] == []
    assert verdict.startswith(f"{BROKEN}: Not ready: ")


def test_quiet_prints_findings_and_nothing_else(run: Run, good: Path, broken: Path) -> None:
    assert run(good, "--no-trial", "-q").stdout == ""
    done = run(good.name, broken.name, "--no-trial", "-q", "--output-format", "concise")
    assert all(line.endswith("]") for line in done.stdout.splitlines())
    assert done.returncode == 1


def test_infos_are_counted_and_shown_on_request(run: Run, broken: Path) -> None:
    brief, full = run(broken, "--no-trial"), run(broken, "--no-trial", "--info")
    (said,) = re.findall(r"(\d+) infos?, show with --info", brief.stdout)
    assert len(re.findall(r" info [A-Z0-9]{6} ", full.stdout)) == int(said) > 0
    assert " info " not in brief.stdout.replace("infos, show", "")


@pytest.mark.slow
def test_the_order_does_not_depend_on_the_number_of_processes(run: Run, samples: Path) -> None:
    one, two = (run(samples, "--no-trial", "--jobs", jobs) for jobs in (1, 2))
    assert one.stdout == two.stdout
    assert one.returncode == two.returncode == 1


@pytest.mark.slow
def test_each_package_is_printed_when_it_ends(samples: Path) -> None:
    # The first is printed while the last still has to be checked.
    command = [sys.executable, "-m", "checker.cli", "robots", "--no-trial", "--no-cache"]
    with subprocess.Popen(
        [*command, "--jobs", "1"], cwd=samples.parent, stdout=subprocess.PIPE, text=True
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline().startswith(ALL[0])
        assert process.poll() is None
        rest = process.stdout.read()
    assert [name for name in ALL[1:] if f"{name}: " not in rest] == []


@pytest.mark.slow
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_a_terminal_shows_how_far_it_is(samples: Path, jobs: str) -> None:
    ours, theirs = pty.openpty()
    command = [sys.executable, "-m", "checker.cli", "robots", "--no-trial", "--jobs", jobs]
    done = subprocess.run(
        command, cwd=samples.parent, stdout=subprocess.DEVNULL, stderr=theirs, check=False
    )
    os.close(theirs)
    shown = os.read(ours, 100_000).decode()
    assert done.returncode == 1
    assert f"1 of {len(ALL)}  " in shown
    assert [name for name in ALL if f" of {len(ALL)}  {name}: rules" not in shown] == []
    assert shown.endswith("\r\x1b[K"), "the line is left empty"


@pytest.mark.service
@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("to_all", [False, True], ids=["to one", "as a terminal does"])
def test_an_interruption_ends_it_soon_and_leaves_nothing(
    samples: Path, tmp_path: Path, jobs: int, to_all: bool
) -> None:
    own = tmp_path / "own"
    own.mkdir()
    for name in (GOOD, *ALL):
        shutil.make_archive(str(samples / name), "zip", samples, name)
    archives = sorted(map(str, samples.glob("*.zip")))
    words = [*archives, "--no-cache", "--output-format", "concise", "--jobs", str(jobs)]
    with subprocess.Popen(
        [sys.executable, "-m", "checker.cli", *words],
        env=clean_environment() | {"TMPDIR": str(own)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    ) as process:
        assert process.stdout is not None
        process.stdout.readline()
        sent = time.monotonic()
        (os.killpg if to_all else os.kill)(process.pid, signal.SIGINT)
        others, said = process.communicate()
        took = time.monotonic() - sent
    # A shell shows 130 for both: Python passes an interrupted `exec` on as the signal.
    assert process.returncode in (130, -signal.SIGINT)
    assert said == "subt-check: interrupted\n"
    assert took < 2.0, "0.1 s on a machine that has nothing else to do"
    verdicts = re.findall(r"(?m)^\S+: (?:Not ready|Ready|Incomplete)", others)
    assert len(verdicts) < len(archives) - 1, "it goes on to the end"
    assert list(own.iterdir()) == []


@pytest.mark.parametrize(
    ("options", "problem"),
    [
        (["--unsafe"], "--unsafe needs --fix or --diff"),
        (["--thorough", "--no-trial"], "--thorough and --no-trial cannot be used together"),
        (["--fix", "--diff"], "--fix and --diff cannot be used together"),
        (["--quiet", "--info"], "--quiet and --info cannot be used together"),
    ],
)
def test_options_that_make_no_sense_together(
    run: Run, good: Path, options: list[str], problem: str
) -> None:
    done = run(good, *options)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"subt-check: {problem}")


def test_what_the_command_line_says_is_not_blamed_on_a_file(run: Run, good: Path) -> None:
    (good / "subt-check.toml").write_text("trial = false\n")
    done = run(good, "--select", "KIN01")
    assert done.stderr.startswith("subt-check: --select: there is no rule 'KIN01'; did you mean ")
    assert "KIN010, KIN011" in done.stderr
    (good / "subt-check.toml").write_text("select = ['KIN01']\n")
    assert "subt-check.toml: there is no rule 'KIN01'" in run(good).stderr


@pytest.mark.parametrize("begin", ["GEO01", "geo", "DRV00"])
def test_the_beginning_of_an_id_lists_its_rules(run: Run, begin: str) -> None:
    listed = run("rules").stdout.splitlines()
    wanted = [line for line in listed if line.startswith(begin.upper())]
    done = run("rule", begin)
    assert (done.returncode, done.stdout.splitlines()) == (0, wanted)
