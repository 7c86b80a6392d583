"""The matrix again: as a user without rights, and as root whose Python other users reach."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
_ALL = "test_all_layers_that_there_are"
NOBODY = ("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups")


def opened() -> list[str]:
    """Return the command in whose view all users reach Python; empty where they do anyway."""
    found: list[str] = []
    for needed in dict.fromkeys((sys.base_prefix, sys.prefix, str(ROOT))):
        closed = [each for each in Path(needed).parents if not each.stat().st_mode & 0o001]
        if closed:
            between = reversed(Path(needed).relative_to(closed[-1]).parents[:-1])
            folders = [word for each in between for word in ("--dir", str(closed[-1] / each))]
            found += ["--tmpfs", str(closed[-1]), *folders, "--ro-bind", needed, needed]
    return ["bwrap", "--dev-bind", "/", "/", "--cap-add", "ALL", *found] if found else []


@pytest.mark.skipif(os.getuid() != 0, reason="the tests beside this one run as the user they are")
@pytest.mark.parametrize("user", [NOBODY, ()], ids=["nobody", "root"])
def test_the_matrix(user: tuple[str, ...]) -> None:
    command = [*opened(), *user]
    for program in {"bwrap", "setpriv"} & {*command}:
        if shutil.which(program) is None:
            pytest.skip(f"{program} is not installed")
    if not command:
        pytest.skip("root's Python is open to all users: the tests beside this one have shown it")
    # The layers of one kind of process are enough to show whether they stand for this user.
    tests = [f"tests/sandbox/test_layers.py::{name}" for name in ("test_a_layer_alone", _ALL)]
    done = subprocess.run(
        [
            *command,
            sys.executable,
            "-m",
            "pytest",
            "-q",
            "-p",
            "no:cacheprovider",
            *tests,
            "-k",
            "works",
        ],
        cwd=ROOT,
        env=os.environ | {"HOME": "/", "PYTHONPATH": str(ROOT), "PYTHONDONTWRITEBYTECODE": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout[-5000:] + done.stderr[-2000:]
    assert "passed" in done.stdout
    skipped = [line for line in done.stdout.splitlines() if line.startswith("SKIPPED")]
    print(*skipped, sep="\n")  # noqa: T201 - shown with -s, and if this fails
    assert all("account" in line for line in skipped) if user else not skipped
