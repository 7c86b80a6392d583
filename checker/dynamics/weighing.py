"""Puts a robot on the scales."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING

from checker.dynamics.balance import stand_of, tip_angle
from checker.dynamics.gravity import gravity_torques
from checker.dynamics.hanging import hang
from checker.dynamics.inertia import inertial_pose, spatial_inertia, weigh_link
from checker.dynamics.mass_properties import LinkInertia, MassProperties
from checker.model.robot import Robot
from checker.model.transform import Vector

if TYPE_CHECKING:
    import pinocchio as pin


def weigh(robot: Robot) -> MassProperties:
    """Return mass, inertia and balance of a robot in the pose that it starts in.

    Time and memory are linear in the links.
    """
    links = {name: weigh_link(robot, link) for name, link in robot.tree.links.items()}
    centre, inertia = _composite(robot, links.values())
    stand = stand_of(robot)
    torques = {}
    if not stand.unknown:
        torques = gravity_torques(robot, hang(robot), links, stand.links)
    return MassProperties(
        robot=robot,
        mass=robot.mass,
        centre=centre,
        inertia=inertia,
        links=links,
        support=stand.polygon,
        support_height=stand.height,
        standing=stand.links,
        tip_angle=tip_angle(stand, centre),
        gravity_torques=torques,
        support_unknown=stand.unknown,
    )


def _composite(
    robot: Robot, links: Iterable[LinkInertia]
) -> tuple[Vector | None, tuple[Vector, Vector, Vector] | None]:
    """Return centre of mass and inertia of all links that weigh something, as one rigid body."""
    import pinocchio as pin

    total = pin.Inertia.Zero()
    doubtful = False
    for each in links:
        pose = inertial_pose(robot, each.link)
        if pose is not None and 0.0 < each.mass < math.inf:
            total += spatial_inertia(each.link, pose)
            doubtful |= math.isnan(each.principal[0])
    return _centre(total), None if doubtful else _rows(total)


def _centre(total: pin.Inertia) -> Vector | None:
    x, y, z = (float(number) for number in total.lever)
    known = total.mass > 0.0 and all(map(math.isfinite, (x, y, z)))
    return (x, y, z) if known else None


def _rows(total: pin.Inertia) -> tuple[Vector, Vector, Vector] | None:
    rows = [(float(x), float(y), float(z)) for x, y, z in total.inertia]
    known = total.mass > 0.0 and all(math.isfinite(number) for row in rows for number in row)
    return (rows[0], rows[1], rows[2]) if known else None
