"""The checker refuses the URDF files that urdfdom 6 refuses, and no other ones."""

from __future__ import annotations

import copy
import os
import random
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

from checker.base.cache import NO_CACHE
from checker.engine.review import findings_of
from checker.finding import Severity
from checker.package.inputs import open_input
from checker.settings import Settings
from support.judgements import folder_of

PROGRAM = Path(sys.executable).parent / "check_urdf"
REFUSING = ("SDF001", "URD004", "URD010", "URD012", "URD013", "KIN001", "KIN002", "KIN003")
SETTINGS = Settings(profile="urdf", profile_chosen=True, select=REFUSING, trial=False, cache=False)
MUTANTS = int(os.environ.get("SUBT_CHECK_MUTANTS", "300"))
LARGEST = 40_000
WORDS = ("nan", "inf", "-1", "0", "1,5", "", " ", "1 ", "word", "0 0", "0 0 0 0", "fixed", "planar")

EMPTY = "No link elements found"
"""The checker says that nothing was checked of such a file."""

Answer = Callable[[Path], str]


def passes(line: str) -> bool:
    """Say whether urdfdom passes over a fault: a colour that it cannot read."""
    return "malformed color rgba" in line


@pytest.fixture
def urdfdom() -> Answer:
    """What urdfdom says against a file; nothing where it loads all of it."""
    if not PROGRAM.exists():
        pytest.skip("check_urdf is not installed")

    def asked(file: Path) -> str:
        done = subprocess.run([PROGRAM, file], capture_output=True, text=True, check=False)
        said = done.stdout + done.stderr
        faults = [line for line in said.splitlines() if "Error:" in line and not passes(line)]
        loaded = "Successfully Parsed XML" in said and not faults
        return (
            ""
            if loaded or EMPTY in said
            else said.partition("Error:")[2].strip()[:300] or "refused"
        )

    return asked


def errors(file: Path) -> list[str]:
    with open_input(file) as opened:
        found = findings_of(opened.packages[0], SETTINGS, NO_CACHE)
    return [f"{it.rule} {it.message}" for it in found if it.severity is Severity.ERROR]


def urdf_files() -> list[Path]:
    folder = folder_of("urdf")
    files = sorted(folder.rglob("*.urdf")) if folder else []
    return [file for file in files if b"<link" in file.read_bytes()]


def mutant(text: str, seed: int) -> str:
    """Return a URDF text after one or two accidents in its links and joints."""
    chance = random.Random(seed)  # noqa: S311
    root = ElementTree.fromstring(text)  # noqa: S314
    for _ in range(chance.choice((1, 1, 2))):
        _hurt(root, chance)
    return ElementTree.tostring(root, encoding="unicode")


def _hurt(root: Element, chance: random.Random) -> None:
    parts = [part for part in root if part.tag in ("link", "joint")]
    pairs = [(holder, child) for part in parts for holder in part.iter() for child in holder]
    pairs += [(root, part) for part in parts]
    if not pairs:
        return
    holder, child = chance.choice(pairs)
    kind = chance.randrange(4)
    if kind == 0:
        holder.remove(child)
    elif kind == 1:
        holder.append(copy.deepcopy(child))
    elif child.attrib:
        name = chance.choice(sorted(child.attrib))
        if kind == 2:
            del child.attrib[name]
        else:
            child.set(name, chance.choice(WORDS))


@pytest.mark.parametrize("file", urdf_files(), ids=lambda file: file.stem)
def test_real_robots(file: Path, urdfdom: Answer) -> None:
    refused = urdfdom(file)
    assert bool(errors(file)) is bool(refused), refused


def test_mutants(tmp_path: Path, urdfdom: Answer) -> None:
    files = [file for file in urdf_files() if file.stat().st_size < LARGEST]
    if not files:
        pytest.skip("the URDF files of example-robot-data are not installed")
    different = []
    for seed in range(MUTANTS):
        origin = files[seed % len(files)]
        file = tmp_path / "robot.urdf"
        file.write_text(mutant(origin.read_text("utf-8"), seed))
        ours, theirs = errors(file), urdfdom(file)
        if bool(ours) is not bool(theirs):
            different.append(f"{origin.stem} {seed}: ours {ours[:2]}, urdfdom {theirs!r}")
    assert not different, "\n".join(different)
