"""Every expression of real xacro files comes to what xacro makes of it."""

from __future__ import annotations

from pathlib import Path

import pytest

from support.real_packages import CORPUS, MODERN, REVIEWS, judged_folders, needed_folder
from tests.xacro.real_files import compared, requests

ROOT = Path(__file__).parent.parent.parent


def differences(folder: Path) -> tuple[int, list[object]]:
    found = [(path, compared(gathered, path)) for gathered, path in requests(folder)]
    others: list[object] = [(path, each) for path, result in found for each in result["others"]]
    return sum(result["number"] for _, result in found), others


@pytest.mark.corpus
@pytest.mark.parametrize("name", [CORPUS, REVIEWS, MODERN])
def test_of_real_packages(name: str) -> None:
    needed_folder(name)
    found = [differences(folder) for folder in judged_folders(name)]
    assert not [others for _, others in found if others]
    assert sum(number for number, _ in found)


def test_of_samples() -> None:
    assert not differences(ROOT / "samples")[1]
