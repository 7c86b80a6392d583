"""A moment of inertia that is far too small for the size of the link.

The largest moment of a body is least if all of its mass is near one point. Real links are not so:
with much less than the moments of its shapes, a link spins up much faster than the real one, its
joints oscillate, and its contacts become unstable. Usually the moments are a placeholder, those of
a smaller part, or stayed as they were when the mass was changed.

Boxes, cylinders and balls are compared more strictly than meshes: a mesh often includes thin parts
far outside, which weigh little, and counts as its convex hull where it is not closed. If the three
moments are equal, no one has computed them, and they are compared like those of a box. A light link
is often a placeholder and skipped, unless its moments are those of its shapes at another mass. A
part that is fixed to a heavier one moves with it, and is left out; one to which others are fixed
counts with these. For an object without joints, sensors and plugins, such as a barrel, it is an
info.

Fix: write the moments of the link's shapes at its mass, such as m/12·(b² + c²) of a box; or, where
the message names it, the mass to which the moments belong.
Source: the moments of solids; the moments of published robots.
"""

import math

from checker.model.robot import Robot
from checker.physics.mass.even_inertia import even_moments, moments_fix
from checker.physics.mass.link_geometry import volume_bounds
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule

_SAME = 0.02
"""Difference of moments that are those of the same shape, written with two or three digits."""
_DIAGONAL = (0, 3, 5)
"""Where ixx, iyy and izz are among the moments."""


@rule("INE018", "inertia-too-small", Severity.WARNING, Concern.ROBOT)
def check(
    masses: MassProperties,
    *,
    least: float = 0.125,
    least_of_mesh: float = 0.03,
    share: float = 0.02,
    heaviest: float = 8000.0,
) -> Findings:
    """Compare the largest moment of moving links with that of their shapes at their mass.

    Options:
        least: Share of the largest moment that the link's mass has if it is spread evenly over its
            collisions, else over its visuals; less is a warning.
        least_of_mesh: The same for links with meshes whose moments are not all equal.
        share: Share of the robot's mass; a link with no more is skipped, unless its moments are
            those of its shapes at another mass.
        heaviest: Density in kg/m³; of a link with a greater one the mass is wrong (INE006, which
            skips light links).
    """
    robot = masses.robot
    if robot.is_static:
        return
    for name, inertia in masses.weighed.items():
        if not inertia.states_possible_moments or not _moves_by_itself(masses, name):
            continue
        of_mass = _mass_of_moments(robot, inertia)
        is_light, too_dense = masses.share(name) <= share, _density(robot, inertia) > heaviest
        if not of_mass if is_light else too_dense:
            continue
        even, largest = _largest_even_moment(robot, inertia), _largest_of_body(masses, name)
        is_drawn = _has_mesh(inertia) and not _has_equal_moments(inertia)
        if largest < (least_of_mesh if is_drawn else least) * even:
            other = f", those of {of_mass:.2g} kg" if is_light else ""
            yield finding(
                inertia.moments_span,
                f"link {inertia.link.name.value!r} of {inertia.mass:.4g} kg has moments of inertia "
                f"of up to {inertia.principal[2]:.3g} kg·m²{other}, but its shapes have up to "
                f"{even:.3g} kg·m² at this mass: it spins up {even / largest:.0f} times as fast",
                severity=Severity.INFO if robot.is_prop else None,
                fix=None if too_dense else moments_fix(robot, inertia.link),
                covered_by=("INE004", "INE007", "INE013"),
            )


def _moves_by_itself(masses: MassProperties, name: str) -> bool:
    """Return whether no joint fixes a link to a heavier one."""
    bodies = masses.robot.tree.rigid_bodies
    fixed = bodies.links[bodies.of_link[name]]
    return masses.links[name].mass >= max(masses.links[other].mass for other in fixed)


def _largest_of_body(masses: MassProperties, name: str) -> float:
    """Return what a link's largest moment is at most with all that is fixed to it, kg·m²."""
    bodies = masses.robot.tree.rigid_bodies
    parts = [masses.links[other] for other in bodies.links[bodies.of_link[name]]]
    if len(parts) == 1:
        return parts[0].principal[2]
    total, largest = sum(part.mass for part in parts), 0.0
    placed = [(part, part.centre) for part in parts if part.centre is not None]
    middle = [sum(part.mass * at[axis] for part, at in placed) / total for axis in range(3)]
    for part, at in placed:
        largest += part.principal[2] + part.mass * math.dist(at, middle) ** 2
    return largest if len(placed) == len(parts) else math.inf


