"""A robot that does not drive straight when commanded to.

The robot drifts to one side: a wheel's collision is tilted, is smaller than the others, carries no
load or is missing, or the centre of mass is far to one side.

Fix: compare the wheels of both sides: radius, pose and friction of their collisions, their axes.
Source: a prototype trial of 60 accepted ground robots: all are straight to three decimals.
"""

import math

from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule


@rule(
    "TRI004",
    "path-not-straight",
    Severity.ERROR,
    Concern.ROBOT,
    judges=("path_sideways", "path_heading"),
)
def check(
    driven: SettledTrial,
    *,
    path_sideways_warning: float = 0.02,
    path_sideways_error: float = 0.1,
    path_heading_warning: float = 0.035,
    path_heading_error: float = 0.175,
    moved: float = 0.2,
) -> Findings:
    """Report a robot that leaves the straight line, or turns on it.

    Options:
        path_sideways_warning: Metres sideways for each metre forward; more is a warning.
        path_sideways_error: Metres sideways for each metre forward; more is an error instead of a
            warning.
        path_heading_warning: Radians by which the heading may change on the straight drive; more is
            a warning.
        path_heading_error: Radians of change in heading; more is an error instead of a warning.
        moved: Share of the commanded speed that the robot must reach for its sideways motion to be
            judged; the heading is always judged.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    speed = driven.trial.value("speed_ratio")
    heading = abs(driven.trial.value("path_heading") or 0.0)
    sideways = abs(driven.trial.value("path_sideways") or 0.0)
    if speed is None or abs(speed) < moved:
        sideways = 0.0
    symptoms = {}
    if sideways > path_sideways_warning:
        symptoms["path_sideways"] = (
            f"moves {sideways:.2g} m sideways for each metre forward, "
            f"expected at most {path_sideways_warning:g} m"
        )
    if heading > path_heading_warning:
        symptoms["path_heading"] = (
            f"turns by {math.degrees(heading):.1f}° on the straight drive, expected at most "
            f"{math.degrees(path_heading_warning):.0f}°"
        )
    if symptoms:
        grave = sideways > path_sideways_error or heading > path_heading_error
        yield finding(
            driven.drive,
            f"commanded to drive straight, the robot {'; it '.join(symptoms.values())}",
            severity=Severity.ERROR if grave else Severity.WARNING,
            key=" ".join(symptoms),
        )


_MARK = {'DiffDrive">': 'DiffDrive">  <!-- ^ TRI004 -->'}
_TYRE = '{}_tyre"><geometry><sphere><radius>{}<'
_SMALL = {_TYRE.format(name, 0.1): _TYRE.format(name, 0.095) for name in ("fl", "rl")}
GOOD = [{"@robot": "rover"}]
BAD = [{"@robot": "rover", "@change": _MARK | _SMALL}]
