"""A total mass that differs from the one in specifications.md.

The mass determines how the robot accelerates, slips and drains its battery. If specification sheet
and model disagree, one of them describes another robot. Typical causes are a copied link, a missing
battery, or pounds instead of kilograms. The robot weighs what its model says, so this is a warning.

Fix: correct the masses of the links, or specifications.md.
Source: Robot Model Checklist: reviewers add up the links and compare with "Cost and Scale".
"""

from checker.model.robot import Robot
from checker.model.specification.sheet import Specification
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("INE008", "mass-differs-from-specification", Severity.WARNING, Concern.PAPERWORK)
def check(
    robot: Robot,
    specification: Specification,
    *,
    error_above: float = 1e9,
    warning_above: float = 0.02,
    approximate_factor: float = 2.0,
) -> Findings:
    """Compare the sum of the links' masses with the stated mass.

    Options:
        error_above: Difference from the stated mass as a share of it, in addition to the rounding
            of the stated figure; more is an error. None is, unless you set this.
        warning_above: Difference from the stated mass as a share of it, in addition to the rounding
            of the stated figure; more is a warning.
        approximate_factor: Factor by which both shares grow if specifications.md calls the mass
            approximate, as in "about 50 kg".
    """
    if robot.unweighed:
        yield unchecked(robot.unweighed)
        return
    stated = specification.total_mass
    if stated is None or stated.value <= 0 or not robot.links:
        return
    off = robot.mass / stated.value - 1
    slack = approximate_factor if stated.approximate else 1.0
    # A figure such as 38 kg says no more than 37.5 to 38.5 kg.
    beyond = abs(robot.mass - stated.value) - 0.5 * stated.resolution
    if beyond <= 0 or abs(off) <= warning_above * slack:
        return
    grave = abs(off) > error_above * slack
    yield finding(
        stated,
        f"specifications.md says {stated.value:g} kg, but the links together weigh "
        f"{robot.mass:.4g} kg: {abs(off):.0%} {'more' if off > 0 else 'less'}",
        severity=Severity.ERROR if grave else Severity.WARNING,
        related=[(robot, "the model's links")],
    )


def _link(mass: float) -> str:
    return f"""
<link name="body"><inertial><mass>{mass}</mass><inertia>
  <ixx>1</ixx><iyy>1</iyy><izz>1</izz>
</inertia></inertial></link>
"""


_SHEET = "# Rover\n### Cost and Scale\nThe total robot weight is {} kg."

GOOD = [
    {"@fragment": _link(48.5), "specifications.md": _SHEET.format("50.0")},
    {"@fragment": _link(47.3), "specifications.md": _SHEET.format("approximately 50")},
]
BAD = [
    {
        "@fragment": _link(39.0),
        "specifications.md": _SHEET.format("50.0") + " <!-- ^ INE008 -->",
    },
    {
        "@fragment": _link(47.4),
        "specifications.md": _SHEET.format("50.0") + " <!-- ^ INE008 -->",
    },
]
