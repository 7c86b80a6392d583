"""Pictures of a robot and its trial, for readers without a 3D viewer and for print."""

from __future__ import annotations

import base64
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

from checker.cache import NO_CACHE, Cache, code_hash, key_of
from checker.confined import Child, Died, from_json
from checker.display.drawing.request import Shot, request_of
from checker.display.drawing.shots import ground_of, shots_of
from checker.display.early import PLATFORMS, artist
from checker.display.scene import DisplayScene
from checker.report.report import Picture
from checker.versions import version_of

WIDTH, HEIGHT = 640, 480
"""Pixels."""
_KIND = "pictures"


@dataclass(eq=False)
class Drawing:
    """Pictures in the making, by a child process that may be there before its scene is.

    Attributes:
        cache: Where pictures are kept.
        child: Waits for a scene, or draws it.
    """

    cache: Cache = NO_CACHE
    child: Child | None = None
    _request: bytes = b""
    _key: str = ""
    _known: list[bytes] | None = None
    _shots: tuple[Shot, ...] = ()

    def begin(self) -> None:
        """Load what draws, while it is not known yet what."""
        if self.child is None:
            self.child = artist(PLATFORMS[0], None)

    def stop(self) -> None:
        """End what nobody waits for."""
        if self.child is not None:
            self.child.stop()

    def give(self, scene: DisplayScene) -> None:
        """Say what to draw; it is drawn while the caller does something else."""
        self._shots = tuple(shots_of(scene, WIDTH / HEIGHT))
        if self._shots:
            self._request = request_of(scene, self._shots, ground_of(scene), WIDTH, HEIGHT)
            self._key = key_of(self._request, code_hash("display/drawing"), version_of("mujoco"))
            self._known = _files(self.cache.get(_KIND, self._key), len(self._shots))
            if self._known is None:
                self.begin()
                if self.child is not None:
                    self.child.give(self._request)

    @property
    def pictures(self) -> tuple[Picture, ...]:
        """The pictures; none where nothing can draw without a window."""
        drawn = self._known or self._drawn()
        return tuple(
            Picture(shot.caption, jpeg, WIDTH, HEIGHT)
            for shot, jpeg in zip(self._shots, drawn or (), strict=drawn is not None)
        )

    def _drawn(self) -> list[bytes] | None:
        """Return what the child draws, and keep it; None where nothing can draw."""
        if self.child is None or not self._shots:
            return None
        for platform in PLATFORMS:
            is_first = platform == PLATFORMS[0]
            child = self.child if is_first else artist(platform, self._request)
            said = _read(child.answer())
            drawn = _files(said, len(self._shots))
            if drawn is not None:
                self.cache.put(_KIND, self._key, said)
                return drawn
        return None


def _read(answer: bytes | Died) -> Any:
    with suppress(ValueError):
        return None if isinstance(answer, Died) else from_json(answer)
    return None


def _files(said: Any, number: int) -> list[bytes] | None:
    """Return the files that stand in an answer, if they are as many as expected."""
    try:
        files = [base64.b64decode(each) for each in said]
    except (TypeError, ValueError):
        return None
    return files if len(files) == number else None
