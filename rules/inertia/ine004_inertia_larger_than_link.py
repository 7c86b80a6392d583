"""A moment of inertia that is far too large or too small for the size of the link.

The radius of gyration, √(I/m), is the radius of a ring with the mass and moment of the link. No
mass of the link is beyond its farthest point, so the radius cannot be larger. Usually the moments
have other units, refer to another point than the centre of mass, or come from a larger part. The
link then turns like a flywheel: the robot moves, but more slowly than the real one. With far too
little inertia, as if all mass were in one point, the link jumps at the smallest force.

Fix: compute the moments about the centre of mass with CAD, or with the formula of the most similar
solid; where only the mass was changed, scale the moments with it.
Source: definition of the moment of inertia.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from checker.model.robot import Robot
from checker.physics.mass.even_inertia import even_moments, moments_fix
from checker.physics.mass.link_geometry import displacement, known_reach, unknown_mesh
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked

_ONE_FORMULA = 3
"""Links with equal moments and one radius of gyration, at least, that no one computed."""
_SEVERAL = 3.0
"""Ratio of the radius of gyration to the reach of an object from which it is a warning."""
_DIAGONAL = (0, 3, 5)
"""Where ixx, iyy and izz are among the moments."""
_FARTHEST = 20.0
"""Times that a mass was another one before, at most: moments in other units are far more."""
_ALIKE = 1.1
"""Ratio of three moments to those of the shapes, largest to least, at most, of another mass."""
_ROUND = 1e-6
"""Distance of a logarithm from a whole number, at most, for a power of ten."""


@rule("INE004", "inertia-larger-than-link", Severity.ERROR, Concern.ROBOT)
def check(
    masses: MassProperties,
    context: Context,
    *,
    error_above: float = 10.0,
    subt_error_above: float = 1.5,
    warning_above: float = 1.0,
    warning_below: float = 0.02,
    share: float = 0.02,
    placeholder: float = 0.01,
) -> Findings:
    """Compare radii of gyration with the farthest point of the link's collisions and visuals.

    For an object that is not a robot, such as a barrel, it is an info, and a warning where the
    ratio is several times as large as possible. Links with equal moments of one radius of gyration
    have a formula in common: they are one finding, the largest ratio first, as severe as the worst.

    Options:
        error_above: Ratio of the radius of gyration to the distance of the farthest point from the
            centre of mass; more is an error, such as moments in other units.
        subt_error_above: The same ratio in a submission for SubT.
        warning_above: The same ratio; more is at least a warning, because no body has more than 1.
        warning_below: The same ratio; less is a warning, because few bodies have so much of their
            mass near the centre (a solid ball has 0.63).
        share: Share of the robot's mass; a link with no more is often a placeholder: a moment that
            is too large is an info, or a warning if it exceeds all others; a small one is skipped.
        placeholder: Mass, kg. A link of at most this mass whose mass and moments are powers of ten,
            the moments all equal, was never weighed: a warning.
    """
    if masses.robot.is_static:
        return
    is_prop = masses.robot.is_prop and not context.is_subt
    for reason in masses.robot.unknown_masses.values():
        yield unchecked(reason)
    found: list[tuple[float, str, Finding]] = []
    known = [
        (name, it, it.centre, known_reach(masses.robot, it.link, it.centre))
        for name, it in masses.weighed.items()
        if it.link.inertial is not None and it.centre is not None and it.states_possible_moments
    ]
    possible = sum(
        it.principal[2] for _, it, _, reach in known if it.gyration_radius <= (reach or 0)
    )
    for name, inertia, centre, reach in known:
        ratio = inertia.gyration_radius / reach if reach else math.inf
        if warning_below <= ratio <= warning_above:
            continue
        unknown = unknown_mesh(masses.robot, inertia.link)
        if unknown:
            yield unchecked(unknown)
        elif ratio < warning_below and displacement(masses.robot, inertia.link, centre):
            continue  # INE005 says so.
        elif reach and (ratio > warning_above or masses.share(name) > share):
            heavy = masses.share(name) > share and not (is_prop and ratio <= _SEVERAL)
            mounted = masses.robot.is_mounted(name)
            limit = subt_error_above if context.is_subt else error_above
            grave = ratio > limit and not (mounted or is_prop)
            grave = grave and not (inertia.mass <= placeholder and _is_made_up(inertia))
            severity = Severity.ERROR if grave else Severity.WARNING
            fault = finding(
                inertia.moments_span,
                _message(inertia, reach, "large" if ratio > warning_above else "small")
                + _of_other_mass(masses.robot, inertia),
                severity=severity if heavy else _of_light(inertia, 0.0 if is_prop else possible),
                key="" if heavy else "placeholder",
                fix=moments_fix(masses.robot, inertia.link),
                covered_by=("INE013",),
            )
            made = ratio > warning_above and not (is_prop or mounted)
            found.append((ratio, _formula(inertia) if made else "", fault))
    yield from _of_one_formula(sorted(found, key=lambda each: -each[0]))


def _of_one_formula(found: Sequence[tuple[float, str, Finding]]) -> Iterator[Finding]:
    """Yield findings; those of several links with one formula for the moments are one fault."""
    alike: dict[str, set[Severity | None]] = {}
    for _, formula, fault in found:
        alike.setdefault(formula, set()).add(fault.severity)
    counts = Counter(formula for _, formula, _ in found)
    for _, formula, fault in found:
        severities = alike[formula]
        if not formula or counts[formula] < _ONE_FORMULA or severities == {Severity.INFO}:
            yield fault
        else:
            grave = Severity.ERROR if Severity.ERROR in severities else Severity.WARNING
            yield replace(fault, severity=grave, key=formula)


def _of_light(inertia: LinkInertia, possible: float) -> Severity:
    """Return the severity for a link of little mass: it may turn as heavily as all others."""
    return Severity.WARNING if 0.0 < possible < inertia.principal[2] else Severity.INFO


def _formula(inertia: LinkInertia) -> str:
    """Return what links whose moments have one formula have in common; empty if not equal."""
    return f"{inertia.gyration_radius:.3g} m" if _has_equal_moments(inertia) else ""


def _message(inertia: LinkInertia, reach: float, how: str) -> str:
    return (
        f"link {inertia.link.name.value!r} has a radius of gyration of "
        f"{inertia.gyration_radius:.3g} m, but its farthest point is {reach:.3g} m from its centre "
        f"of mass: its moments of inertia of up to {inertia.principal[2]:.3g} kg·m² are too {how} "
        f"for {inertia.mass:.4g} kg"
    )


def _of_other_mass(robot: Robot, inertia: LinkInertia) -> str:
    """Return the mass whose moments these are, if the link's shapes have them; else nothing."""
    even, inertial = even_moments(robot, inertia.link), inertia.link.inertial
    if even is None or inertial is None or _has_equal_moments(inertia):
        return ""
    ratios = [inertial.moments[at].value / even[at] for at in _DIAGONAL if even[at] > 0.0]
    if len(ratios) < len(_DIAGONAL) or not 0.0 < max(ratios) <= min(
        _FARTHEST, _ALIKE * min(ratios)
    ):
        return ""
    mass = inertia.mass * math.prod(ratios) ** (1 / len(ratios))
    return f"; they fit {mass:.2g} kg, spread evenly over its shapes: was only the mass changed?"


