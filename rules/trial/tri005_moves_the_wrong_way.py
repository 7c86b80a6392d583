"""A robot that drives or turns in the opposite direction.

A driver who steers away from a wall hits it. The axes of the wheels point to the right instead of
to the left, or left and right wheels are swapped in the plugin.

Fix: let wheels turn about an axis that points to the robot's left (`0 1 0` in its frame), and
name in `<left_joint>` the wheels at positive y.
Source: REP 103: x forward, y left, z up; a positive turn rate is counter-clockwise from above.
"""

from collections.abc import Iterator

from checker.model.components import Joint
from checker.model.locomotion.locomotion import Side
from checker.physics.trial.robot_trial import SettledTrial
from checker.rule import Concern, Findings, Severity, finding, rule


@rule(
    "TRI005",
    "moves-the-wrong-way",
    Severity.ERROR,
    Concern.ROBOT,
    judges=("yaw_rate", "speed_ratio"),
)
def check(driven: SettledTrial) -> Findings:
    """Report motion against the command."""
    symptoms = {}
    # The body of a robot that balances swings against its wheels: only its turn says something.
    if driven.drives_backwards and not driven.robot.balances:
        ratio, leg = driven.trial.value("speed_ratio") or 0.0, driven.leg("drive")
        speed = f" at {leg.linear:.3g} m/s" if leg else ""
        symptoms["speed_ratio"] = (
            f"commanded to drive forward{speed}, the robot drives backward ({ratio:.0%})"
        )
    if driven.turns_backwards:
        ratio = driven.trial.value("yaw_ratio") or 0.0
        symptoms["yaw_rate"] = f"commanded to turn left, the robot turns right ({ratio:.0%})"
    if symptoms:
        yield finding(
            driven.drive,
            "; ".join(symptoms.values()) + _cause(driven),
            key=" ".join(symptoms),
            related=_suspects(driven),
            covered_by=("GEO013",),
        )


def _cause(driven: SettledTrial) -> str:
    backwards = driven.drives_backwards
    if not backwards and any(_points_down(driven, joint) for joint in _steering_joints(driven)):
        return ": the axes of the steering joints point down"
    return _CAUSES[backwards, driven.turns_backwards]


def _steering_joints(driven: SettledTrial) -> Iterator[Joint]:
    for drive in driven.robot.locomotion.wheel_drives:
        yield from (joint for joint, _ in drive.steering)


def _points_down(driven: SettledTrial, joint: Joint) -> bool:
    axis = driven.robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
    return axis is not None and axis[2] < 0.0


_CAUSES = {
    (True, True): ": the wheels' axes are reversed",
    (False, True): ": left and right are swapped",
    (True, False): ": it faces backward, or its axes are reversed and its sides swapped",
}


def _suspects(driven: SettledTrial) -> Iterator[tuple[Joint, str]]:
    """Yield joints whose axis points the wrong way, and wheels whose stated side is wrong."""
    for joint in _steering_joints(driven):
        if _points_down(driven, joint):
            yield joint, f"the axis of {joint.name.value!r} points down"
    for wheel in driven.robot.locomotion.wheels:
        if wheel.axis is not None and wheel.axis[1] < 0.0:
            yield wheel.joint, f"the axis of {wheel.name.value!r} points to the right"
        if wheel.centre is not None and (wheel.centre[1] > 0.0) is not (wheel.side is Side.LEFT):
            yield wheel.joint, f"{wheel.name.value!r} is listed as a {wheel.side} wheel"


_MARK = {'DiffDrive">': 'DiffDrive">  <!-- ^ TRI005 -->'}
_LEFT_AND_RIGHT = {
    "0.2 0.1 0 0 0<": "0.3 0.1 0 0 0<",
    " -0.3 0.1": " 0.2 0.1",
    " 0.3 0.1": " -0.2 0.1",
}
GOOD = [{"@robot": "rover"}]
BAD = [
    {"@robot": "rover", "@change": {**_MARK, "0 1 0<": "0 -1 0<"}},
    {"@robot": "rover", "@change": _MARK | _LEFT_AND_RIGHT},
]
