"""Specification sheets out of a few lines."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from checker.model.specification.sheet import Specification, read_specification
from checker.source.text import SourceText


@pytest.fixture
def sheet() -> Callable[..., Specification]:
    """Return a sheet with one section of a title and a text."""

    def make(text: str, title: str = "Cost and Scale") -> Specification:
        return read_specification(SourceText("specifications.md", f"# R\n\n## {title}\n\n{text}\n"))

    return make
