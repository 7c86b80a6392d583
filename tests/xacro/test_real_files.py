"""Every expression of real xacro files comes to what xacro makes of it."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from tests.xacro.real_files import compared, requests

ROOT = Path(__file__).parent.parent.parent
FOLDERS = ("SUBT_CHECK_CORPUS", "SUBT_CHECK_REVIEWS", "SUBT_CHECK_MODERN")


def differences(folder: Path) -> tuple[int, list[object]]:
    found = [(path, compared(gathered, path)) for gathered, path in requests(folder)]
    others: list[object] = [(path, each) for path, result in found for each in result["others"]]
    return sum(result["number"] for _, result in found), others


@pytest.mark.parametrize("name", FOLDERS)
def test_of_real_packages(name: str) -> None:
    folder = Path(os.environ.get(name) or "/nowhere")
    if not folder.is_dir():
        pytest.skip(f"{name} names no folder of real packages")
    number, others = differences(folder)
    assert not others
    assert number


def test_of_samples() -> None:
    assert not differences(ROOT / "samples")[1]
