"""The inertia of each link without numpy: stated values, principal moments, rigid pieces."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import chain

from checker.base.record import Record
from checker.model.geometry.transform import Transform, Vector
from checker.model.robot import Robot
from checker.physics.mass.inertia import inertial_pose, rows_of
from checker.physics.mass.mass_properties import LinkInertia

Rows = Sequence[Sequence[float]]

_TURNS = 60
"""Greatest number of rotations of the axes; about ten suffice."""
_PAIRS = ((0, 1, 2), (0, 2, 1), (1, 2, 0))


class LinkInertias(Record, eq=False):
    """The links of a robot by scoped name, each with its inertia."""

    robot: Robot
    links: Mapping[str, LinkInertia]


class _Body(Record):
    """A mass with its centre and the inertia about it, in the robot's axes."""

    mass: float
    centre: Vector
    moments: Rows


def link_inertias(robot: Robot) -> LinkInertias:
    """Return the inertia of each link; those of a rigid piece count together too."""
    piece_of = robot.tree.rigid_bodies.of_link
    written = {
        name: (link, inertial_pose(robot, link), rows_of(link))
        for name, link in robot.tree.links.items()
    }
    pieces: dict[str, _Body] = {}
    for name, (link, pose, rows) in written.items():
        if pose is not None and 0.0 < link.mass < math.inf:
            body = _Body(link.mass, pose.translation, _turned(rows, pose))
            before = pieces.get(piece_of[name])
            pieces[piece_of[name]] = _together(before, body) if before else body
    together = {name: pseudo_eigenvalue(it.mass, it.moments) for name, it in pieces.items()}
    links = {}
    for name, (link, pose, rows) in written.items():
        principal = principal_moments(rows)
        sound = link.mass > 0.0 and principal[2] >= 0.0 and math.isfinite(link.mass)
        links[name] = LinkInertia(
            link,
            link.mass,
            None if pose is None else pose.translation,
            principal,
            pseudo_eigenvalue(link.mass, rows),
            together.get(piece_of[name], 0.0),
            math.sqrt(principal[2] / link.mass) if sound else 0.0,
        )
    return LinkInertias(robot, links)


def principal_moments(rows: Rows) -> Vector:
    """Return the eigenvalues of a symmetric matrix, ascending, by Jacobi's rotations.

    NaN if a number is not finite.
    """
    if not _is_finite(rows):
        return (math.nan, math.nan, math.nan)
    scale = _largest(rows) or 1.0
    a = [[number / scale for number in row] for row in rows]
    for _ in range(_TURNS):
        p, q, r = max(_PAIRS, key=lambda pair: abs(a[pair[0]][pair[1]]))
        if abs(a[p][q]) < 1e-300:
            break
        theta = (a[q][q] - a[p][p]) / (2.0 * a[p][q])
        tangent = math.copysign(1.0, theta) / (abs(theta) + math.hypot(theta, 1.0))
        cosine = 1.0 / math.hypot(tangent, 1.0)
        sine = tangent * cosine
        a[p][p] -= tangent * a[p][q]
        a[q][q] += tangent * a[p][q]
        a[p][q] = a[q][p] = 0.0
        of_p, of_q = a[r][p], a[r][q]
        a[r][p] = a[p][r] = cosine * of_p - sine * of_q
        a[r][q] = a[q][r] = sine * of_p + cosine * of_q
    first, second, third = sorted(a[n][n] * scale for n in range(3))
    return (first, second, third)


def pseudo_eigenvalue(mass: float, rows: Rows) -> float:
    """Return the smallest eigenvalue of the pseudo-inertia; see `LinkInertia`.

    About the centre of mass its eigenvalues are the mass and, for each principal moment, half the
    sum of all three less this one.
    """
    if not (_is_finite(rows) and math.isfinite(mass)):
        return math.nan
    scale = _largest(rows) or 1.0
    moments = principal_moments([[number / scale for number in row] for row in rows])
    half = sum(moments) / 2.0
    sign = math.copysign(1.0, mass) if mass else 0.0
    eigenvalues = (sign, *(half - moment for moment in moments))
    largest = max(map(abs, eigenvalues))
    return min(eigenvalues) / largest if largest else 0.0


def _turned(rows: Rows, pose: Transform) -> Rows:
    """Return moments in the robot's axes; none if one is not finite."""
    if not _is_finite(rows):
        return ((0.0, 0.0, 0.0),) * 3
    turn = pose.rotation
    return [
        [
            math.fsum(turn[i][k] * rows[k][m] * turn[j][m] for k in range(3) for m in range(3))
            for j in range(3)
        ]
        for i in range(3)
    ]


def _together(one: _Body, other: _Body) -> _Body:
    """Return two bodies as one, by the parallel axis theorem."""
    mass = one.mass + other.mass
    share = other.mass / mass
    apart = [b - a for a, b in zip(one.centre, other.centre, strict=True)]
    x, y, z = (a + share * d for a, d in zip(one.centre, apart, strict=True))
    reduced, square = one.mass * share, math.fsum(d * d for d in apart)
    moments = [
        [
            one.moments[i][j]
            + other.moments[i][j]
            + reduced * ((square if i == j else 0.0) - apart[i] * apart[j])
            for j in range(3)
        ]
        for i in range(3)
    ]
    return _Body(mass, (x, y, z), moments)


def _is_finite(rows: Rows) -> bool:
    return all(map(math.isfinite, chain.from_iterable(rows)))


def _largest(rows: Rows) -> float:
    return max(map(abs, chain.from_iterable(rows)))
