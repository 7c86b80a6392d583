"""Fixes damage nothing, whatever the folder of a package is called."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

from checker.cli.check.fix import fix_paths
from checker.finding import Safety
from support.real_packages import CORPUS, MODERN, judged_folders, needs
from tests.conftest import SAMPLES
from tests.fixing.damage import contents, lost, spoilt
from tests.oracle.conftest import Load

SAFE, EVERY = [Safety.SAFE], list(Safety)
FOLDERS = ("a copy", "{}-master", "{} (1)")
SDF = (".sdf", ".world")


def outermost(tops: Sequence[Path]) -> Iterator[Path]:
    """Yield the packages below some folders that lie in no other one."""
    found: list[Path] = []
    for path in sorted(path for top in tops for path in top.rglob("*")):
        inside = any(path.parent.is_relative_to(folder) for folder in found)
        if path.name in ("package.xml", "model.config") and not inside:
            found.append(path.parent)
            yield path.parent


def damage(package: Path, profile: str, safeties: list[Safety], load: Load) -> Iterator[str]:
    """Fix a package, and yield what is wrong then."""
    before = contents(package)
    models = [package / path for path in before if path.endswith(SDF)]
    accepted = [not each.errors for each in load(models)]
    settings = {"profile": profile, "trial": False}
    fix_paths([package], settings, safeties, write=True)
    after = contents(package)
    yield from spoilt(before, after)
    yield from lost(before, after)
    for model, was_accepted, each in zip(models, accepted, load(models), strict=True):
        if was_accepted and each.errors:
            yield f"{model.name} is refused: {each.reason}"
    for again in fix_paths([package], settings, safeties, write=False):
        yield from (f"{file.path} changes again" for file in again.fixed.files)


SHARES = 3
"""Tests that share the packages of a folder, so that processes can share the work."""


@pytest.mark.parametrize(
    ("tops", "profile", "safeties"),
    [
        pytest.param([SAMPLES], "subt", SAFE, id="samples-safe"),
        pytest.param([SAMPLES], "subt", EVERY, id="samples-unsafe"),
        pytest.param(judged_folders(CORPUS), "subt", SAFE, marks=needs(CORPUS), id="corpus-safe"),
        pytest.param(
            judged_folders(CORPUS), "subt", EVERY, marks=needs(CORPUS), id="corpus-unsafe"
        ),
        # There are many of them, and the safe fixes are made here too.
        pytest.param(
            judged_folders(MODERN), "gazebo-harmonic", EVERY, marks=needs(MODERN), id="modern"
        ),
    ],
)
@pytest.mark.parametrize("share", range(SHARES))
def test_nothing_is_damaged(
    tops: Sequence[Path],
    profile: str,
    safeties: list[Safety],
    share: int,
    tmp_path: Path,
    libsdformat: Load,
) -> None:
    wrong = []
    for number, package in list(enumerate(outermost(tops), len(safeties)))[share::SHARES]:
        # Each package in one folder: all in all of them take minutes and tell no more.
        name = FOLDERS[number % len(FOLDERS)].format(package.name)
        folder = tmp_path / str(number) / name
        shutil.copytree(package, folder, symlinks=True)
        found = damage(folder, profile, safeties, libsdformat)
        wrong += [f"{package.name} in {name!r}: {each}" for each in found]
        shutil.rmtree(folder.parent)
    assert not wrong, "\n".join(wrong)