def _is_made_up(inertia: LinkInertia) -> bool:
    """Return whether mass and moments are powers of ten, and the moments equal."""
    powers = (math.log10(value) for value in (inertia.mass, inertia.principal[2]))
    return _has_equal_moments(inertia) and all(
        abs(power - round(power)) < _ROUND for power in powers
    )


def _has_equal_moments(inertia: LinkInertia) -> bool:
    least, *_, most = inertia.principal
    return math.isclose(least, most, rel_tol=1e-6)


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
_TOOL_FRAME = """
<link name="tool">
  <inertial>
    <mass value="0"/>
    <inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/>
  </inertial>
  <collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision>
</link>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tool"/></joint>
"""
GOOD = [
    _wheel(0.008),
    _wheel(0.02),
    _wheel(1e-6, beside=1000),
    {"@urdf": _TOOL_FRAME},
]
# The moments of 6 kg: only the mass was changed.
_LIGHTER = f"""
<link name="body">
  <inertial>
    <mass>0.5</mass>
    <inertia>{_MARK}<ixx>0.025</ixx><iyy>0.1</iyy><izz>0.085</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.4 0.1 0.2</size></box></geometry></collision>
</link>
"""
BAD = [
    _wheel(1e-6, _MARK),
    _wheel(0.03, _MARK),
    _wheel(8, _MARK),
    _wheel(8, _MARK, beside=1000),
    _LIGHTER,
]
