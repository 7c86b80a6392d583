"""Every expression of real xacro files comes to what xacro makes of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.real_packages import CORPUS, MODERN, REVIEWS, needed_folder
from tests.xacro.real_files import compared, requests

ROOT = Path(__file__).parent.parent.parent


def differences(folder: Path) -> tuple[int, list[object]]:
    found = [(path, compared(gathered, path)) for gathered, path in requests(folder)]
    others: list[object] = [(path, each) for path, result in found for each in result["others"]]
    return sum(result["number"] for _, result in found), others


@pytest.mark.parametrize("name", [CORPUS, REVIEWS, MODERN])
def test_of_real_packages(name: str) -> None:
    number, others = differences(needed_folder(name))
    assert not others
    assert number


def test_of_samples() -> None:
    assert not differences(ROOT / "samples")[1]
