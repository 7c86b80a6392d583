"""A robot that exceeds its velocity or acceleration limit.

The limits in the drive plugin are those of the real robot, which cannot do what a faster simulated
one does. Usually the wheels are larger than `wheel_radius`, or the limit applies to each of several
plugins.

Fix: set `wheel_radius` to the radius of the wheels' collisions, and state the limits in all drive
plugins.
Source: the plugin's `max_velocity` and `max_acceleration`, compared with 2 s at full command.
"""

from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule

_ROUNDING = 1.005
"""What is at the threshold as a message shows it is not above it."""


@rule(
    "TRI014",
    "limits-exceeded",
    Severity.WARNING,
    Concern.ROBOT,
    judges=("full_speed", "full_acceleration"),
)
def check(
    driven: SettledTrial, *, full_speed_above: float = 1.05, full_acceleration_above: float = 1.25
) -> Findings:
    """Report a speed and an acceleration above these multiples of their limits.

    Options:
        full_speed_above: Multiple of the drive plugin's velocity limit; a higher speed at full
            command is reported.
        full_acceleration_above: Multiple of the drive plugin's acceleration limit; more, averaged
            over 0.2 s, is reported.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    value = driven.trial.value
    symptoms = {}
    speed, limit = value("full_speed"), value("full_speed_limit")
    if speed is not None and limit and abs(speed) > full_speed_above * limit:
        symptoms["full_speed"] = (
            f"the robot drives at {abs(speed):.3g} m/s, but its limit is {limit:g} m/s"
        )
    gain, most = value("full_acceleration"), value("full_acceleration_limit")
    if gain is not None and most and abs(gain) / most > full_acceleration_above * _ROUNDING:
        symptoms["full_acceleration"] = (
            f"the robot accelerates at {abs(gain):.3g} m/s², but its limit is {most:g} m/s²"
        )
    if symptoms:
        yield finding(
            driven.drive,
            f"at full command {' and '.join(symptoms.values())}",
            key=" ".join(symptoms),
        )


GOOD = [{"@robot": "rover"}]
BAD = [
    {
        "@robot": "rover",
        "@change": {
            'DiffDrive">': 'DiffDrive">  <!-- ^ TRI014 -->',
            "<wheel_radius>0.1<": "<wheel_radius>0.08<",
        },
    }
]
