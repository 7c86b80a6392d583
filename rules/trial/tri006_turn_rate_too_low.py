"""A robot that turns far less than its wheels and loads predict.

Wheels in fixed directions slide sideways in a turn: a skid-steer robot turns slower than commanded.
How much slower depends on the places of its wheels and the load on each. If a robot turns far less
than that, something else brakes it.

Fix: look for a collision that drags on the ground, and for wheels that are tilted or do not turn.
Source: quasi-static balance of Coulomb friction over the wheels; it predicts the turn rate of 20 of
22 accepted skid-steer robots within 20 %.
"""

from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.rulebook.example_parts import rover


@rule("TRI006", "turn-rate-too-low", Severity.WARNING, Concern.ROBOT, judges=("yaw_of_predicted",))
def check(
    driven: SettledTrial, *, warning_below: float = 0.5, error_below_command: float = 0.05
) -> Findings:
    """Report a turn rate far below the predicted or the commanded one.

    A robot that is not written for Gazebo gets warnings only. One whose wheels cannot roll, since
    they are steered and rigid or spin about upright axes, is left to TRI003.

    Options:
        warning_below: Share of the turn rate that is predicted from the loads on wheels or tracks;
            less is a warning.
        error_below_command: Share of the commanded turn rate; less is an error, whatever the
            prediction.
    """
    trial = driven.trial
    rate, ratio = trial.value("yaw_rate"), trial.value("yaw_ratio")
    if driven.turns_backwards or driven.rigid_steering or driven.upright_wheels:
        return
    if rate is None or ratio is None:
        return
    command = f"commanded to turn at {rate / ratio:.3g} rad/s" if ratio else "told to turn"
    if ratio < error_below_command:
        yield finding(
            driven.drive,
            f"{command}, the robot hardly moves: {round(rate, 3) + 0.0:g} rad/s",
            severity=Severity.ERROR if driven.robot.is_for_gazebo else None,
            key="yaw_of_predicted",
        )
        return
    share, predicted = trial.value("yaw_of_predicted"), trial.value("yaw_predicted")
    if share is not None and predicted is not None and share < warning_below:
        yield finding(
            driven.drive,
            f"{command}, the robot turns at {rate:.2g} rad/s, but the places and loads of its "
            f"wheels predict {predicted:.2g} rad/s",
            key="yaw_of_predicted",
        )


GOOD = [rover(0.2, 0.2)]
BAD = [rover(0.6, 0.1, drive_mark="  <!-- ^ TRI006 -->")]
