"""A mass that does not fit the size of the link: lighter than foam, or heavier than lead.

Usually a unit is wrong (grams, millimetres, pounds), or a mass is copied from another part. A robot
that is a hundred times too heavy drives in simulation as it should, but pushes everything out of
its way.

Shapes may overlap, so a light link is compared with the smallest volume that they can fill, and a
heavy one with the greatest. A collision may cover only a part of the link, so for a heavy link the
visuals count too. A mesh that is not closed counts as its convex hull. If the greatest volume is
that of meshes, a heavy link is an info: a mesh often draws a bracket or a cover, and the motor
behind it is not drawn; unless even the box around the link, full of metal, would weigh less. In
published robots none of the links that are heavier than steel in meshes has a wrong mass, and all
that are so in simple shapes have one; simple shapes of up to 2 mm are placeholders, and do not
count. A whole link that is as dense as solid steel is suspicious if the rest of the robot is
hollow, as robots are.

In a package of a released repository, copied beside the user's own packages, that none of these
uses, it is one step less severe.

Fix: correct the mass in kg, or the size of the shapes in m.
Source: densities of materials: foams from 15 kg/m³, aluminium 2 700, steel 7 850, lead 11 340.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from checker.base.record import Record
from checker.finding import Fix
from checker.formats.corrections import rewrite
from checker.model.components import Collision, Link, Visual
from checker.model.geometry.placed_shapes import union
from checker.physics.mass.link_geometry import known_box, known_reach, not_looked_at, volume_bounds
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_GRAMS = 1000.0
"""In a kilogram."""
_LEAST_GRAMS = 100.0
"""A smaller mass may be one in kg that was not computed, such as 1."""
_FOAM = 100.0
"""kg/m³; a link whose mass was in grams is denser than foam."""
_ALUMINIUM = 2700.0
"""kg/m³, from which a mass is proposed."""
_SLIGHT = 0.05
"""Share of the mass of the robot; one of its base that is denser than steel with less is an info:
its shape may stand for a larger part, such as a ball for a caster with its holder."""
_GRAVE = 0.1
"""Share of the mass of the robot; a link of impossible density with no more is a warning: it may be
right for the robot, while the shape stands for a larger one."""
_SHIFT = 0.05
"""Share of the diagonal around the robot by which what is too much moves the centre of mass."""
_HALF = 0.5
"""Share of the mass of the robot; if links of impossible density have more, all is too heavy."""


@rule("INE006", "implausible-density", Severity.WARNING, Concern.ROBOT)
def check(
    masses: MassProperties,
    *,
    lightest: float = 10.0,
    heaviest: float = 8000.0,
    impossible: float = 25000.0,
    metal: float = 5000.0,
    contrast: float = 5.0,
    share: float = 0.02,
    volume_share: float = 0.25,
) -> Findings:
    """Report links that are too light or too heavy for the volume of their shapes.

    Options:
        lightest: Density in kg/m³, for the volume of the link's largest collision; less is a
            warning.
        heaviest: Density in kg/m³, for the volume of all collisions of the link, or of all its
            visuals if that is more; more is a warning, or an info if these are meshes.
        impossible: Density in kg/m³, for the same volume; no metal is so dense, so more is an error
            if such links are half of the robot's mass, or move its centre of mass.
        metal: Density in kg/m³, for the same volume; a whole link that is denser is a warning if
            the rest of the robot is not.
        contrast: Factor by which such a link is denser than the rest of the robot.
        share: Share of the robot's mass; a link with no more may be a placeholder and is skipped,
            unless its volume exceeds `volume_share`.
        volume_share: Share of the sum of all links' largest collisions, by volume; a link with more
            is judged whatever its mass.
    """
    if masses.robot.is_static:
        return
    for reason in masses.robot.unknown_masses.values():
        yield unchecked(reason)
    large, carried = _large(masses, volume_share), _links_on_heavier_ones(masses)
    others, found = _Others(masses), list[_Heavy]()
    for name, inertia in masses.weighed.items():
        link = inertia.link
        counts = masses.share(name) > share or name in large
        if link.inertial is None or not link.collisions or not counts:
            continue
        unknown = not_looked_at(masses.robot, link)
        if unknown:
            yield unchecked(unknown)
            continue
        collisions = volume_bounds(masses.robot, link.collisions)
        visuals = volume_bounds(masses.robot, link.visuals)
        if collisions is None or (visuals is None and link.visuals):
            continue
        drawn = visuals[1] if visuals is not None else 0.0
        most = max(collisions[1], drawn)
        counted = link.visuals if drawn > collisions[1] else link.collisions
        drawn_only = any(map(_is_mesh, counted)) and not _fills(masses, inertia, impossible)
        density = inertia.mass / most if most > 0.0 else 0.0
        slight = masses.share(name) < _SLIGHT and name in masses.robot.tree.base
        slight = slight and density <= impossible
        heavy = Severity.INFO if drawn_only or slight else Severity.WARNING
        if density > heaviest:
            found.append(_Heavy(name, inertia, most, heavy))
        elif density > max(metal, contrast * others.density(name)):
            rest = f"the other links have {_rounded(others.density(name))}"
            yield from _say(inertia, most, f"at most {metal:g}; {rest}", heavy)
        elif (
            collisions[0] > 0.0 and inertia.mass / collisions[0] < lightest and name not in carried
        ):
            # What a box or a ball of a world weighs is its author's choice.
            severity = Severity.INFO if masses.robot.is_prop else Severity.WARNING
            yield from _say(inertia, collisions[0], f"at least {lightest:g}", severity)
    yield from _too_heavy(masses, found, heaviest, impossible)


def _too_heavy(
    masses: MassProperties, found: Sequence[_Heavy], heaviest: float, impossible: float
) -> Iterator[Finding]:
    """Report links that are denser than steel; those denser than any metal with a mass instead."""
    drawn = [it for it in found if it.density <= impossible or it.severity is Severity.INFO]
    for each in drawn:
        yield from _say(each.inertia, each.volume, f"at most {heaviest:g}", each.severity)
    solid = [it for it in found if it not in drawn]
    total = sum(masses.share(each.name) for each in solid)
    for each in solid:
        grave = masses.share(each.name) > _GRAVE and not _stands(masses, each.inertia.link)
        grave = grave and (total > _HALF or _unbalances(masses, each, heaviest))
        mass = each.plausible_mass(heaviest)
        expected = f"at most {heaviest:g}: {_rounded(mass)} kg would be plausible"
        severity = Severity.ERROR if grave else Severity.WARNING
        fix = _lighter(masses, each.inertia, mass)
        yield from _say(each.inertia, each.volume, expected, severity, fix)


class _Heavy(Record, eq=False):
    """A link that is denser than steel.

    Attributes:
        volume: The greatest that its shapes can fill, m³.
        severity: That of a link of steel; an info if the volume is that of a mesh.
    """

    name: str
    inertia: LinkInertia
    volume: float
    severity: Severity

    @property
    def density(self) -> float:
        """Of the link, kg/m³."""
        return self.inertia.mass / self.volume

    def plausible_mass(self, heaviest: float) -> float:
        """Return the mass in kg if it was written in grams, else that of aluminium, two digits."""
        grams = self.inertia.mass / _GRAMS
        if self.inertia.mass >= _LEAST_GRAMS and _FOAM < grams / self.volume < heaviest:
            return grams
        return float(f"{_ALUMINIUM * self.volume:.2g}")


def _unbalances(masses: MassProperties, heavy: _Heavy, heaviest: float) -> bool:
    """Return whether what a link weighs too much moves the robot's centre of mass."""
    boxes = [known_box(masses.robot, link) for link in masses.robot.links]
    whole = union([box for box in boxes if box is not None])
    if heavy.inertia.centre is None or masses.centre is None or whole is None:
        return False
    excess = heavy.inertia.mass - heaviest * heavy.volume
    moved = excess * math.dist(heavy.inertia.centre, masses.centre)
    return moved > _SHIFT * whole.diagonal * (masses.mass - excess)


