"""A robot that does not stop when commanded to.

The robot rolls or slides on after the command is zero. A drive plugin brakes by itself; if the
robot keeps moving, a part pushes it, or its wheels do not grip.

Fix: check the friction of the wheels, their axes, and plugins that work against each other.
Source: experience; the speed at the end of a stop of 1.5 s, or longer if the robot's limits need
more time.
"""

from checker.base.words import beyond
from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule


@rule("TRI008", "does-not-stop", Severity.ERROR, Concern.ROBOT, judges=("stop_speed",))
def check(driven: SettledTrial, *, error_above: float = 0.05) -> Findings:
    """Report a speed above the command after a stop.

    Options:
        error_above: Speed in m/s above the command at the end of a stop; more is an error.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    speed = driven.trial.value("stop_speed")
    if speed is None or abs(speed) <= error_above:
        return
    distance = driven.trial.value("stop_distance")
    way = f" and has moved {distance:.2g} m" if distance is not None else ""
    yield finding(
        driven.drive,
        f"after a stop the robot still moves at {beyond(abs(speed), error_above)} m/s{way}, "
        f"expected at most {error_above:g} m/s",
        key="stop_speed",
    )


def _slippery(friction: float, mark: str = "") -> dict[str, object]:
    surface = f"<surface><friction><ode><mu>{friction}</mu></ode></friction></surface>"
    tyre = "</sphere></geometry>"
    return {
        "@robot": "rover",
        "@change": {'DiffDrive">': f'DiffDrive">{mark}', tyre: f"{tyre}{surface}"},
    }


GOOD = [_slippery(1.0)]
BAD = [_slippery(0.01, "  <!-- ^ TRI008 -->")]
