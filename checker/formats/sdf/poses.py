"""The meaning of the six numbers of a `<pose>`, for the model, fixes and migration."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Protocol

from checker.model.geometry.transform import Transform
from checker.source.text import Located
from checker.source.xml import Element


class _HasAttributes(Protocol):
    def get(self, name: str, /) -> str | None: ...


def in_degrees(pose: _HasAttributes) -> bool:
    """Return whether the angles of a `<pose>` are in degrees, as SDF 1.9 and later allow."""
    return pose.get("degrees") in ("true", "1")


def frame_of(pose: Element, version: tuple[int, int]) -> Located[str] | None:
    """Return the frame that a `<pose>` names; None if it names none.

    It is `relative_to` in any version: libsdformat turns the `frame` of files before SDF 1.7 into
    it, in place of one that is written, and then reads them all alike.
    """
    old = pose.attribute("frame") if version < (1, 7) else None
    named = old if old is not None else pose.attribute("relative_to")
    return named if named is not None and named.value.strip() else None


def transform_of(pose: _HasAttributes, numbers: Iterable[float]) -> Transform:
    """Return the transform that a `<pose>` states.

    Args:
        pose: The element.
        numbers: x, y, z (metres), roll, pitch, yaw (radians, or degrees where it states it).
    """
    x, y, z, *angles = numbers
    roll, pitch, yaw = map(math.radians, angles) if in_degrees(pose) else angles
    return Transform.from_xyz_rpy((x, y, z), (roll, pitch, yaw))
