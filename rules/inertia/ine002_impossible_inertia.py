"""A mass or inertia that no physical body can have.

Physics engines divide by these values: the robot flies apart, drifts off, or does not load. The sum
of any two principal moments must be at least the third; a plate reaches equality. One number covers
all conditions: the smallest eigenvalue of the pseudo-inertia, the matrix of the second moments of
mass, must not be negative. Gazebo Classic takes what differs from a possible inertia by no more
than half of the last digits written: that is not reported, and a warning for numbers of less than
three digits, such as 0.0001.

Fix: take mass, centre of mass and inertia from CAD, all in kg and m and about the centre of mass.
Look for a moment that is too large by a factor of 1000, or a lost sign; where the products of
inertia are placeholders, write 0 for these.
In URDF a link with a mass of zero is a frame without a body; URD007 reports one that moves.
Source: Wensing, Kim and Slotine, "Linear matrix inequalities for physically consistent inertial
parameter identification", 2018; libsdformat 12 refuses negative masses and impossible moments, and
accepts a mass of zero.
"""

import math
from collections.abc import Iterator
from decimal import Decimal, InvalidOperation

from checker.formats.sdf.auto_inertia import is_automatic
from checker.model.components import Inertial, Link
from checker.model.faults import FaultKind
from checker.model.robot import Robot
from checker.physics.mass.even_inertia import moments_fix
from checker.physics.mass.link_inertias import LinkInertias
from checker.physics.mass.mass_properties import LinkInertia
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule
from checker.source.text import Located, Span

_OF_A_BODY = 1e-4
"""kg·m²: a link without mass but with a larger moment is not a mere frame."""
_ROUNDED = 3
"""Digits from which a number is taken as rounded; one of fewer is an estimate."""
_DECIMALS = 4
"""Decimals from which a number of fewer digits may be rounded."""


@rule("INE002", "impossible-inertia", Severity.ERROR, Concern.ROBOT)
def check(
    inertias: LinkInertias, context: Context, *, tolerance: float = 1e-13, rounding: float = 1e-3
) -> Findings:
    """Report masses that are not positive and finite, and moments that no body can have.

    If the profile names no simulator, values that libsdformat accepts are a warning. Gazebo Classic
    loads a static model with any moments; of an object that is no robot it is a warning there.

    Options:
        tolerance: Rounding error, as a share of the pseudo-inertia's largest eigenvalue, by which
            the smallest may be below 0, in units in which mass and largest moment are 1.
        rounding: The same for URDF, which is not read by libsdformat: numbers rounded to three
            digits do no harm.
    """
    classic = context.release == "classic"
    readable = Severity.ERROR if context.release else Severity.WARNING
    robot = inertias.robot
    misread = _misread(robot)
    massless, merges = robot.conventions.has_massless_links, robot.conventions.merges_fixed_links
    share = rounding if merges else tolerance
    for inertia in inertias.links.values():
        inertial = inertia.link.inertial
        if inertial is None or _spans(inertial) & misread or _left_open(inertia.link, inertial):
            continue
        still = robot.is_still(inertia.link)
        # Without mass it is a frame; without moments, INE003 reports it.
        if massless and (inertia.mass == 0.0 or not inertia.has_moments):
            # What Gazebo makes of a body without mass, URD007 reports.
            heavy = inertia.link.collisions and max(inertia.principal) > _OF_A_BODY
            if heavy and not robot.is_for_gazebo:
                yield from _mass(inertia, inertial, Severity.WARNING)
            continue
        if inertia.mass < 0.0 or not still:
            yield from _mass(inertia, inertial, readable)
        if classic and still:
            continue
        # A URDF's fixed links are one body for the simulator, an SDF's are each read alone.
        merged = merges and inertia.piece_eigenvalue >= -share
        scenery = classic and robot.is_prop and not merges
        lenient = context.release in ("", "classic")
        if lenient and _is_rounded(inertia, inertial):
            continue
        coarse = lenient and _is_rounded(inertia, inertial, coarsely=True)
        possible = Severity.WARNING if merged or scenery or coarse else Severity.ERROR
        yield from _moments(robot, inertia, inertial, possible, share)


def _left_open(link: Link, inertial: Inertial) -> bool:
    """Return whether the simulator computes the inertia, from meshes that are not read here."""
    return is_automatic(link.element.child("inertial")) and math.isnan(inertial.mass.value)


def _spans(inertial: Inertial) -> set[Span]:
    return {number.span for number in (inertial.mass, *inertial.moments)}


def _misread(robot: Robot) -> set[Span]:
    """Return the places of values that are not numbers: the rules on syntax report these."""
    return {fault.span for fault in robot.faults_of(FaultKind.VALUE)}


