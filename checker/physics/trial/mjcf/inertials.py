"""Masses and inertias as MuJoCo takes them, and the least change where it would not."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Link, Pose
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.physics.trial.mjcf.names import (
    LARGEST,
    is_finite_pose,
    numbers,
    quaternion,
    usable,
)
from checker.physics.trial.mjcf.repairs import Ledger

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

Rows = tuple[Vector, Vector, Vector]
"""The rows of a symmetric 3×3 matrix."""

LEAST_MASS = 1e-3
"""Kilograms taken for a moving link that has none."""
LEAST_MOMENT = 1e-7
"""kg·m² taken for a principal moment of zero: the inertia of a 1 g marble 8 mm across."""
_NOTHING = 1e-14
"""kg or kg·m² that MuJoCo takes for zero in a body that moves (mjMINVAL is 1e-15)."""
_ROUNDING = 1e-9
"""Share of the moments by which rounding may break the triangle inequality of a flat body."""
_FLAT = 1e-11
"""Share of the moments that a flat body is given as thickness, so that rounding cannot harm."""
_CLEARLY = 1e-6
"""Share of the trace by which a moment is above zero beyond doubt."""


class BodyInertia(Record, eq=False):
    """Mass, centre of mass and inertia of a body.

    Attributes:
        mass: Kilograms.
        centre: Centre of mass in the link's frame, metres.
        moments: Rows of the inertia about the centre of mass along the link's axes, kg·m².
    """

    mass: float
    centre: Vector
    moments: Rows

    @property
    def sound(self) -> bool:
        """True if MuJoCo allows a moving body with this inertia: mass and moments are not zero."""
        if _is_clearly_positive(self.moments):
            return self.mass > _NOTHING
        import numpy as np

        least, _, largest = np.linalg.eigvalsh(self.moments).tolist()
        return self.mass > _NOTHING and least > max(_NOTHING, _FLAT * largest)

    @property
    def mjcf(self) -> str:
        """The element `<inertial>`; nothing for a body of no mass and inertia."""
        if self.mass == 0.0 and not any(map(any, self.moments)):
            return ""
        head = f'<inertial mass="{numbers([self.mass])}"'
        if self.sound:
            (xx, xy, xz), (_, yy, yz), (_, _, zz) = self.moments
            six = numbers((xx, yy, zz, xy, xz, yz))
            return f'{head} pos="{numbers(self.centre)}" fullinertia="{six}"/>'
        return f"{head} {self._principal()}/>"

    def _principal(self) -> str:
        """Return the attributes of a body of a zero moment: MuJoCo takes it along its own axes."""
        import numpy as np

        values, axes = np.linalg.eigh(self.moments)
        if np.linalg.det(axes) < 0:
            axes[:, 0] = -axes[:, 0]
        (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = axes.tolist()
        turn = quaternion(((xx, xy, xz), (yx, yy, yz), (zx, zy, zz)))
        # As sums of second moments, which rounding cannot bring to break the triangle inequality.
        a, b, c = np.maximum(values.sum() / 2 - values, 0.0).tolist()
        three = numbers((b + c, a + c, a + b))
        return f'pos="{numbers(self.centre)}" quat="{numbers(turn)}" diaginertia="{three}"'


def inertia_of(robot: Robot, link: Link, ledger: Ledger) -> BodyInertia:
    """Return what a link weighs; the nearest that a body can have where it states another."""
    name = link.scoped_name
    mass = _mass_of(link, ledger)
    if link.inertial is None:
        return BodyInertia(mass, (0.0, 0.0, 0.0), _ball(1.0 if link.default_mass else 0.0))
    pose = _pose_of(robot, link, link.inertial.pose)
    if pose is None:
        ledger.repair(name, "has an unknown centre of mass; the link's origin is used")
        pose = Transform()
    stated = [moment.value for moment in link.inertial.moments]
    if not all(usable(moment) for moment in stated):
        ledger.repair(
            name, (
                f"has a moment of inertia that is not a usable number; {LEAST_MOMENT:g} kg·m² is "
                "used"
            ),
            serious=True,
        )  # fmt: skip
        return BodyInertia(mass, pose.translation, _ball(LEAST_MOMENT))
    xx, xy, xz, yy, yz, zz = stated
    own = _physical(((xx, xy, xz), (xy, yy, yz), (xz, yz, zz)), name, ledger)
    return BodyInertia(mass, pose.translation, _turned(own, pose.rotation))


def _ball(moment: float) -> Rows:
    return (moment, 0.0, 0.0), (0.0, moment, 0.0), (0.0, 0.0, moment)


def _turned(moments: Rows, turn: Rows) -> Rows:
    """Return R M Rᵀ, of which rounding leaves each half as it is."""
    half = [[sum(a * m for a, m in zip(row, column, strict=True)) for column in moments]
            for row in turn]  # fmt: skip
    full = [[sum(a * b for a, b in zip(row, other, strict=True)) for other in turn] for row in half]
    xy, xz, yz = ((full[i][j] + full[j][i]) / 2 for i, j in ((0, 1), (0, 2), (1, 2)))
    return (full[0][0], xy, xz), (xy, full[1][1], yz), (xz, yz, full[2][2])


def _is_clearly_positive(moments: Rows) -> bool:
    """State of most bodies that no principal moment is near zero, without solving for them.

    By Sylvester's criterion for M − s I, where s is a small share of the trace.
    """
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = moments
    trace = xx + yy + zz
    least = _CLEARLY * trace
    if not trace > _CLEARLY:
        return False
    xx, yy, zz = xx - least, yy - least, zz - least
    second = xx * yy - xy * xy
    third = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    return xx > 0.0 and second > 0.0 and third > 0.0


def _second_moments(moments: Rows) -> Rows:
    """Return trace/2 − I: how far the mass is from the centre along each axis, squared."""
    (xx, xy, xz), (_, yy, yz), (_, _, zz) = moments
    half = (xx + yy + zz) / 2
    return (half - xx, -xy, -xz), (-xy, half - yy, -yz), (-xz, -yz, half - zz)


def _as_rows(matrix: NDArray[np.float64]) -> Rows:
    (a, b, c), (d, e, f), (g, h, i) = matrix.tolist()
    return (a, b, c), (d, e, f), (g, h, i)


def _mass_of(link: Link, ledger: Ledger) -> float:
    mass = link.mass
    if mass >= 0.0 and usable(mass):
        return mass
    what = "a negative mass" if mass < 0.0 else "a mass that is not a usable number"
    taken = LARGEST if LARGEST < mass < math.inf else LEAST_MASS
    ledger.repair(link.scoped_name, f"has {what}; {taken:g} kg is used", serious=True)
    return taken


def _pose_of(robot: Robot, link: Link, stated: Pose) -> Transform | None:
    """Return where the centre of mass and its axes are in the link's frame."""
    pose = robot.pose_in_link(link, stated)
    return pose if pose is not None and is_finite_pose(pose) else None


