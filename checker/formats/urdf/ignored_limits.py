"""Limits of the angle of a continuous joint, which readers of URDF ignore."""

from __future__ import annotations

import math

from checker.model.components import Joint
from checker.model.values import parse_number

_TURN = 2 * math.pi
_NEARLY = 0.999
"""Limits are written with few digits."""


def ignored_limits(joint: Joint) -> tuple[float, float] | None:
    """Return the limits of less than a turn, in radians, of a continuous joint; else None."""
    limit = joint.element.child("limit")
    if joint.type.value != "continuous" or limit is None:
        return None
    lower, upper = (parse_number((limit.get(end) or "0").strip()) for end in ("lower", "upper"))
    if lower is None or upper is None or not 0.0 < upper - lower < _NEARLY * _TURN:
        return None
    return lower, upper
