"""A moment of inertia that is far too large or too small for the size of the link.

The radius of gyration, √(I/m), is the radius of a ring with the mass and moment of the link. No
mass of the link is beyond its farthest point, so the radius cannot be larger. Usually the moments
have other units, refer to another point than the centre of mass, or come from a larger part. The
link then turns like a flywheel: the robot moves, but more slowly than the real one. With far too
little inertia, as if all mass were in one point, the link jumps at the smallest force.

Fix: compute the moments about the centre of mass with CAD, or with the formula of the most similar
solid.
Source: definition of the moment of inertia.
"""

import math
from collections import Counter
from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from checker.physics.mass.even_inertia import moments_fix
from checker.physics.mass.link_geometry import displacement, known_reach, unknown_mesh
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked

_ONE_FORMULA = 3
"""Links with equal moments and one radius of gyration, at least, that no one computed."""
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

    For an object that is not a robot, such as a barrel, it is reported as info. Links with equal
    moments of one radius of gyration have a formula in common: they are one finding, the largest
    ratio first, as severe as the worst.

    Options:
        error_above: Ratio of the radius of gyration to the distance of the farthest point from the
            centre of mass; more is an error, such as moments in other units.
        subt_error_above: The same ratio in a submission for SubT.
        warning_above: The same ratio; more is at least a warning, because no body has more than 1.
        warning_below: The same ratio; less is a warning, because few bodies have so much of their
            mass near the centre (a solid ball has 0.63).
        share: Share of the robot's mass; a link with no more is often a placeholder: a moment that
            is too large is an info, one that is too small is skipped.
        placeholder: Mass, kg. A link of at most this mass whose mass and moments are powers of ten,
            the moments all equal, was never weighed: a warning.
    """
    if masses.robot.is_static:
        return
    is_prop = masses.robot.is_prop and not context.is_subt
    for reason in masses.robot.unknown_masses.values():
        yield unchecked(reason)
    found: list[tuple[float, str, Finding]] = []
    for name, inertia in masses.weighed.items():
        if inertia.link.inertial is None or inertia.centre is None or not _possible(inertia):
            continue
        reach = known_reach(masses.robot, inertia.link, inertia.centre)
        ratio = inertia.gyration_radius / reach if reach else math.inf
        if warning_below <= ratio <= warning_above:
            continue
        unknown = unknown_mesh(masses.robot, inertia.link)
        if unknown:
            yield unchecked(unknown)
        elif ratio < warning_below and displacement(masses.robot, inertia.link, inertia.centre):
            continue  # INE005 says so.
        elif reach and (ratio > warning_above or masses.share(name) > share):
            fixed = is_prop or name in masses.robot.tree.links_fixed_to_world
            heavy = masses.share(name) > share and not fixed
            mounted = masses.robot.is_mounted(name)
            limit = subt_error_above if context.is_subt else error_above
            grave = ratio > limit and not mounted
            grave = grave and not (inertia.mass <= placeholder and _is_made_up(inertia))
            severity = Severity.ERROR if grave else Severity.WARNING
            fault = finding(
                inertia.moments_span,
                _message(inertia, reach, "large" if ratio > warning_above else "small"),
                severity=severity if heavy else Severity.INFO,
                key="" if heavy else "placeholder",
                fix=moments_fix(masses.robot, inertia.link),
                covered_by=("INE013",),
            )
            made = ratio > warning_above and not fixed and not mounted
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


def _is_made_up(inertia: LinkInertia) -> bool:
    """Return whether mass and moments are powers of ten, and the moments equal."""
    powers = (math.log10(value) for value in (inertia.mass, inertia.principal[2]))
    return _has_equal_moments(inertia) and all(
        abs(power - round(power)) < _ROUND for power in powers
    )


def _has_equal_moments(inertia: LinkInertia) -> bool:
    least, *_, most = inertia.principal
    return math.isclose(least, most, rel_tol=1e-6)


def _possible(inertia: LinkInertia) -> bool:
    """Skip what INE001 (missing), INE002 (impossible) and INE003 (zero values) report."""
    inertial = inertia.link.inertial
    stated = inertial is not None and any(moment.stated for moment in inertial.moments)
    possible = inertia.has_moments and inertia.pseudo_eigenvalue >= -1e-12
    return stated and inertia.mass > 0.0 and possible


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
BAD = [_wheel(1e-6, _MARK), _wheel(0.03, _MARK), _wheel(8, _MARK), _wheel(8, _MARK, beside=1000)]
