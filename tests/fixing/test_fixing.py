"""Packages are fixed: in rounds, on disk, whole files at a time, and nowhere else."""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from checker.base.errors import CheckerError
from checker.cli import main
from checker.cli.check.fix import FixedPackage, fix_paths
from checker.finding import Safety
from checker.fix.rounds import patch
from checker.pipeline import check_package
from checker.report.report import ReportedFinding
from checker.rule_testing import write_example
from checker.settings import Settings
from tests.conftest import SAMPLES

BROKEN = "broken_rover_sensor_config_1"
STILL = Settings(trial=False)
EVERY = (Safety.SAFE, Safety.UNSAFE)
LIDAR = """
<sensor name="lidar" type="gpu_lidar">
  <lidar>
    <scan><horizontal><resolution>0.1</resolution></horizontal></scan>
  </lidar>
</sensor>
"""
Fix = Callable[..., FixedPackage]


@pytest.fixture
def fix() -> Fix:
    """Fix one package."""

    def fix(path: Path, *safeties: Safety, write: bool = True) -> FixedPackage:
        (package,) = fix_paths([path], {}, safeties or (Safety.SAFE,), write=write)
        return package

    return fix


def findings(path: Path) -> tuple[ReportedFinding, ...]:
    """Return what is found in a package without driving it."""
    (package,) = check_package(path, STILL).packages
    return package.findings


def contents(folder: Path) -> dict[str, bytes]:
    """Return all files below a folder."""
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path.relative_to(folder)): path.read_bytes() for path in files}


def copied(name: str, folder: Path) -> Path:
    return Path(shutil.copytree(SAMPLES / name, folder / name))


def test_safe_faults_of_the_broken_rover_are_gone(tmp_path: Path, fix: Fix) -> None:
    package = copied(BROKEN, tmp_path)
    fixed = fix(package).fixed
    assert len(fixed.findings) > 10
    assert not [each for each in findings(package) if each.fix and each.fix.safety is Safety.SAFE]
    assert not fixed.left


@pytest.mark.slow
@pytest.mark.parametrize("safeties", [(Safety.SAFE,), EVERY], ids=["safe", "unsafe"])
def test_the_second_time_nothing_changes(
    tmp_path: Path, fix: Fix, safeties: tuple[Safety, ...]
) -> None:
    package = copied(BROKEN, tmp_path)
    fix(package, *safeties)
    once = contents(package)
    assert fix(package, *safeties).fixed.files == ()
    assert contents(package) == once


@pytest.mark.slow
def test_no_fix_brings_a_new_finding(tmp_path: Path, fix: Fix) -> None:
    package = copied(BROKEN, tmp_path)
    before = Counter(each.rule for each in findings(package) for _ in each.places)
    fix(package)
    after = Counter(each.rule for each in findings(package) for _ in each.places)
    assert not after - before


def test_fixes_of_real_packages_bring_no_finding_and_rest(
    tmp_path: Path, fix: Fix, corpus: Path
) -> None:
    copies = tmp_path / "corpus"
    shutil.copytree(corpus, copies, symlinks=True)
    for package in sorted(copies.glob("*_config_*")):
        before = {each.rule for each in findings(package)}
        fix(package)
        assert {each.rule for each in findings(package)} <= before
        assert fix(package).fixed.files == ()


@pytest.mark.programs
def test_a_patch_changes_nothing_and_git_applies_it(tmp_path: Path, fix: Fix) -> None:
    package = copied(BROKEN, tmp_path)
    as_it_was = contents(package)
    text = patch(fix(package, write=False).fixed.files)
    assert contents(package) == as_it_was
    subprocess.run(["git", "apply", "-"], input=text.encode(), cwd=package, check=True)
    patched = contents(package)
    shutil.rmtree(package)
    package = copied(BROKEN, tmp_path)
    fix(package)
    assert contents(package) == patched


def test_only_the_faulty_line_changes_and_line_endings_stay(tmp_path: Path, fix: Fix) -> None:
    package = write_example(LIDAR, tmp_path)
    model = package / "model.sdf"
    text = "\ufeff<!-- é -->\r\n" + model.read_text("utf-8").replace("\n", "\r\n")
    text = text.replace('\ufeff<!-- é -->\r\n<?xml version="1.0"?>', "\ufeff")
    model.write_bytes(text.encode("utf-8"))
    fix(package)
    expected = text.replace("<resolution>0.1<", "<resolution>1<")
    assert model.read_bytes() == expected.encode("utf-8")


def test_permissions_stay(tmp_path: Path, fix: Fix) -> None:
    package = write_example(LIDAR, tmp_path)
    (package / "model.sdf").chmod(0o640)
    fix(package)
    assert (package / "model.sdf").stat().st_mode & 0o777 == 0o640


