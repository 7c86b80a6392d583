"""Angles that mean a multiple of π/2, written to 16 digits as the guide asks."""

from __future__ import annotations

import math

from lxml import etree

from checker.model.sdf.pose_numbers import in_degrees
from checker.model.values import parse_number

TOLERANCE = 1e-3
"""Radians: 1.57, 1.5708 and 3.1416 are meant, 1.56 is not."""
_PRECISE = 1e-15
"""Radians a quarter turn, that the 16th digit stands for."""
_NUMBERS = 6


def sharpen_angles(tree: etree._Element) -> list[str]:
    """Write out the angles of poses; return a sentence about those of which digits were missing."""
    changed = 0
    for pose in tree.iter("pose"):
        words = (pose.text or "").split()
        if len(words) != _NUMBERS or in_degrees(pose):
            continue
        sharp = [_sharp(word) for word in words[3:]]
        if sharp != words[3:]:
            pose.text = " ".join([*words[:3], *sharp])
            changed += 1
    if not changed:
        return []
    poses = "1 pose is" if changed == 1 else f"{changed} poses are"
    return [f"{poses} written with 16 digits where an angle means a multiple of π/2"]


def _sharp(word: str) -> str:
    angle = parse_number(word)
    if angle is None or not math.isfinite(angle):
        return word
    quarters = round(angle / (math.pi / 2))
    meant = quarters * (math.pi / 2)
    off = abs(angle - meant)
    if quarters == 0 or off <= _PRECISE * abs(quarters) or off >= TOLERANCE:
        return word
    return f"{meant:.16f}"