def _mass(inertia: LinkInertia, inertial: Inertial, readable: Severity) -> Iterator[Finding]:
    if not 0.0 < inertia.mass < math.inf:
        yield finding(
            inertial.mass,
            f"link {inertia.link.name.value!r} has a mass of {inertia.mass:g} kg, expected a "
            "positive number",
            severity=Severity.ERROR if inertia.mass < 0.0 else readable,
        )


def _is_rounded(inertia: LinkInertia, inertial: Inertial, *, coarsely: bool = False) -> bool:
    """Return whether the moments fit together but for half of the last digit of each."""
    first, second, third = inertia.principal
    moments = (inertial.moments[number] for number in (0, 3, 5))
    allowed = sum(_half_of_last_digit(moment, coarsely=coarsely) for moment in moments)
    return first >= 0.0 and third - first - second <= allowed


def _half_of_last_digit(moment: Located[float], *, coarsely: bool) -> float:
    text = moment.span.text.strip("\"' \t\r\n")
    try:
        _, digits, exponent = Decimal(text).as_tuple()
    except InvalidOperation:
        return 0.0
    plain = coarsely and len(text.partition(".")[2]) >= _DECIMALS and text[-1:].isdecimal()
    is_rounded = isinstance(exponent, int) and (len(digits) >= _ROUNDED or plain)
    return float(Decimal((0, (5,), int(exponent) - 1))) if is_rounded else 0.0


def _moments(
    robot: Robot, inertia: LinkInertia, inertial: Inertial, level: Severity, share: float
) -> Iterator[Finding]:
    name = inertia.link.name.value
    if any(math.isnan(moment) for moment in inertia.principal):
        wrong = next(moment for moment in inertial.moments if not math.isfinite(moment.value))
        yield finding(
            wrong,
            f"link {name!r} has a moment of inertia of {wrong.value:g} kg·m², expected a finite "
            "number",
        )
        return
    # A negative mass makes the eigenvalue negative by itself; it is said already.
    if inertia.mass < 0.0 or not inertia.pseudo_eigenvalue < -share:
        return
    first, second, third = inertia.principal
    moments = ", ".join(f"{moment:.4g}" for moment in inertia.principal)
    less = f"{first:.4g} + {second:.4g} is less than {third:.4g}"
    why = f"{first:.4g} is negative" if first < 0.0 else less
    least, middle, most = sorted(inertial.moments[number].value for number in (0, 3, 5))
    if least > 0.0 and most <= least + middle:
        why += "; ixx, iyy and izz are possible with ixy, ixz and iyz of 0"
    yield finding(
        inertia.moments_span,
        f"link {name!r} has principal moments of inertia of {moments} kg·m², which no physical "
        f"body can have: {why}",
        severity=level,
        fix=moments_fix(robot, inertia.link),
    )


def _link(mass: str, ixx: str, iyy: str, izz: str, ixy: str = "0", mark: str = "") -> str:
    return f"""
<inertial>
  <mass>{mass}</mass>
  <inertia>{mark}
    <ixx>{ixx}</ixx>
    <ixy>{ixy}</ixy>
    <iyy>{iyy}</iyy>
    <izz>{izz}</izz>
  </inertia>
</inertial>
"""


_MARK = "  <!-- ^ INE002 -->"
GOOD = [
    _link("2", "1", "1", "2"),
    _link("2", "0.01", "0.02", "0.025", "0.004"),
    _link("2", "0", "1", "1"),
    {"@profile": "sdf", "@fragment": _link("2", "1.53E-6", "1.18E-4", "1.16E-4")},
    {
        "@profile": "gazebo-classic",
        "@fragment": f"<static>true</static>{_link('2', '1', '1', '3')}",
    },
]
BAD = [
    _link("2", "1", "1", "3", mark=_MARK),
    _link("2", "1.53E-6", "1.18E-4", "1.16E-4", mark=_MARK),
    {"@profile": "sdf", "@fragment": _link("2", "1.53E-6", "1.22E-4", "1.16E-4", mark=_MARK)},
    {"@profile": "sdf", "@fragment": _link("2", "1", "1", "3", mark=_MARK)},
    _link("2", "-1", "1", "1", mark=_MARK),
    _link("2", "1", "1", "1", "2", mark=_MARK),
    _link(f"0</mass>{_MARK}<mass>5", "1", "1", "1"),
    _link(f"-2</mass>{_MARK}<mass>5", "1", "1", "1"),
    {
        "@urdf": """
<link name="tip">
<inertial>
<mass value="0"/>  <!-- ^ INE002 -->
<inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/>
</inertial>
<collision><geometry><box size="1 1 1"/></geometry></collision>
</link>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>
"""
    },
]
