"""A robot that does not stop when it is told to.

It rolls or slides on after the command has gone to zero. Brakes are what a drive plugin does by
itself; a robot that drives on has a part that pushes it, or wheels that do not grip.

Fix: look at the friction of the wheels, at their axes, and at plugins that fight each other.
Source: experience; the speed at the end of a stop, 1.5 s or as long as its limits let it brake.
"""

from checker.physics.trial.robot_trial import RobotTrial
from checker.rule import Findings, Severity, finding, rule


@rule("TRI008", "does-not-stop", Severity.ERROR)
def check(driven: RobotTrial, *, error_above: float = 0.05) -> Findings:
    """Report a speed beyond the command that is left after a stop.

    Options:
        error_above: Speed in m/s, over what is still commanded, that may be left at the end of a
            stop; more is an error.
    """
    speed = driven.trial.value("stop_speed")
    if speed is None or abs(speed) <= error_above:
        return
    distance = driven.trial.value("stop_distance")
    way = f" and has gone {distance:.2g} m" if distance is not None else ""
    yield finding(
        driven.drive,
        f"after a stop it still moves at {abs(speed):.2g} m/s{way}, expected "
        f"at most {error_above:g} m/s",
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
