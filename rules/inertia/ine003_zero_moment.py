"""A principal moment of inertia is zero: the link has no resistance to rotation about that axis.

MuJoCo refuses such a body, and other engines divide by the moment. Only a line without width has
one moment of zero, and only a point has three. If the part is fixed to others with inertia, they
move as one body; then this is an info.

Fix: state the moments of the part itself, or of a small box of its size: m/12·(b² + c²).
Source: MuJoCo documentation, body/inertial: the inertia of moving bodies must be positive.
"""

from checker.physics.mass.even_inertia import moments_fix
from checker.physics.mass.mass_properties import LinkInertia, MassProperties
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("INE003", "zero-moment", Severity.ERROR, Concern.ROBOT)
def check(masses: MassProperties, *, least: float = 1e-14, relative: float = 1e-9) -> Findings:
    """Report possible inertias with a principal moment of zero.

    Options:
        least: The smallest principal moment, kg·m², up to which it counts as zero.
        relative: Share of the link's largest principal moment up to which the smallest counts as
            zero.
    """
    if masses.robot.is_static:
        return
    body = masses.robot.tree.rigid_bodies.of_link
    sound = {body[name] for name, link in masses.links.items() if not _zero(link, least, relative)}
    for name, inertia in masses.links.items():
        if inertia.link.inertial is None or not _possible(inertia):
            continue
        if not _zero(inertia, least, relative):
            continue
        moments = ", ".join(f"{abs(moment):.4g}" for moment in inertia.principal)
        alone = body[name] not in sound
        bound = max(least, relative * inertia.principal[2])
        expected = f"{bound:.1g} kg·m²" if inertia.principal[0] > 0.0 else "zero"
        tied = "" if alone else "; the link is fixed to links that have inertia"
        yield finding(
            inertia.moments_span,
            f"link {inertia.link.name.value!r} has principal moments of inertia of {moments} kg·m²,"
            f" expected all above {expected}{tied}",
            severity=Severity.ERROR if alone else Severity.INFO,
            fix=moments_fix(masses.robot, inertia.link) if alone else None,
        )


def _possible(inertia: LinkInertia, tolerance: float = 1e-12) -> bool:
    """Skip what INE002 reports: values that no body can have."""
    possible = inertia.pseudo_eigenvalue >= -tolerance or not inertia.has_moments
    return inertia.mass > 0.0 and possible


def _zero(inertia: LinkInertia, least: float, relative: float) -> bool:
    return inertia.principal[0] <= max(least, relative * inertia.principal[2])


def _link(name: str, moments: tuple[float, float, float], mark: str = "") -> str:
    xx, yy, zz = moments
    return f"""
<link name="{name}">
  <inertial>
    <mass>1</mass>
    <inertia>{mark}<ixx>{xx}</ixx><iyy>{yy}</iyy><izz>{zz}</izz></inertia>
  </inertial>
</link>
"""


_FIXED = """
<joint name="weld" type="fixed"><parent>body</parent><child>antenna</child></joint>
"""
_MARK = "  <!-- ^ INE003 -->"
_BODY, _ROD = (0.1, 0.1, 0.1), (0.1, 0.1, 0.0)
GOOD = [_link("body", _BODY), _link("body", (1e-7, 1e-7, 1e-7))]
BAD = [
    _link("antenna", _ROD, _MARK),
    _link("antenna", (0.0, 0.0, 0.0), _MARK),
    _link("body", _BODY) + _link("antenna", _ROD, _MARK) + _FIXED,
]
