"""A robot that moves away while it turns in place.

Path planners assume that the robot turns in place; in a narrow passage it hits the wall. A robot
with wheels in fixed directions turns about a point that depends on its loads: its centre of mass
should be in the middle of its wheels.

Fix: move heavy parts, such as the battery, so that the centre of mass is in the middle of the
wheels; if the real robot drifts too, say so in specifications.md.
Source: quasi-static balance of Coulomb friction at the contact points with their loads.
"""

from checker.base.words import beyond
from checker.model.locomotion.balancing import NOT_RUN
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, Unchecked, finding, rule
from checker.rulebook.example_parts import rover


@rule("TRI018", "drifts-while-turning", Severity.WARNING, Concern.ROBOT, judges=("turn_drift",))
def check(driven: SettledTrial, *, warning_above: float = 0.5) -> Findings:
    """Report a robot that moves away while it turns in place.

    Options:
        warning_above: Metres that the middle of the wheels or tracks may move away from its place
            at the start of the turn; more is reported.
    """
    if driven.robot.balances:
        yield Unchecked(NOT_RUN, Severity.WARNING)
        return
    drift = driven.trial.value("turn_drift")
    if drift is None or drift <= warning_above:
        return
    yield finding(
        driven.drive,
        f"the robot drifts {beyond(drift, warning_above)} m while turning in place, expected "
        f"at most {warning_above:g} m" + _cause(driven, drift),
        key="turn_drift",
    )


def _cause(driven: SettledTrial, drift: float) -> str:
    explained = driven.trial.value("turn_drift_explained")
    side, front = (driven.trial.value(f"com_offset_{way}") for way in ("side", "front"))
    if explained is None or side is None or front is None:
        return ""
    if explained < _MOST * drift:
        return f": its centre of mass explains {explained:.2g} m of it; the rest has another cause"
    where = [
        f"{abs(offset) * 1000:.0f} mm {ahead if offset > 0 else behind}"
        for offset, ahead, behind in ((side, "left of", "right of"), (front, "before", "behind"))
        if abs(offset) > _SMALL
    ]
    place = " and ".join(where) or "near"
    return f": the centre of mass {place} the middle of the wheels explains {explained:.2g} m of it"


_MOST = 0.5
_SMALL = 0.005
"""Metres that do not matter."""


def _rover(offset: float, mark: str = "") -> str:
    return rover(0.4, 0.3, centre=f"{offset} 0 0", speed=2, drive_mark=mark)


GOOD = [_rover(0.0)]
BAD = [_rover(0.4, "  <!-- ^ TRI018 -->")]
