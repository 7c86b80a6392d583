"""A moment of inertia that is far too small for the size of the link.

The largest moment of a body is least if all of its mass is near one point. Real links are not so:
with much less than the moments of its shapes, a link spins up much faster than the real one, its
joints oscillate, and its contacts become unstable. Usually the moments are a placeholder, those of
a smaller part, or stayed as they were when the mass was changed.

Boxes, cylinders and balls are compared more strictly than meshes: a mesh often includes thin parts
far outside, which weigh little, and counts as its convex hull where it is not closed. If the three
moments are equal, no one has computed them, and they are compared like those of a box. A part that
is fixed to a heavier one moves with it, and is left out; for an object without joints, sensors and
plugins, such as a barrel, it is an info.

Fix: write the moments of the link's shapes at its mass, such as m/12·(b² + c²) of a box.
Source: the moments of solids; the moments of published robots.
"""

import math

from checker.model.robot import Robot
from checker.physics.mass.even_inertia import even_moments, moments_fix
from checker.physics.mass.link_geometry import volume_bounds
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule

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
        share: Share of the robot's mass; a link with no more is often a placeholder and skipped.
        heaviest: Density in kg/m³; of a link with a greater one the mass is wrong (INE006).
    """
    robot = masses.robot
    if robot.is_static:
        return
    for name, inertia in masses.weighed.items():
        if masses.share(name) <= share or not inertia.states_possible_moments:
            continue
        if not _moves_by_itself(masses, name) or _density(robot, inertia) > heaviest:
            continue
        even, largest = _largest_even_moment(robot, inertia), inertia.principal[2]
        is_drawn = _has_mesh(inertia) and not _has_equal_moments(inertia)
        if largest < (least_of_mesh if is_drawn else least) * even:
            yield finding(
                inertia.moments_span,
                f"link {inertia.link.name.value!r} of {inertia.mass:.4g} kg has moments of inertia "
                f"of up to {largest:.3g} kg·m², but its shapes have up to {even:.3g} kg·m² at this "
                f"mass: it spins up {even / largest:.0f} times as fast",
                severity=Severity.INFO if robot.is_prop else None,
                fix=moments_fix(robot, inertia.link),
                covered_by=("INE004", "INE007", "INE013"),
            )


def _moves_by_itself(masses: MassProperties, name: str) -> bool:
    """Return whether no joint fixes a link to a heavier one."""
    bodies = masses.robot.tree.rigid_bodies
    fixed = bodies.links[bodies.of_link[name]]
    return masses.links[name].mass >= max(masses.links[other].mass for other in fixed)


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


def _robot(moments: tuple[float, float, float], mass: float = 8.0, mark: str = "") -> str:
    ixx, iyy, izz = moments
    return f"""
<link name="base_link">
  <inertial>
    <mass>20</mass>
    <inertia><ixx>0.5</ixx><iyy>0.8</iyy><izz>1.1</izz></inertia>
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


_MARK = "  <!-- ^ INE018 -->"
GOOD = [
    _robot((0.0133, 0.4333, 0.4333)),
    _robot((0.005, 0.1, 0.1)),
    _robot((1e-4, 1e-3, 1e-3), mass=0.1),
]
BAD = [_robot((0.01, 0.01, 0.01), mark=_MARK), _robot((0.004, 0.04, 0.04), mark=_MARK)]
