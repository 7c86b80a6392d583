"""Collision and visual of a link are in different places, or of different size.

The robot does not touch what it seems to touch: a wheel rolls beside its visual, a robot stops in
front of nothing or drives into walls. Usually one of the two has a wrong pose, scale or unit. None
of the accepted packages that we checked shows this.

Fix: give collision and visual the same pose and about the same size.
Source: geometry: boxes along the robot's axes around all collisions and all visuals of a link.
"""

import math

from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.placed_shapes import placed, union
from checker.model.locomotion.wheels import stands_askew
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("GEO007", "collision-beside-visual", Severity.WARNING, Concern.ROBOT)
def check(
    robot: Robot,
    *,
    wheel_share: float = 0.25,
    other_share: float = 0.5,
    mass_share: float = 0.02,
) -> Findings:
    """Report links whose collisions and visuals fill boxes of different centres or sizes.

    Tilted wheels (GEO003), rotors and links with an unknown mesh are skipped.

    Options:
        wheel_share: Share of the larger box's diagonal by which centres or sizes may differ for a
            wheel; more is reported.
        other_share: Share of the larger box's diagonal by which centres or sizes may differ for any
            other link; more is reported.
        mass_share: Share of the robot's mass; links that weigh no more are skipped, except wheels.
    """
    wheels = {link.scoped_name for link in robot.wheels}
    exempt = {rotor.link.scoped_name for rotor in robot.locomotion.rotors if rotor.link}
    rolling = (*robot.locomotion.wheels, *robot.locomotion.undriven)
    exempt |= {w.link.scoped_name for w in rolling if stands_askew(robot, w)}
    least_mass = mass_share * robot.mass if not robot.unweighed else math.inf
    for link in robot.links:
        name = link.scoped_name
        if name in exempt or (name not in wheels and not link.mass > least_mass):
            continue
        touched, seen = _box(robot, link, link.collisions), _box(robot, link, link.visuals)
        if touched is None or seen is None:
            continue
        diagonal = max(touched.diagonal, seen.diagonal)
        beside = math.dist(touched.centre, seen.centre)
        larger = math.dist(_size(touched), _size(seen))
        if max(beside, larger) > (wheel_share if name in wheels else other_share) * diagonal:
            yield finding(link, _message(link, touched, seen))


def _message(link: Link, touched: Box, seen: Box) -> str:
    name = link.name.value
    beside = math.dist(touched.centre, seen.centre)
    if beside > math.dist(_size(touched), _size(seen)):
        return f"the centres of collision and visual of {name!r} are {beside:.3g} m apart"
    sizes = f"{_text(touched)}, but its visual measures {_text(seen)}"
    return f"the collision of {name!r} measures {sizes}"


def _text(box: Box) -> str:
    return " × ".join(f"{length:.3g}" for length in _size(box)) + " m"


def _size(box: Box) -> list[float]:
    return [high - low for low, high in zip(box.low, box.high, strict=True)]


def _box(
    robot: Robot, link: Link, shapes: tuple[Collision, ...] | tuple[Visual, ...]
) -> Box | None:
    """Return the box around all shapes; None when one of them is not known."""
    with_shape = [shape for shape in shapes if shape.geometry.shape]
    known = list(placed(robot, link, with_shape))
    return union(piece.box for piece in known) if len(known) == len(with_shape) else None


def _body(pose: str, size: str, mark: str = "", name: str = "body") -> str:
    return f"""
<link name="{name}">{mark}
  <collision name="c"><geometry><box><size>1 0.5 0.2</size></box></geometry></collision>
  <visual name="v">
    <pose>{pose} 0 0 0</pose>
    <geometry><box><size>{size}</size></box></geometry>
  </visual>
</link>
"""


_MARK = "  <!-- ^ GEO007 -->"
GOOD = [
    _body("0 0 0.1", "1 0.5 0.2"),
    _body("0 0 0", "1.2 0.5 0.5"),
    "<link name='ghost'><visual name='v'><geometry><box/></geometry></visual></link>",
]
BAD = [
    _body("0 0 0.8", "1 0.5 0.2", _MARK),
    _body("0 0 0", "0.1 0.05 0.02", _MARK),
    _body("0 0 0", "1 0.5 0.6", _MARK, "front_wheel"),
]