def _mass_of_moments(robot: Robot, inertia: LinkInertia) -> float:
    """Return the mass at which the moments are those of the link's shapes, kg; 0 if at none.

    They were computed, then, and are no placeholder, which has three equal ones.
    """
    even, inertial = even_moments(robot, inertia.link), inertia.link.inertial
    if even is None or inertial is None or _has_equal_moments(inertia):
        return 0.0
    stated = [inertial.moments[number].value for number in _DIAGONAL]
    of_shapes = [even[number] for number in _DIAGONAL]
    factor = sum(stated) / sum(of_shapes) if sum(of_shapes) > 0.0 else 0.0
    pairs = zip(stated, of_shapes, strict=True)
    fits = factor > 0.0 and all(math.isclose(a, b * factor, rel_tol=_SAME) for a, b in pairs)
    return factor * inertia.mass if fits else 0.0


def _largest_even_moment(robot: Robot, inertia: LinkInertia) -> float:
    """Return the largest moment about an axis of `<inertial>`, kg·m²; 0 if it is not known."""
    even = even_moments(robot, inertia.link)
    return max(even[number] for number in _DIAGONAL) if even is not None else 0.0


def _density(robot: Robot, inertia: LinkInertia) -> float:
    """Return the least density of a link, kg/m³; 0 if its volume is not known."""
    link = inertia.link
    bounds = volume_bounds(robot, link.collisions or link.visuals)
    return inertia.mass / bounds[1] if bounds is not None and bounds[1] > 0.0 else 0.0


def _has_mesh(inertia: LinkInertia) -> bool:
    shapes = inertia.link.collisions or inertia.link.visuals
    return any(shape.geometry.shape == "mesh" for shape in shapes)


def _has_equal_moments(inertia: LinkInertia) -> bool:
    least, *_, most = inertia.principal
    return math.isclose(least, most, rel_tol=1e-6)


def _robot(
    moments: tuple[float, float, float], mass: float = 8.0, mark: str = "", base: float = 20.0
) -> str:
    ixx, iyy, izz = moments
    return f"""
<link name="base_link">
  <inertial>
    <mass>{base}</mass>
    <inertia><ixx>{base / 40}</ixx><iyy>{base / 30}</iyy><izz>{base / 20}</izz></inertia>
  </inertial>
</link>
<link name="boom">
  <inertial>
    <mass>{mass}</mass>
    <inertia>{mark}
      <ixx>{ixx}</ixx><iyy>{iyy}</iyy><izz>{izz}</izz>
    </inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.8 0.1 0.1</size></box></geometry></collision>
</link>
"""


def _pair(distance: float) -> str:
    """Return a boom to which an equal one is fixed."""
    boom = _robot((1e-3, 1e-3, 1e-3))
    tip = boom.partition("</link>")[2].replace(
        '<link name="boom">', f'<link name="tip"><pose>{distance} 0 0 0 0 0</pose>'
    )
    joint = '<joint name="hold" type="fixed"><parent>boom</parent><child>tip</child></joint>'
    return f"{boom}{tip}{joint}"


_LIGHT = (1.33e-5, 4.33e-4, 4.33e-4)
"""The moments of the boom at a mass of 8 g."""
_MARK = "  <!-- ^ INE018 -->"
GOOD = [
    _pair(1.0),
    _robot(_LIGHT, mass=0.008),
    _robot((0.0133, 0.4333, 0.4333)),
    _robot((0.005, 0.1, 0.1)),
    _robot((1e-4, 1e-3, 1e-3), mass=0.1),
]
BAD = [
    _robot((0.01, 0.01, 0.01), mark=_MARK),
    _robot((0.004, 0.04, 0.04), mark=_MARK),
    _robot(_LIGHT, mass=0.1, mark=_MARK),
    _robot(_LIGHT, mass=100.0, base=9000.0, mark=_MARK),
]
