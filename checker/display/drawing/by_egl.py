"""Draws by EGL: a module behind `checker.confined`."""

from __future__ import annotations

from checker.display.drawing.worker import answer, load

__all__ = ["answer", "prepare"]


def prepare() -> None:
    """Load what draws, before it is known what."""
    load("egl")