def _lighter(masses: MassProperties, inertia: LinkInertia, mass: float) -> Fix | None:
    """Return the fix that writes a mass, and scales moments that are too large for it."""
    inertial, centre = inertia.link.inertial, inertia.centre
    if inertial is None or centre is None:
        return None
    ratio = mass / inertia.mass
    reach = known_reach(masses.robot, inertia.link, centre) or math.inf
    large = inertia.gyration_radius / math.sqrt(ratio) > reach
    moments = [(moment, moment.value * ratio) for moment in inertial.moments]
    return rewrite([(inertial.mass, mass), *(moments if large else ())])


def _fills(masses: MassProperties, inertia: LinkInertia, density: float) -> bool:
    """Return whether a link is denser than this in kg/m³ even if it fills the box around it."""
    box = known_box(masses.robot, inertia.link)
    if box is None:
        return False
    return inertia.mass > density * math.prod(box.high[i] - box.low[i] for i in range(3))


def _is_mesh(shape: Collision | Visual) -> bool:
    return shape.geometry.shape == "mesh"


class _Others:
    """The density of the robot without one of its links."""

    def __init__(self, masses: MassProperties) -> None:
        self.volumes = {
            name: most
            for name, inertia in masses.weighed.items()
            if inertia.link.inertial is not None
            and (most := _most(masses, inertia.link)) is not None
        }
        self.masses = {name: masses.links[name].mass for name in self.volumes}

    def density(self, name: str) -> float:
        """Return kg/m³ of all other links together; infinite where none is known."""
        volume = sum(each for other, each in self.volumes.items() if other != name)
        mass = sum(each for other, each in self.masses.items() if other != name)
        return mass / volume if volume > 0.0 else math.inf


