"""Readers of the values that rules compare with a number, from their messages."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

_MOST = 1e12
_N = r"(-?[\d.]+(?:e[-+]?\d+)?)"


def _first(*numbers: float) -> float:
    return numbers[0]


def _ratio(one: float, other: float) -> float:
    return one / other if other else _MOST


def _larger_ratio(one: float, other: float) -> float:
    return _ratio(max(one, other), min(one, other))


def _off(stated: float, true: float) -> float:
    return abs(_ratio(stated, true) - 1.0)


def _of_mm(millimetres: float) -> float:
    return millimetres / 1e3


def _of_percent(percent: float) -> float:
    return percent / 100


@dataclass(frozen=True)
class Measure:
    """A value of a rule.

    Attributes:
        rule: Its id.
        what: The value, with its unit.
        numbers: Options that contain the numbers that it is compared with.
        pattern: Finds the value, or what it is computed from, in a message. Where a group is
            missing, its value is 0.
        options: Make the rule report all values.
        value: Works it out.
        below: The numbers that are lower limits of a value; the others are upper limits.
        linear: Whether the axis of the plot is linear.
    """

    rule: str
    what: str
    numbers: tuple[str, ...]
    pattern: str
    options: dict[str, Any] = field(hash=False)
    value: Callable[..., float] = _first
    below: tuple[str, ...] = ()
    linear: bool = False

    def of(self, rule: str, message: str) -> float | None:
        """Return the value in a message; None if it has another."""
        found = re.search(self.pattern, message) if rule == self.rule else None
        if found is None:
            return None
        return self.value(*(float((text or "0").replace(",", "")) for text in found.groups()))


MEASURES = (
    Measure(
        "INE004", "radius of gyration / farthest point",
        ("warning_below", "warning_above", "error_above"),
        f"gyration of {_N} m, but its farthest point is {_N} m",
        {"warning_above": 0.0}, _ratio, below=("warning_below",),
    ),
    Measure(
        "INE005", "distance of the centre of mass from the box / its diagonal",
        ("warning_above", "error_above"),
        f"is {_N} m outside its shapes, which measure {_N} m",
        {"warning_above": 0.0}, _ratio,
    ),
    Measure(
        "INE006", "density for the greatest volume, kg/m³", ("heaviest", "impossible"),
        f"litres: {_N} kg/m³", {"heaviest": 0.0},
    ),
    Measure(
        "INE006", "density for the smallest volume, kg/m³", ("lightest",),
        f"litres: {_N} kg/m³", {"lightest": _MOST, "heaviest": _MOST, "metal": _MOST},
        below=("lightest",),
    ),
    Measure(
        "INE006", "density / that of the other links", ("contrast",),
        f"litres: {_N} kg/m³.* other links have {_N}",
        {"metal": 0.0, "contrast": 0.0, "heaviest": _MOST}, _ratio,
    ),
    Measure(
        "INE009", "tip angle, degrees", ("error_below_degrees", "indoors_below_degrees",
        "warning_below_degrees"), f"tips over (?:at {_N}°|on flat)",
        {"warning_below_degrees": 1e3, "indoors_below_degrees": 1e3},
        below=("error_below_degrees", "indoors_below_degrees", "warning_below_degrees"),
        linear=True,
    ),
    Measure(
        "INE010", "torque against gravity / effort limit", ("factor",),
        f"hold {_N} .* limit is {_N}", {"factor": 0.0}, _ratio,
    ),
    Measure(
        "INE012", "heavier mass / lighter mass", ("ratio",),
        f"of {_N} kg with .* of {_N} kg", {"ratio": 0.0}, _larger_ratio,
    ),
    Measure(
        "GEO003", "angle between wheel and joint, degrees", ("degrees",),
        f"is {_N}° off", {"degrees": 0.0},
    ),
    Measure(
        "GEO004", "error of the drive's radius, share", ("warning_above", "error_above"),
        f"{_N} m, but wheel .* of {_N} m", {"warning_above": 0.0}, _off,
    ),
    Measure(
        "GEO005", "stated distance / true distance", ("least", "most_of_steering", "most"),
        f"apart: {_N} times", {"least": 1e9}, below=("least",),
    ),
    Measure(
        "GEO006", "height off the level of the others, m", ("warning_above", "error_above"),
        f"is {_N} mm (?:above|below)", {"warning_above": 1e-6}, _of_mm,
    ),
    Measure(
        "GEO007", "difference of a wheel's collision and visual / larger diagonal",
        ("wheel_share",), f"{_N}% of the larger diagonal",
        {"wheel_share": 0.0, "other_share": _MOST}, _of_percent,
    ),
    Measure(
        "GEO007", "difference of another link's collision and visual / larger diagonal",
        ("other_share",), f"{_N}% of the larger diagonal",
        {"wheel_share": _MOST, "other_share": 0.0}, _of_percent,
    ),
    Measure(
        "GEO012", "gap to the nearest other part, if above 5 mm, m", ("gap",),
        f"nearest other part is {_N} mm away", {"gap": 0.005}, _of_mm,
    ),
    Measure(
        "GEO014", "longest side, m", ("smallest", "largest"), f"robot measures {_N} m",
        {"smallest": 1e9, "lightest": 1e9}, below=("smallest",),
    ),
    Measure(
        "GEO014", "mass, kg", ("lightest", "heaviest"), f"robot weighs {_N} kg",
        {"smallest": 1e9, "lightest": 1e9}, below=("lightest",),
    ),
    Measure(
        "GEO015", "depth, m", ("depth",), f"starts {_N} mm inside", {"depth": 0.0},
        _of_mm,
    ),
    Measure(
        "GEO017", "difference of the steps on both sides, m", ("step",),
        f"stands {_N} mm farther .* other side {_N} mm", {"step": 0.0},
        lambda one, other: _of_mm(abs(one - other)),
    ),
    Measure(
        "KIN007", "effort limit, N·m or N", ("highest_effort",), f"effort limit {_N} .*at most",
        {"highest_effort": 0.0, "highest_velocity": 0.0},
    ),
    Measure(
        "KIN007", "velocity limit, rad/s or m/s", ("highest_velocity",),
        f"velocity limit {_N} .*at most", {"highest_effort": 0.0, "highest_velocity": 0.0},
    ),
    Measure(
        "KIN013", "gap of part and parent / sum of their diagonals", ("gap",),
        f"m away, {_N} times", {"gap": 0.0},
    ),
    Measure(
        "KIN013", "distance of the axis / diagonal of the part", ("sizes",),
        f"is {_N} m away from .* measures {_N} m", {"sizes": 1e-9}, _ratio,
    ),
    Measure(
        "MSH004", "triangles of a collision", ("collision",),
        r"collision mesh .* has ([\d,]+) triangles", {"collision": 0, "visual": 0, "together": 0},
    ),
    Measure(
        "MSH004", "triangles of a visual", ("visual",),
        r"visual mesh .* has ([\d,]+) triangles", {"collision": 0, "visual": 0, "together": 0},
    ),
    Measure(
        "MSH004", "triangles of the robot", ("together",),
        r"robot have ([\d,]+) triangles", {"collision": 0, "visual": 0, "together": 0},
    ),
    Measure(
        "MSH005", "mesh / robot without its meshes", ("beyond",),
        f"measures {_N} m, but the robot without its meshes measures {_N} m",
        {"beyond": 1e-6, "huge": 0.0}, _ratio,
    ),
    Measure(
        "SEN019", "share of a lidar's rays", ("most",), f"{_N}% of its rays", {"most": 0.0},
        _of_percent,
    ),
    Measure(
        "SEN019", "share of a camera's view that is close", ("most",),
        f"{_N}% of its view is filled by the robot within", {"most": 0.0},
        _of_percent,
    ),
    Measure(
        "SEN019", "share of a camera's view", ("most_of_picture",),
        f"{_N}% of its view is filled by the robot itself",
        {"most": 10.0, "most_of_picture": 0.0}, _of_percent,
    ),
    Measure(
        "SEN029", "share of a planar lidar's rays", ("most",), f"in {_N}% of its rays",
        {"most": 1.0}, _of_percent,
    ),
)  # fmt: skip
"""Values that can be measured part by part."""
