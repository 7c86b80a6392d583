"""A browser for the tests of the page."""

from __future__ import annotations

from tests.browser import chromium  # noqa: F401 - a fixture
