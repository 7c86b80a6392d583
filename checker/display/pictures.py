"""Pictures of a robot and its trial, for readers without a 3D viewer and for print."""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass

from checker.confined import Child, Died, Limits
from checker.display.drawing.request import Shot, request_of
from checker.display.drawing.shots import ground_of, shots_of
from checker.display.scene import DisplayScene
from checker.report.report import Picture

WIDTH, HEIGHT = 640, 480
"""Pixels."""
_LIMITS = Limits(20.0, 4_000_000_000)
"""OpenGL takes 0.9 GB of address space for an empty scene, drivers of graphics cards more."""
_PLATFORMS = ("egl", "osmesa")


@dataclass(eq=False)
class Drawing:
    """Pictures in the making, by a child process that may be there before its scene is."""

    _child: Child | None = None
    _request: bytes = b""
    _shots: tuple[Shot, ...] = ()

    def begin(self) -> None:
        """Load what draws, while it is not known yet what."""
        if self._child is None:
            self._child = _artist(_PLATFORMS[0], None)

    def stop(self) -> None:
        """End what nobody waits for."""
        if self._child is not None:
            self._child.stop()

    def give(self, scene: DisplayScene) -> None:
        """Say what to draw; it is drawn while the caller does something else."""
        self._shots = tuple(shots_of(scene, WIDTH / HEIGHT))
        if self._shots:
            self._request = request_of(scene, self._shots, ground_of(scene), WIDTH, HEIGHT)
            self.begin()
            if self._child is not None:
                self._child.give(self._request)

    @property
    def pictures(self) -> tuple[Picture, ...]:
        """The pictures; none where nothing can draw without a window."""
        drawn = None
        if self._child is not None and self._shots:
            drawn = _drawn(self._child.answer(), len(self._shots))
            for platform in _PLATFORMS[1:]:
                if drawn is None:
                    answer = _artist(platform, self._request).answer()
                    drawn = _drawn(answer, len(self._shots))
        return tuple(
            Picture(shot.caption, jpeg, WIDTH, HEIGHT)
            for shot, jpeg in zip(self._shots, drawn or (), strict=drawn is not None)
        )


def _artist(platform: str, request: bytes | None) -> Child:
    return Child(f"checker.display.drawing.by_{platform}", request, _LIMITS)


def _drawn(answer: bytes | Died, number: int) -> list[bytes] | None:
    if isinstance(answer, Died):
        return None
    try:
        files = [base64.b64decode(each) for each in json.loads(answer)]
    except (TypeError, ValueError):
        return None
    return files if len(files) == number else None