def _most(masses: MassProperties, link: Link) -> float | None:
    """Return the greatest volume that the shapes of a link can fill, m³; None if unknown."""
    if not_looked_at(masses.robot, link):
        return None
    bounds = [volume_bounds(masses.robot, shapes) for shapes in (link.collisions, link.visuals)]
    known = [bound[1] for bound in bounds if bound is not None]
    return max(known) if known and max(known) > 0.0 else None


def _links_on_heavier_ones(masses: MassProperties) -> set[str]:
    """Return the links that are fixed to a heavier one: it may hold the mass of both."""
    bodies = masses.robot.tree.rigid_bodies
    heaviest = {
        body: max(masses.links[name].mass for name in names) for body, names in bodies.links.items()
    }
    return {
        name for name, body in bodies.of_link.items() if masses.links[name].mass < heaviest[body]
    }


def _large(masses: MassProperties, share: float) -> set[str]:
    """Return the links that fill more than a share of the collisions' volume."""
    bounds = {
        name: volume_bounds(masses.robot, inertia.link.collisions)
        for name, inertia in masses.links.items()
    }
    least = {name: known[0] for name, known in bounds.items() if known is not None}
    total = sum(least.values())
    return {name for name, volume in least.items() if volume > share * total}


def _stands(masses: MassProperties, link: Link) -> bool:
    """Return whether a link is the foot of a robot without wheels, heavy so that it is stable."""
    robot = masses.robot
    moved = {joint.child.value for joint in robot.joints}
    return link.name.value not in moved and not robot.locomotion.wheel_drives


def _rounded(number: float) -> str:
    """Return a number with three digits, and without an exponent up to a million."""
    return f"{float(f'{number:.3g}'):g}"


def _say(
    inertia: LinkInertia,
    volume: float,
    expected: str,
    severity: Severity,
    fix: Fix | None = None,
) -> Iterator[Finding]:
    if inertia.link.inertial is not None:
        yield finding(
            inertia.link.inertial.mass,
            f"link {inertia.link.name.value!r} has a density of {_rounded(inertia.mass / volume)} "
            f"kg/m³ ({inertia.mass:.4g} kg in {_rounded(1000 * volume)} litres), "
            f"expected {expected}",
            severity=severity,
            fix=fix,
        )


def _box(mass: float, mark: str = "", size: str = "0.1 0.1 0.1", more: str = "") -> str:
    return f"""
<inertial>
  <mass>{mass}</mass>{mark}
  <inertia><ixx>0.001</ixx><iyy>0.001</iyy><izz>0.001</izz></inertia>
</inertial>
<collision name="c"><geometry><box><size>{size}</size></box></geometry></collision>
{more}
"""


_MARK = "  <!-- ^ INE006 -->"
_HOUSING = '<visual name="v"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></visual>'
_COVER = """<visual name="v">
  <geometry><mesh><uri>meshes/cover.obj</uri></mesh></geometry>
</visual>"""
_CORNER = "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"
GOOD = [
    _box(2),
    _box(7.8),
    _box(2, size="0.001 0.001 0.001"),
    _box(2, size="0.1 0.1 0.001", more=_HOUSING),
]
_CASTER = """
<link name="ball">
  <inertial>
    <mass value="0.2"/>{}
    <inertia ixx="1e-6" iyy="1e-6" izz="1e-6" ixy="0" ixz="0" iyz="0"/>
  </inertial>
  <collision><geometry><sphere radius="0.01"/></geometry></collision>
</link>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="ball"/></joint>
"""
_BESIDE = """
<link name="ballast">
  <inertial><mass>4</mass></inertial>
  <collision name="c"><geometry><box><size>0.1 0.1 0.1</size></box></geometry></collision>
</link>
"""
BAD = [
    _box(9, _MARK),
    {"@urdf": _CASTER.format(_MARK)},
    _box(100, _MARK),
    _box(0.005, _MARK),
    {"@fragment": _box(30, _MARK, "0.05 0.05 0.05", _COVER), "meshes/cover.obj": _CORNER},
    f"<link name='foam'>{_box(0.005, _MARK)}</link>{_BESIDE}",
]
