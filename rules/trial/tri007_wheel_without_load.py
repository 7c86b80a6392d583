"""A drive wheel that carries little or no load.

The wheel spins without traction: the robot has less driving force than its motors suggest, and
drifts to one side on uneven ground. The wheel's collision is missing or too small, or one wheel is
higher or lower than the others: of four wheels, the one that hangs may be the neighbour of that.
Where this is a few millimetres and the robot still drives straight, it is a warning.

Fix: put all wheels on one plane: correct the height of the joint that the message names, or the
radius of its wheel's collision; give a wheel without a collision one.
Source: experience; the load is the mean while the robot is at rest, compared with an equal share of
the weight. Of a robot on springs, it is the largest of all stops: strongly damped ones move slowly.
"""

from checker.model.locomotion.wheel_positions import Foot, uneven_wheels
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
    uneven = _most_uneven(driven)
    harmless = (
        uneven is not None
        and abs(uneven.off) <= min(_SLIGHT, _SLIGHT_OF_RADIUS * _radius(uneven))
        and _drives_straight(driven)
    )
    for load in driven.trial.all("load_share"):
        if load.value >= warning_below:
            continue
        bare = load.value < error_below
        carried = "carries nothing" if bare else f"carries {load.value:.1%} of an equal share"
        yield finding(
            driven.part(load.part),
            f"the wheel on {load.part!r} {carried} of the robot's weight, expected at least "
            f"{warning_below:.0%} of an equal share{_cause(uneven)}",
            severity=Severity.ERROR if bare and not harmless else Severity.WARNING,
            key="load_share",
        )


_LEAST = 5e-4
"""Metres; less than this lets no wheel hang."""
_SLIGHT, _SLIGHT_OF_RADIUS = 0.005, 0.05
"""Metres, and a share of the wheel's radius: less harms no robot that drives straight."""
_STRAIGHT = {"path_sideways": 0.02, "path_heading": 0.035}
"""What TRI004 accepts."""


def _most_uneven(driven: SettledTrial) -> Foot | None:
    """Return the wheel that is farthest off the level of the others."""
    feet = uneven_wheels(driven.robot, _LEAST)
    return max(feet, key=lambda foot: abs(foot.off), default=None)


def _radius(foot: Foot) -> float:
    return (foot.part.box.high[2] - foot.part.box.low[2]) / 2


def _drives_straight(driven: SettledTrial) -> bool:
    figures = ((driven.trial.value(name), most) for name, most in _STRAIGHT.items())
    return all(value is not None and abs(value) <= most for value, most in figures)


def _cause(foot: Foot | None) -> str:
    """Return which wheel is off the level of the others, as the end of a sentence."""
    if foot is None or foot.part.wheel is None:
        return ""
    wheel, side = foot.part.wheel, "above" if foot.off > 0 else "below"
    return (
        f"; wheel {wheel.link.name.value!r} is {abs(foot.off) * 1e3:.2g} mm {side} the level of "
        f"the others: correct the height of {wheel.joint.name.value!r}"
    )


def _rover(radius: float, mark: str = "") -> str:
    """Return a rover whose left front wheel has a different radius."""
    text = rover(centre="-0.05 -0.05 0").replace("<radius>0.1<", f"<radius>{radius}<", 1)
    return text.replace('type="revolute">', f'type="revolute">{mark}', 1)


GOOD = [_rover(0.1)]
BAD = [_rover(0.05, "  <!-- ^ TRI007 -->")]
