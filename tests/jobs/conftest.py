"""What tests of checks share."""

from __future__ import annotations

import pytest

from tests.jobs.launched import look_from_now_on


@pytest.fixture(autouse=True)
def _own_processes() -> None:
    look_from_now_on()
