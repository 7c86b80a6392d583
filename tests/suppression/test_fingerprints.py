"""What tells one fault from another, wherever its lines move."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from checker.finding import numbered
from checker.pipeline import check_package
from checker.settings import Settings
from tests.conftest import SAMPLES
from tests.suppression.stage import axle, checked

BROKEN = "broken_rover_sensor_config_1"
XML = (".sdf", ".launch", ".xml", ".config")
SETTINGS = Settings(trial=False, cache=False)


def fingerprints(package: Path) -> dict[str, str]:
    (report,) = check_package(package, SETTINGS).packages
    said = {each.fingerprint: f"{each.rule} {each.message}" for each in report.findings}
    assert len(said) == len(report.findings)
    return said


@pytest.fixture(scope="module")
def before() -> dict[str, str]:
    return fingerprints(SAMPLES / BROKEN)


def lines_above(suffix: str, text: str) -> str:
    if suffix in XML:
        return re.sub(r"(<(?:model|launch|package|sdf)\b[^>]*>)", r"\1\n\n\n", text, count=1)
    return "\n\n" + text if suffix in (".rb", ".yaml") else text


def windows_line_ends(_: str, text: str) -> str:
    return text.replace("\n", "\r\n")


def attributes_written_otherwise(suffix: str, text: str) -> str:
    names = re.compile(r'<(\w+) name="([^"\']*)"')
    return names.sub(r"<\1\t  name = '\2' ", text) if suffix == ".sdf" else text


@pytest.mark.parametrize("change", [lines_above, windows_line_ends, attributes_written_otherwise])
def test_they_stay_when_lines_move(
    change: Callable[[str, str], str], before: dict[str, str], tmp_path: Path
) -> None:
    package = Path(shutil.copytree(SAMPLES / BROKEN, tmp_path / BROKEN))
    for file in package.rglob("*"):
        if file.suffix in (*XML, ".rb", ".md", ".yaml"):
            text = file.read_bytes().decode()
            file.write_bytes(change(file.suffix, text).encode())
    assert fingerprints(package).keys() == before.keys()


def test_they_stay_when_the_package_is_moved(before: dict[str, str], tmp_path: Path) -> None:
    package = shutil.copytree(SAMPLES / BROKEN, tmp_path / "deep" / "down" / BROKEN)
    assert fingerprints(Path(package)).keys() == before.keys()


def test_they_stay_when_the_package_is_renamed(before: dict[str, str], tmp_path: Path) -> None:
    """What is about the name itself, or about files that are found by it, is another fault."""
    package = shutil.copytree(SAMPLES / BROKEN, tmp_path / "other_rover_sensor_config_1")
    after = fingerprints(Path(package))
    about_elements = [print for print, said in before.items() if said.startswith(("KIN", "INE"))]
    assert about_elements
    assert set(about_elements) <= after.keys()


def test_equal_faults_are_told_apart(tmp_path: Path) -> None:
    twice = axle() + axle("<child>wheel</child>")
    prints = [each.fingerprint for each in checked(twice, tmp_path).findings]
    assert len(prints) == len(set(prints)) == 2


@given(st.lists(st.sampled_from("abcd"), max_size=30))
def test_numbering_makes_them_different(bases: list[str]) -> None:
    distinct = numbered(bases)
    assert len(set(distinct)) == len(bases)
    assert set(bases) <= set(distinct)


@given(st.lists(st.sampled_from("ab"), max_size=12), st.integers(0, 12))
def test_to_mend_one_of_equals_takes_the_last_number(bases: list[str], mended: int) -> None:
    left = numbered(bases[:mended] + bases[mended + 1 :])
    assert set(left) <= set(numbered(bases))
