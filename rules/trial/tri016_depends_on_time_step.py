"""A robot that moves differently when the time step is halved.

The figures then depend on the solver, not on the robot: another simulator, or the next release of
this one, gives other figures. This rule runs with `--thorough` only.

Fix: look for parts that are too light for the load they carry, for wheels that hop, and for robots
that almost tip over.
Source: a sound simulation converges: half the step changes almost nothing.
"""

from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.measures.figures import MEASURES
from checker.physics.trial.robot_trial import RepeatedTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule
from checker.rulebook.example_parts import rover_with_spring

_MATTERS = {
    "settle_drop": 0.02,
    "settle_rise": 0.02,
    "settle_shift": 0.02,
    "settle_tilt": 0.05,
    "settle_speed": 0.05,
    "speed_ratio": 0.05,
    "path_sideways": 0.02,
    "path_heading": 0.035,
    "stop_speed": 0.05,
    "yaw_of_predicted": 0.2,
    "turn_drift": 0.2,
    "climbed": 0.2,
    "hold_tilt": 0.05,
}
"""Greatest change of a figure before another rule could judge it differently."""


@rule("TRI016", "depends-on-time-step", Severity.WARNING, Concern.ROBOT)
def check(driven: RepeatedTrial, *, factor: float = 1.0) -> Findings:
    """Report figures that change too much.

    Options:
        factor: Multiple of the allowed change of each figure at half the time step, such as 0.02 m
            of drop or 0.05 rad of tilt; more is reported.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    symptoms = []
    for name, matters in _MATTERS.items():
        once, again = driven.trial.value(name), driven.again.value(name)
        if once is not None and again is not None and abs(once - again) > factor * matters:
            measure = MEASURES[name]
            unit = f" {measure.unit}" if measure.unit else ""
            symptoms.append(
                f"{measure.label} changes from {round(once, 3):g}{unit} to "
                f"{round(again, 3):g}{unit}"
            )
    if driven.trial.trouble != driven.again.trouble:
        symptoms.append("the solver fails at only one of the two time steps")
    if symptoms:
        yield finding(driven.robot, f"at half the time step: {'; '.join(symptoms)}", key="again")


GOOD = [rover_with_spring(1e3, 0.0)]
BAD = [rover_with_spring(1e6, 1.0, "  <!-- ^ TRI016 -->")]
