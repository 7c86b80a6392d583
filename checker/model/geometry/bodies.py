"""Bodies of even density: amount, centre and spread, from which their moments follow."""

from __future__ import annotations

import math
from collections.abc import Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.model.geometry.transform import Rotation, Transform, Vector

Matrix = Rotation
"""The rows of a 3 × 3 matrix."""

POINT: Matrix = ((0.0, 0.0, 0.0),) * 3
"""The spread of a point."""

_AXES = range(3)
_PAIRS = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


class Body(Record):
    """A body of even density.

    Attributes:
        amount: Its volume, m³, or its mass, kg.
        centre: Its centre, metres.
        spread: Mean products of two coordinates about the centre, m² (3 × 3).
    """

    amount: float
    centre: Vector
    spread: Matrix

    def times(self, factor: float) -> Body:
        """Return the body with another amount, such as a mass for a volume."""
        return replace(self, amount=self.amount * factor)

    def placed(self, pose: Transform) -> Body:
        """Return the body in the frame in which `pose` places it."""
        turn = Transform(pose.rotation)
        spread = (turn @ Transform(self.spread) @ turn.inverse).rotation
        return Body(self.amount, pose.apply(self.centre), spread)

    def moments(self, mass: float) -> tuple[float, ...]:
        """Return ixx, ixy, ixz, iyy, iyz, izz about the centre, kg·m², if this is its mass."""
        trace = math.fsum(self.spread[axis][axis] for axis in _AXES)
        return tuple(
            mass * ((trace if row == column else 0.0) - self.spread[row][column])
            for row, column in _PAIRS
        )


def together(bodies: Sequence[Body]) -> Body | None:
    """Return bodies as one, overlaps twice; None if they amount to nothing."""
    total = math.fsum(body.amount for body in bodies)
    if not 0.0 < total < math.inf:
        return None
    shares = [(body.amount / total, body) for body in bodies]
    x, y, z = (math.fsum(share * body.centre[axis] for share, body in shares) for axis in _AXES)
    arms = [
        (share, body.spread, (body.centre[0] - x, body.centre[1] - y, body.centre[2] - z))
        for share, body in shares
    ]

    def row(i: int) -> Vector:
        a, b, c = (
            math.fsum(share * (spread[i][j] + arm[i] * arm[j]) for share, spread, arm in arms)
            for j in _AXES
        )
        return a, b, c

    return Body(total, (x, y, z), (row(0), row(1), row(2)))
