"""What all tests share: the corpus of real packages, where it is at hand."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

SAMPLES = Path(__file__).parent.parent / "samples"


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--update-golden", action="store_true", help="write reports and generated pages anew"
    )


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real packages that SUBT_CHECK_CORPUS names."""
    folder = os.environ.get("SUBT_CHECK_CORPUS", "")
    if not folder or not Path(folder).is_dir():
        pytest.skip("SUBT_CHECK_CORPUS names no folder of real packages")
    return Path(folder)


@pytest.fixture(scope="session")
def samples() -> Path:
    """The sample packages."""
    return SAMPLES
