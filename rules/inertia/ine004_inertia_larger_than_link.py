"""A moment of inertia that does not fit the size of the link: too large, or hardly any.

The radius of gyration, √(I/m), is how far from its centre of mass a ring of the link's mass would
have that moment. No mass of the link is beyond its farthest point, so the radius cannot be either:
mostly the moments are in other units, are taken about another point than the centre of mass, or are
left from a larger part. The link then turns as if it were a flywheel. With hardly any inertia, as
if all mass were in one point, it answers the least force with a jump.

Fix: work out the moments about the centre of mass from CAD, or by the formula of the nearest solid.
Source: definition of the moment of inertia.
"""

import math

from checker.physics.mass.link_geometry import known_reach, not_looked_at
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Findings, Severity, finding, rule, unchecked


@rule("INE004", "inertia-larger-than-link", Severity.ERROR)
def check(
    masses: MassProperties,
    *,
    error_above: float = 1.5,
    warning_above: float = 1.0,
    warning_below: float = 0.02,
    share: float = 0.02,
) -> Findings:
    """Compare radii of gyration with the farthest point of the link's collisions and visuals.

    Options:
        error_above: Ratio of the radius of gyration to the distance of the farthest point from the
            centre of mass; more is an error.
        warning_above: Ratio of the same two lengths; more is a warning at least, for no body has
            more than 1.
        warning_below: Ratio of the same two lengths; less is a warning, for hardly anything is as
            dense in its middle (a solid ball has 0.63).
        share: Share of the robot's mass; a link with no more is often a placeholder: it is
            information if too large and passed over if too small.
    """
    for name, inertia in masses.links.items():
        if inertia.link.inertial is None or inertia.centre is None or not _possible(inertia):
            continue
        reach = known_reach(masses.robot, inertia.link, inertia.centre)
        ratio = inertia.gyration_radius / reach if reach else math.inf
        if warning_below <= ratio <= warning_above:
            continue
        unknown = not_looked_at(masses.robot, inertia.link)
        if unknown:
            yield unchecked(unknown)
        elif reach and (ratio > warning_above or masses.share(name) > share):
            heavy = masses.share(name) > share
            severity = Severity.ERROR if ratio > error_above else Severity.WARNING
            yield finding(
                inertia.moments_span,
                _message(inertia, reach, "large" if ratio > warning_above else "small"),
                severity=severity if heavy else Severity.INFO,
                key="" if heavy else "placeholder",
            )


def _message(inertia: LinkInertia, reach: float, how: str) -> str:
    return (
        f"link {inertia.link.name.value!r} has a radius of gyration of "
        f"{inertia.gyration_radius:.3g} m, its farthest point is {reach:.3g} m from its centre of "
        f"mass: its moments of inertia of up to {inertia.principal[2]:.3g} kg·m² are too {how} for "
        f"{inertia.mass:.4g} kg"
    )


def _possible(inertia: LinkInertia) -> bool:
    """Leave what no body can have to INE002, and what nobody stated to INE001."""
    inertial = inertia.link.inertial
    stated = inertial is not None and any(moment.stated for moment in inertial.moments)
    return stated and inertia.mass > 0.0 and inertia.pseudo_eigenvalue >= -1e-12


def _wheel(moment: float, mark: str = "", beside: float = 2.0) -> str:
    return f"""
<link name="base_link"><inertial><mass>{beside}</mass></inertial></link>
<link name="wheel">
  <inertial>
    <mass>2</mass>
    <inertia>{mark}<ixx>{moment}</ixx><iyy>{moment}</iyy><izz>{moment}</izz></inertia>
  </inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
"""


_MARK = "  <!-- ^ INE004 -->"
GOOD = [_wheel(0.008), _wheel(0.02), _wheel(1e-6, beside=1000)]
BAD = [_wheel(1e-6, _MARK), _wheel(0.03, _MARK), _wheel(8, _MARK), _wheel(8, _MARK, beside=1000)]
