"""Puts a robot on the scales."""

from __future__ import annotations

import math

from checker.cache import NO_CACHE, Cache
from checker.dynamics.balance import stand_of, tip_angle
from checker.dynamics.gravity import gravity_torques
from checker.dynamics.hanging import hang
from checker.dynamics.inertia import inertial_pose, rows_of
from checker.dynamics.mass_properties import LinkInertia, MassProperties
from checker.dynamics.scales import Body, Weight, weights_of
from checker.model.components import Link
from checker.model.robot import Robot


def weigh(robot: Robot, cache: Cache = NO_CACHE) -> MassProperties:
    """Return mass, inertia and balance of a robot in the pose that it starts in.

    Time and memory are linear in the links.

    Args:
        robot: What is weighed.
        cache: Where weights are kept.
    """
    bodies = [
        Body(link.mass, rows_of(link), inertial_pose(robot, link))
        for link in robot.tree.links.values()
    ]
    weights = weights_of(bodies, cache)
    links = {
        name: _link_inertia(link, body, weight)
        for (name, link), body, weight in zip(
            robot.tree.links.items(), bodies, weights.each, strict=True
        )
    }
    stand = stand_of(robot)
    torques = {}
    if not stand.unknown:
        torques = gravity_torques(robot, hang(robot), links, stand.links)
    return MassProperties(
        robot=robot,
        mass=robot.mass,
        centre=weights.centre,
        inertia=weights.inertia,
        links=links,
        support=stand.polygon,
        support_height=stand.height,
        standing=stand.links,
        tip_angle=tip_angle(stand, weights.centre),
        gravity_torques=torques,
        support_unknown=stand.unknown,
    )


def _link_inertia(link: Link, body: Body, weight: Weight) -> LinkInertia:
    """Return the inertia of a link; figures out of numbers that are not finite are NaN."""
    largest = weight.principal[2]
    sound = body.mass > 0.0 and largest >= 0.0 and math.isfinite(body.mass)
    return LinkInertia(
        link,
        body.mass,
        None if body.pose is None else body.pose.translation,
        weight.principal,
        weight.pseudo_eigenvalue,
        math.sqrt(largest / body.mass) if sound else 0.0,
    )
