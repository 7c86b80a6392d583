"""Draws by EGL: a module behind `checker.base.child_process`."""

from __future__ import annotations

from checker.report.scene.drawing.worker import answer, load

__all__ = ["answer", "prepare"]


def prepare() -> None:
    """Load what draws, before it is known what."""
    load("egl")
