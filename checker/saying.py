"""Telling the person who waits what is being done."""

from __future__ import annotations

from collections.abc import Callable

Say = Callable[[str], None]
"""Told in a few words what begins."""


def say_nothing(_: str) -> None:
    """Keep progress to oneself, as where nobody looks on."""
