"""Rigid transforms in plain Python: 12 numbers, so that reading a model needs no numpy."""

from __future__ import annotations

import math
import operator
from collections.abc import Sequence
from functools import cached_property

from checker.base.record import Record

Vector = tuple[float, float, float]
Rotation = tuple[Vector, Vector, Vector]

_IDENTITY: Rotation = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def dot(a: Sequence[float], b: Sequence[float]) -> float:
    """Return the scalar product of two vectors of one length, which may be long."""
    return math.fsum(map(operator.mul, a, b))


def rotation_from_rpy(roll: float, pitch: float, yaw: float) -> Rotation:
    """Return R = Rz(yaw)·Ry(pitch)·Rx(roll), angles in radians (SDF and URDF convention)."""
    cr, sr = math.cos(roll), math.sin(roll)
    cp, sp = math.cos(pitch), math.sin(pitch)
    cy, sy = math.cos(yaw), math.sin(yaw)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


def rotation_from_quaternion(w: float, x: float, y: float, z: float) -> Rotation:
    """Return the rotation of a quaternion, which is normalised first.

    Raises:
        ValueError: All four numbers are zero.
    """
    norm = math.hypot(w, x, y, z)
    if norm == 0.0:
        raise ValueError("a quaternion of zeros is not a rotation")
    w, x, y, z = w / norm, x / norm, y / norm, z / norm
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
        (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
        (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)),
    )


class Transform(Record, dict=True):
    """The pose of a frame B in a frame A: p_A = rotation · p_B + translation.

    Attributes:
        rotation: 3×3, as rows.
        translation: Origin of B in A, metres.
    """

    rotation: Rotation = _IDENTITY
    translation: Vector = (0.0, 0.0, 0.0)

    @classmethod
    def from_xyz_rpy(cls, xyz: Vector, rpy: Vector) -> Transform:
        """Make a transform of a position (metres) and roll, pitch, yaw (radians)."""
        return cls(rotation_from_rpy(*rpy), xyz)

    def rotate(self, vector: Vector) -> Vector:
        """Return a direction of B in A."""
        x, y, z = vector
        rows = self.rotation
        return (
            rows[0][0] * x + rows[0][1] * y + rows[0][2] * z,
            rows[1][0] * x + rows[1][1] * y + rows[1][2] * z,
            rows[2][0] * x + rows[2][1] * y + rows[2][2] * z,
        )

    def apply(self, point: Vector) -> Vector:
        """Return a point of B in A, metres."""
        turned, origin = self.rotate(point), self.translation
        return (turned[0] + origin[0], turned[1] + origin[1], turned[2] + origin[2])

    def is_near(self, other: Transform, tolerance: float) -> bool:
        """Return whether no number (metres, entries of the rotation) differs by more than that."""
        rows = zip(
            (self.translation, *self.rotation), (other.translation, *other.rotation), strict=True
        )
        return all(abs(a - b) <= tolerance for row in rows for a, b in zip(*row, strict=True))

    def __matmul__(self, other: Transform) -> Transform:
        """Chain: the pose of C in A, from that of B in A and that of C in B."""
        (a, b, c), (d, e, f), (g, h, i) = other.rotation
        one, two, three = (
            (x * a + y * d + z * g, x * b + y * e + z * h, x * c + y * f + z * i)
            for x, y, z in self.rotation
        )
        return Transform((one, two, three), self.apply(other.translation))

    @cached_property
    def inverse(self) -> Transform:
        """The pose of A in B."""
        (a, b, c), (d, e, f), (g, h, i) = self.rotation
        transposed: Rotation = ((a, d, g), (b, e, h), (c, f, i))
        x, y, z = Transform(transposed).rotate(self.translation)
        return Transform(transposed, (-x, -y, -z))

    @property
    def rpy(self) -> Vector:
        """Roll, pitch and yaw in radians; roll is 0 where pitch is ±π/2."""
        rows = self.rotation
        cos_pitch = math.hypot(rows[0][0], rows[1][0])
        pitch = math.atan2(-rows[2][0], cos_pitch)
        if cos_pitch < 1e-12:
            return (0.0, pitch, math.atan2(-rows[0][1], rows[1][1]))
        yaw = math.atan2(rows[1][0], rows[0][0])
        sy, cy = math.sin(yaw), math.cos(yaw)
        # With this yaw taken out first, roll makes up for the rounding of yaw near ±π/2 of pitch.
        sin_roll, cos_roll = sy * rows[0][2] - cy * rows[1][2], cy * rows[1][1] - sy * rows[0][1]
        return (math.atan2(sin_roll, cos_roll), pitch, yaw)
