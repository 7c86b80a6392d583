"""The mass and inertia of several links as those of one."""

from __future__ import annotations

from collections.abc import Sequence

from checker.convert.bodies import PartOfBody
from checker.model.transform import Transform, Vector
from checker.record import record

_PLACES = ((0, 0), (0, 1), (0, 2), (1, 1), (1, 2), (2, 2))


@record()
class JoinedInertial:
    """What a body weighs.

    Attributes:
        mass: Kilograms.
        centre: Centre of mass in the body's frame, metres.
        moments: ixx, ixy, ixz, iyy, iyz, izz about it along the body's axes, kg·m².
    """

    mass: float
    centre: Vector
    moments: tuple[float, ...]


def joined_inertial(parts: Sequence[PartOfBody]) -> JoinedInertial:
    """Join the inertias of links about their common centre of mass.

    Each is turned into the body's axes and moved by the parallel axis theorem,
    I + m (|d|² E − d dᵀ) with d from the common centre of mass to its own.
    """
    import numpy as np

    stated = [
        (part.pose @ part.link.inertial.pose.transform, part.link.inertial)
        for part in parts
        if part.link.inertial is not None
    ]
    mass = sum(inertial.mass.value for _, inertial in stated)
    centre = np.zeros(3)
    for pose, inertial in stated:
        share = inertial.mass.value / mass if mass else 1.0 / len(stated)
        centre += share * np.array(pose.translation)
    moments = np.zeros((3, 3))
    for pose, inertial in stated:
        xx, xy, xz, yy, yz, zz = (moment.value for moment in inertial.moments)
        own = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        turn, arm = np.array(pose.rotation), np.array(pose.translation) - centre
        moved = float(arm @ arm) * np.eye(3) - np.outer(arm, arm)
        moments += turn @ own @ turn.T + inertial.mass.value * moved
    x, y, z = centre.tolist()
    six = tuple(float(moments[row, column]) for row, column in _PLACES)
    return JoinedInertial(mass, (x, y, z), six)


def alone(parts: Sequence[PartOfBody]) -> PartOfBody | None:
    """Return the one part that states an inertial; None when there are several or none."""
    stated = [part for part in parts if part.link.inertial is not None]
    return stated[0] if len(stated) == 1 else None


def frame_of(part: PartOfBody) -> Transform:
    """Return the centre of mass and axes of a part in its body's frame."""
    inertial = part.link.inertial
    return part.pose if inertial is None else part.pose @ inertial.pose.transform
