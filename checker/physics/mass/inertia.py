"""The inertia of a link, by Pinocchio; numbers that make no sense are shown, never repaired."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from checker.model.components import Link
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot

if TYPE_CHECKING:
    import numpy as np
    import pinocchio as pin
    from numpy.typing import NDArray

    Matrix = NDArray[np.float64]

_UNKNOWN: Vector = (math.nan, math.nan, math.nan)


def inertial_pose(robot: Robot, link: Link) -> Transform | None:
    """Return the centre of mass and its axes in the robot's frame; None if unknown."""
    if link.inertial is None:
        return robot.pose_of(link.scoped_name)
    return robot.pose_of_part(link, link.inertial.pose)


def rows_of(link: Link) -> tuple[Vector, Vector, Vector]:
    """Return the rows of the 3×3 inertia about the centre of mass as written, kg·m².

    A link without inertial has what simulators take: in SDF 1 kg·m² about each axis, in URDF none.
    """
    if link.inertial is None:
        own = 1.0 if link.default_mass else 0.0
        return (own, 0.0, 0.0), (0.0, own, 0.0), (0.0, 0.0, own)
    xx, xy, xz, yy, yz, zz = (moment.value for moment in link.inertial.moments)
    return (xx, xy, xz), (xy, yy, yz), (xz, yz, zz)


def moments_of(link: Link) -> Matrix:
    """Return `rows_of` a link as a matrix."""
    import numpy as np

    return np.array(rows_of(link))


def spatial_inertia(link: Link, pose: Transform) -> pin.Inertia:
    """Return the inertia of a link in the frame of `pose`.

    Args:
        link: The link; moments that are not finite count as none.
        pose: Its centre of mass and axes.
    """
    return placed_inertia(link.mass, moments_of(link), pose)


def placed_inertia(mass: float, moments: Matrix, pose: Transform) -> pin.Inertia:
    """Return an inertia in the frame of `pose`.

    Args:
        mass: Kilograms.
        moments: About the centre of mass (3 × 3), kg·m²; none if one is not finite.
        pose: The centre of mass and its axes.
    """
    return se3(pose).act(_inertia(mass, moments))


def _inertia(mass: float, moments: Matrix) -> pin.Inertia:
    """Return an inertia about its own centre of mass, possible or not."""
    import numpy as np
    import pinocchio as pin

    # The constructor refuses negative moments, which are ours to report.
    inertia = pin.Inertia.Zero()
    inertia.mass = mass
    if np.isfinite(moments).all():
        inertia.inertia = moments
    return inertia


def se3(pose: Transform) -> pin.SE3:
    """Return a pose as Pinocchio has it."""
    import numpy as np
    import pinocchio as pin

    return pin.SE3(np.array(pose.rotation), np.array(pose.translation))


def principal_moments(moments: Matrix) -> Vector:
    """Return the principal moments, ascending; NaN if they cannot be had."""
    import numpy as np

    if not np.isfinite(moments).all():
        return _UNKNOWN
    # Scaled, for the solver squares what it is given.
    scale = float(np.abs(moments).max()) or 1.0
    first, second, third = (float(value) * scale for value in np.linalg.eigvalsh(moments / scale))
    return (first, second, third)


def pseudo_eigenvalue(mass: float, moments: Matrix) -> float:
    """Return the smallest eigenvalue of the pseudo-inertia; see `LinkInertia`.

    It states at once whether the mass and the moments are positive and whether the moments keep the
    triangle inequality (Wensing, Kim and Slotine, "Linear matrix inequalities for physically
    consistent inertial parameter identification", 2018).
    """
    import numpy as np

    if not (np.isfinite(moments).all() and math.isfinite(mass)):
        return math.nan
    scale = float(np.abs(moments).max()) or 1.0
    sign = math.copysign(1.0, mass) if mass else 0.0
    scaled = _inertia(sign, moments / scale)
    eigenvalues = np.linalg.eigvalsh(scaled.toPseudoInertia().toMatrix())
    largest = float(np.abs(eigenvalues).max())
    return float(eigenvalues[0]) / largest if largest else 0.0
