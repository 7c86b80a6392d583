"""What the viewer's tests share."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from tests.viewer.rover import rover
from tests.viewer.showing import shown

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page


@pytest.fixture
def view(chromium: Browser, tmp_path: Path) -> Iterator[Page]:
    """The rover, at the start of its trial."""
    with shown(chromium, tmp_path, rover()) as page:
        assert page.evaluate("heard.failure") == ""
        yield page