def test_a_file_behind_a_link_is_left_alone(tmp_path: Path, fix: Fix) -> None:
    package = write_example(LIDAR, tmp_path)
    model = package / "model.sdf"
    real = package / "worlds" / "real.sdf"
    model.rename(real)
    model.symlink_to("worlds/real.sdf")
    before = real.read_bytes()
    fixed = fix(package).fixed
    assert real.read_bytes() == before
    assert model.is_symlink()
    assert "SEN005" in {each.rule for each in fixed.left}


def test_an_archive_is_not_changed(tmp_path: Path, fix: Fix) -> None:
    package = write_example(LIDAR, tmp_path / "in")
    archive = Path(shutil.make_archive(str(tmp_path / "rover"), "zip", package.parent))
    with pytest.raises(CheckerError, match=r"is an archive; archives are not changed"):
        fix(archive)
    assert fix(archive, write=False).fixed.files


def test_a_full_disk_leaves_everything_as_it_was(
    tmp_path: Path, fix: Fix, monkeypatch: pytest.MonkeyPatch
) -> None:
    package = copied(BROKEN, tmp_path)
    before = contents(package)
    calls: list[int] = []

    def full(number: int) -> None:
        calls.append(number)
        if len(calls) == 2:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(CheckerError, match="No space left on device"):
        fix(package)
    assert contents(package) == before


def test_commands_say_what_they_did(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    package = write_example(LIDAR, tmp_path)
    chosen = [str(package), "--no-trial", "--select", "SEN005"]
    assert main(["--diff", *chosen]) == 1
    shown = capsys.readouterr().out
    assert "-    <scan><horizontal><resolution>0.1</resolution>" in shown
    assert "+    <scan><horizontal><resolution>1</resolution>" in shown
    assert main(["--fix", *chosen]) == 0
    said = capsys.readouterr()
    assert "fixed 1 finding in model.sdf (SEN005)" in said.err
    assert "nothing to fix" in said.out
    assert main(["--diff", *chosen]) == 0
    assert capsys.readouterr().out == ""


@pytest.mark.programs
def test_a_workspace_is_fixed_package_by_package(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    for number in (1, 2):
        write_example(
            {"@name": f"rover_sensor_config_{number}", "@fragment": LIDAR}, tmp_path / "a"
        )
    chosen = ["a", "--no-trial", "--select", "SEN005"]
    assert main(["--diff", *chosen, "--output", "all.patch"]) == 1
    as_it_was = contents(tmp_path / "a")
    subprocess.run(["git", "apply", "all.patch"], check=True)
    patched = contents(tmp_path / "a")
    assert patched != as_it_was
    for path, content in as_it_was.items():
        (tmp_path / "a" / path).write_bytes(content)
    capsys.readouterr()
    assert main(["--fix", *chosen, "--format", "json"]) == 0
    said = capsys.readouterr()
    assert contents(tmp_path / "a") == patched
    assert [each["findings"] for each in json.loads(said.out)["packages"]] == [[], []]
    assert "a/rover_sensor_config_1: fixed 1 finding in model.sdf (SEN005)" in said.err
    assert "a/rover_sensor_config_2: fixed 1 finding in model.sdf (SEN005)" in said.err


def test_a_lone_file_is_fixed(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    model = write_example(LIDAR, tmp_path).relative_to(tmp_path) / "model.sdf"
    chosen = [str(model), "--no-trial", "--select", "SEN005"]
    assert main(["--diff", *chosen]) == 1
    assert f"--- a/{model.as_posix()}\n" in capsys.readouterr().out
    assert main(["--fix", *chosen]) == 0
    assert "<resolution>1</resolution>" in model.read_text("utf-8")


def test_nothing_is_fixed_when_one_of_several_is_an_archive(tmp_path: Path) -> None:
    package = write_example(LIDAR, tmp_path / "in")
    archive = Path(shutil.make_archive(str(tmp_path / "rover"), "zip", package.parent))
    before = contents(package)
    with pytest.raises(CheckerError, match=r"is an archive"):
        fix_paths([package, archive], {}, EVERY, write=True)
    assert contents(package) == before


def test_what_a_sibling_lends_is_fixed_with_the_sibling(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    write_example({"@name": "rover_sensor_config_1", "@fragment": LIDAR}, tmp_path)
    borrower = {"@name": "rover_sensor_config_2", "model.sdf": None, "model.config": None}
    manifest = "<package><name>rover_sensor_config_2</name>\n"
    manifest += "<exec_depend>rover_sensor_config_1</exec_depend></package>\n"
    package = write_example({**borrower, "package.xml": manifest}, tmp_path)
    main(["--fix", "--no-trial", "--select", "SEN005", str(package)])
    said = capsys.readouterr().err
    assert "1 finding to fix in ../rover_sensor_config_1/model.sdf" in said
    assert "could not fix" not in said
