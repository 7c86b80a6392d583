"""Left and right parts of a model: which ones are twins, and the plane that mirrors them."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from statistics import median

from checker.base.record import Record
from checker.physics.compiled.model import Body, Compiled

_SIDES = (
    ("left", "right"),
    ("Left", "Right"),
    ("LEFT", "RIGHT"),
    ("l", "r"),
    ("L", "R"),
    ("FL", "FR"),
    ("RL", "RR"),
    ("HL", "HR"),
    ("BL", "BR"),
)
_WORD = re.compile(r"left|right|Left|Right|LEFT|RIGHT|(?<![A-Za-z])[A-Za-z]{1,2}(?![A-Za-z])")
_NEAR = 0.005
"""Metres by which twins may be off."""
_FEWEST = 2
_SHARE = 0.6


class Twins(Record, eq=False):
    """Twin bodies of a model and the axis along which they mirror.

    Attributes:
        axis: 0 for x, 1 for y, 2 for z.
        bodies: Numbers of the bodies of each pair, left first, that are mirrored to 5 mm.
    """

    axis: int
    bodies: tuple[tuple[int, int], ...]


def other_side(name: str) -> str:
    """Return a name with its first word for left changed to the one for right; empty without.

    A name that begins with l, as `lfemur` does, is changed to one with r.
    """
    for found in _WORD.finditer(name):
        for left, right in _SIDES:
            if found[0] == left:
                return f"{name[: found.start()]}{right}{name[found.end() :]}"
    return {"l": "r", "L": "R"}[name[0]] + name[1:] if name[:1] in ("l", "L") else ""


def twins_of(compiled: Compiled) -> Twins | None:
    """Return the twins of a model; None unless most of two or more pairs are mirrored."""
    numbers = {body.name: number for number, body in enumerate(compiled.bodies) if body.name}
    pairs = [
        (number, numbers[twin])
        for name, number in numbers.items()
        if (twin := other_side(name)) in numbers
    ]
    if len(pairs) < _FEWEST:
        return None
    best = max((_mirrored(compiled.bodies, pairs, axis) for axis in range(3)), key=_count)
    return best if len(best.bodies) >= max(_FEWEST, _SHARE * len(pairs)) else None


def joint_pairs(compiled: Compiled, twins: Twins) -> Iterator[tuple[int, int]]:
    """Yield the numbers of the joints of twin bodies that have as many joints, left first."""
    for left, right in twins.bodies:
        of_left = [at for at, joint in enumerate(compiled.joints) if joint.body == left]
        of_right = [at for at, joint in enumerate(compiled.joints) if joint.body == right]
        if len(of_left) == len(of_right):
            yield from zip(of_left, of_right, strict=True)


def _mirrored(bodies: Sequence[Body], pairs: list[tuple[int, int]], axis: int) -> Twins:
    middles = [
        (bodies[left].position[axis] + bodies[right].position[axis]) / 2 for left, right in pairs
    ]
    centre = median(middles)
    alike = [
        (left, right)
        for left, right in pairs
        if _are_mirrored(bodies[left].position, bodies[right].position, axis, centre)
    ]
    apart = [
        pair
        for pair in alike
        if abs(bodies[pair[0]].position[axis] - bodies[pair[1]].position[axis]) > _NEAR
    ]
    # Pairs on top of each other are mirrored about any plane.
    return Twins(axis, tuple(alike) if apart else ())


def _are_mirrored(left: Sequence[float], right: Sequence[float], axis: int, centre: float) -> bool:
    """Return whether two points are mirrored about a plane to 5 mm."""
    image = [2 * centre - value if at == axis else value for at, value in enumerate(left)]
    return max(abs(one - other) for one, other in zip(image, right, strict=True)) <= _NEAR


def _count(twins: Twins) -> int:
    return len(twins.bodies)