def _physical(moments: Rows, name: str, ledger: Ledger) -> Rows:
    """Return the nearest inertia that a body can have.

    The second moments of mass along the principal axes, trace/2 − I, must not be negative: that
    states positive moments and the triangle inequality at once.
    """
    if _is_clearly_positive(_second_moments(moments)):
        return moments
    import numpy as np

    values, axes = np.linalg.eigh(moments)
    second = values.sum() / 2 - values
    scale = float(np.abs(values).max())
    least = float(second.min())
    if least >= _FLAT * scale:
        return moments
    floor = _FLAT * scale
    if least < -_ROUNDING * scale:
        floor = max(floor, LEAST_MOMENT / 2)
        raised = np.maximum(second, floor)
        listed, nearest = (
            ", ".join(f"{value:.4g}" for value in each) for each in (values, raised.sum() - raised)
        )
        ledger.repair(
            name, (
                f"has principal moments that no body can have ({listed} kg·m²); the nearest "
                f"possible ones are used ({nearest} kg·m²)"
            ), serious=True,
        )  # fmt: skip
    elif values[0] <= max(_NOTHING, _ROUNDING * scale):
        # A rod or a point: whether its zero matters, and is repaired, depends on its neighbours.
        return moments
    second = np.maximum(second, floor)
    physical = second.sum() - second
    return _as_rows((axes * physical) @ axes.T)


def thickened(body: BodyInertia, name: str, ledger: Ledger) -> BodyInertia:
    """Return the inertia of a moving body, its zero mass and moments replaced."""
    import numpy as np

    mass = body.mass
    if mass <= _NOTHING:
        mass = LEAST_MASS
        ledger.repair(name, f"has no mass; {mass:g} kg is used", serious=True)
    values, axes = np.linalg.eigh(body.moments)
    if values[0] > max(_NOTHING, _FLAT * values[2]):
        return BodyInertia(mass, body.centre, body.moments)
    least = max(LEAST_MOMENT, _ROUNDING * float(values[2]))
    ledger.repair(name, f"has a zero principal moment; {least:g} kg·m² is used", serious=True)
    moments = (axes * np.maximum(values, least)) @ axes.T
    return BodyInertia(mass, body.centre, _physical(_as_rows(moments), name, Ledger()))
