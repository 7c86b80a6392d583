"""`--fix` asks git first, and a hostile repository gets nothing started by it."""

from __future__ import annotations

import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.cli import main
from checker.fix.uncommitted import uncommitted
from checker.rule_testing import write_example

pytestmark = [
    pytest.mark.programs,
    pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed"),
]
LIDAR = """
<sensor name="lidar" type="gpu_lidar">
  <lidar><scan><horizontal><resolution>0.1</resolution></horizontal></scan></lidar>
</sensor>
"""
CHOSEN = ["--no-trial", "--select", "SEN005"]
Git = Callable[..., None]


@pytest.fixture
def git(tmp_path: Path) -> Git:
    """Run git in a new repository in the test's folder."""

    def run(*words: str) -> None:
        own = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
        who = ["-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "core.autocrlf=false"]
        subprocess.run(["git", *who, *words], cwd=tmp_path, env=own, check=True)

    run("init", "--quiet")
    return run


@pytest.fixture
def package(tmp_path: Path, git: Git) -> Path:
    """A package with a fault, all committed."""
    folder = write_example(LIDAR, tmp_path)
    git("add", ".")
    git("commit", "--quiet", "--message", "A rover")
    return folder


def fixed(package: Path, *more: str) -> bool:
    """Fix a package, and return whether its model is another one."""
    before = (package / "model.sdf").read_bytes()
    main(["--fix", *CHOSEN, *more, str(package)])
    return (package / "model.sdf").read_bytes() != before


def test_committed_files_are_fixed(package: Path) -> None:
    assert fixed(package)


def test_uncommitted_changes_are_named_and_kept(
    package: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = package / "model.sdf"
    model.write_text(model.read_text() + "<!-- mine -->\n")
    assert main(["--fix", *CHOSEN, str(package)]) == 2
    said = capsys.readouterr().err
    assert f"1 file to change has uncommitted changes: {model}; commit or stash" in said
    assert "--allow-dirty" in said
    assert "0.1" in model.read_text()
    assert main(["--diff", *CHOSEN, str(package)]) == 1
    assert fixed(package, "--allow-dirty")


def test_changes_of_other_files_are_no_reason(package: Path) -> None:
    (package / "package.xml").write_text("<package/>")
    (package / "notes.txt").write_text("new")
    assert fixed(package)


def test_staged_changes_are_uncommitted(package: Path, git: Git) -> None:
    model = package / "model.sdf"
    model.write_text(model.read_text() + "<!-- mine -->\n")
    git("add", ".")
    assert not fixed(package)


@pytest.mark.parametrize("committed", [True, False], ids=["commits", "none"])
def test_new_files_are_uncommitted_and_ignored_ones_are_not(
    tmp_path: Path, git: Git, committed: bool
) -> None:
    if committed:
        git("commit", "--quiet", "--allow-empty", "--message", "Nothing")
    folder = write_example(LIDAR, tmp_path)
    assert not fixed(folder)
    (tmp_path / ".gitignore").write_text("*_config_*\n")
    assert fixed(folder)


def test_nothing_is_written_when_one_of_two_packages_is_dirty(tmp_path: Path, git: Git) -> None:
    one = write_example({"@name": "rover_sensor_config_1", "@fragment": LIDAR}, tmp_path)
    two = write_example({"@name": "rover_sensor_config_2", "@fragment": LIDAR}, tmp_path)
    git("add", one.name)
    git("commit", "--quiet", "--message", "One")
    assert main(["--fix", *CHOSEN, str(one), str(two)]) == 2
    assert "0.1" in (one / "model.sdf").read_text()


def test_line_ends_that_git_changes_are_no_change(package: Path) -> None:
    model = package / "model.sdf"
    model.write_bytes(model.read_bytes().replace(b"\n", b"\r\n"))
    assert uncommitted(package, ["model.sdf"]) == []


def test_outside_a_repository_nobody_is_asked(tmp_path: Path) -> None:
    assert fixed(write_example(LIDAR, tmp_path))


def test_a_repository_that_git_cannot_read(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = write_example(LIDAR, tmp_path)
    (tmp_path / ".git").write_text("gitdir: /nowhere\n")
    assert not fixed(folder)
    assert "git cannot tell whether files in" in capsys.readouterr().err
    assert fixed(folder, "--allow-dirty")


def test_programs_that_a_repository_names_are_not_started(package: Path, git: Git) -> None:
    trap, sprung = package.parent / "trap.sh", package.parent / "sprung"
    trap.write_text(f"#!/bin/sh\ntouch {sprung}\ncat\n")
    trap.chmod(0o755)
    hooks = package.parent / "hooks"
    hooks.mkdir()
    for hook in ("post-index-change", "fsmonitor-watchman", "query-watchman"):
        shutil.copy(trap, hooks / hook)
    for key in ("core.fsmonitor", "core.pager", "core.sshCommand", "core.askPass"):
        git("config", key, str(trap))
    for key in ("filter.a.clean", "filter.a.smudge", "filter.a.process", "diff.a.textconv"):
        git("config", key, str(trap))
    git("config", "core.hooksPath", str(hooks))
    git("config", "alias.ls-tree", f"!{trap}")
    (package / ".gitattributes").write_text("* filter=a diff=a\n")
    os.utime(package / "model.sdf")
    new = package / "new.sdf"
    new.write_text("<sdf/>")
    assert uncommitted(package, ["model.sdf", "new.sdf"]) == ["new.sdf"]
    assert not sprung.exists()
    subprocess.run(["git", "status"], cwd=package, capture_output=True, check=False)
    assert sprung.exists(), "the trap works"


def test_a_name_is_no_option_and_no_pattern(tmp_path: Path, git: Git) -> None:
    names = ["--help", "*.sdf", ":(top)a", "a b.sdf", "ä.sdf"]
    for name in names:
        (tmp_path / name).write_text(name)
    git("add", ".")
    git("commit", "--quiet", "--message", "Names")
    assert uncommitted(tmp_path, names) == []
    (tmp_path / "*.sdf").write_text("other")
    assert uncommitted(tmp_path, names) == ["*.sdf"]
    with pytest.raises(CheckerError, match="cannot tell"):
        uncommitted(tmp_path, ["../../../outside.sdf"])
