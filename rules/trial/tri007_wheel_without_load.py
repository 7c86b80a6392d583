"""A drive wheel that carries little or no load.

The wheel spins without traction: the robot has less driving force than its motors suggest, and
drifts to one side on uneven ground. The wheel's collision is missing or too small, or the wheel is
higher than the others.

Fix: give the wheel a collision with its radius, and put all wheels on one plane.
Source: experience; the load is the mean while the robot is at rest, compared with an equal share of
the weight. Of a robot on springs, it is the largest of all stops: strongly damped ones move slowly.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import rover


@rule("TRI007", "wheel-without-load", Severity.ERROR, Concern.ROBOT, judges=("load_share",))
def check(
    driven: SettledTrial, *, warning_below: float = 0.05, error_below: float = 0.002
) -> Findings:
    """Report wheels that carry far less than an equal share of the weight.

    Options:
        warning_below: Share of an equal part of the weight (weight divided by number of drive
            wheels); a wheel that carries less is a warning.
        error_below: Share of an equal part of the weight; a wheel that carries less is an error
            instead of a warning.
    """
    for load in driven.trial.all("load_share"):
        if load.value >= warning_below:
            continue
        bare = load.value < error_below
        carried = "carries nothing" if bare else f"carries {load.value:.1%} of an equal share"
        yield finding(
            driven.part(load.part),
            f"the wheel on {load.part!r} {carried} of the robot's weight, expected at least "
            f"{warning_below:.0%} of an equal share",
            severity=Severity.ERROR if bare else Severity.WARNING,
            key="load_share",
        )


def _rover(radius: float, mark: str = "") -> str:
    """Return a rover whose left front wheel has a different radius."""
    text = rover(centre="-0.05 -0.05 0").replace("<radius>0.1<", f"<radius>{radius}<", 1)
    return text.replace('type="revolute">', f'type="revolute">{mark}', 1)


GOOD = [_rover(0.1)]
BAD = [_rover(0.05, "  <!-- ^ TRI007 -->")]
