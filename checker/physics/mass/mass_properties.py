"""Mass, centre of mass, inertia and balance of a robot and of its links."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.record import Record
from checker.model.components import Joint, Link
from checker.model.geometry.transform import Vector
from checker.model.robot import Robot
from checker.physics.mass.link_geometry import displacement
from checker.source.text import Span

_HEAVY, _OUTSIDE = 0.02, 0.5
"""Share of the robot's mass, and displacement, from which a centre of mass is not believed."""
_NOISE = 1e-14
"""kg·m²: a grain of sand has more."""
_ROUNDING = 1e-12
"""What an eigenvalue of 0 may be below it by rounding."""


class LinkInertia(Record, eq=False):
    """The inertia of one link.

    Attributes:
        mass: Kilograms.
        centre: Centre of mass in the robot's frame, metres; None if its pose is unknown.
        principal: Principal moments about the centre of mass, ascending, kg·m²; NaN if a number
            is not finite.
        pseudo_eigenvalue: The smallest eigenvalue of the 4×4 pseudo-inertia about the centre of
            mass, divided by the largest in size, in units in which the mass and the largest moment
            are 1: below 0 no distribution of mass has this inertia. NaN if a number is not finite.
        piece_eigenvalue: The same of the rigid piece that fixed joints make of it and other links.
        gyration_radius: sqrt(largest principal moment / mass), metres; 0 without mass.
    """

    link: Link
    mass: float
    centre: Vector | None
    principal: Vector
    pseudo_eigenvalue: float
    piece_eigenvalue: float
    gyration_radius: float

    @property
    def has_moments(self) -> bool:
        """True if it has moments greater than the noise of a CAD program's export."""
        return not max(map(abs, self.principal)) <= _NOISE

    @property
    def states_possible_moments(self) -> bool:
        """True unless the moments are missing (INE001), impossible (INE002) or zero (INE003)."""
        inertial = self.link.inertial
        stated = inertial is not None and any(moment.stated for moment in inertial.moments)
        possible = self.has_moments and self.pseudo_eigenvalue >= -_ROUNDING
        return stated and self.mass > 0.0 and possible

    @property
    def moments_span(self) -> Span:
        """Span of the moments: `<inertia>`, or the element that should contain it."""
        inertial = self.link.element.child("inertial")
        inertia = inertial.child("inertia") if inertial is not None else None
        return (inertia or inertial or self.link.element).span


class MassProperties(Record, eq=False):
    """A robot in the pose that it starts in.

    Attributes:
        robot: The weighed robot.
        mass: Kilograms.
        centre: Centre of mass in the robot's frame, metres; None if nothing is known of it.
        inertia: Rows of the 3×3 inertia about the centre of mass, robot's axes, kg·m²; likewise.
        links: The links by scoped name.
        support: Corners (x, y) of the convex polygon that it stands on, metres, counter-clockwise.
        support_height: z of the ground in the robot's frame, metres: its lowest collision point.
        standing: Scoped names of the links that touch the ground.
        tip_angle: The tilt of the ground at which it tips, radians, negative when it tips at
            once; None without support.
        gravity_torques: N·m or N that each movable joint's first axis holds, by joint; only of
            joints below which nothing stands on the ground.
        support_unknown: The reason why what stands on the ground is not known, as the end of a
            sentence; empty if it is. Then there is neither support nor gravity torque.
    """

    robot: Robot
    mass: float
    centre: Vector | None
    inertia: tuple[Vector, Vector, Vector] | None
    links: Mapping[str, LinkInertia]
    support: tuple[tuple[float, float], ...]
    support_height: float | None
    standing: frozenset[str]
    tip_angle: float | None
    gravity_torques: Mapping[Joint, float]
    support_unknown: str = ""

    @property
    def unbalanced(self) -> str:
        """Reason why the stand of the robot is not known, as the end of a sentence; else empty."""
        robot = self.robot
        unknown = robot.unweighed or robot.unplaced_part or robot.bare_wheel
        return unknown or self.support_unknown or next(self._displaced(), "")

    def _displaced(self) -> Iterator[str]:
        """Yield links whose centre of mass cannot be where it is, as the end of a sentence."""
        for name, inertia in self.links.items():
            link, centre = inertia.link, inertia.centre
            if link.inertial is None or centre is None or not self.share(name) > _HEAVY:
                continue
            if displacement(self.robot, link, centre) > _OUTSIDE:
                yield f"the centre of mass of link {link.name.value!r} is outside it"

    @property
    def weighed(self) -> Mapping[str, LinkInertia]:
        """The links whose mass is known and has an effect: the world does not hold them."""
        left_out = self.robot.tree.links_fixed_to_world.union(self.robot.unknown_masses)
        return {name: inertia for name, inertia in self.links.items() if name not in left_out}

    def share(self, name: str) -> float:
        """Return a link's share of the robot's mass, 0…1."""
        return self.links[name].mass / self.mass if self.mass > 0 else 0.0
