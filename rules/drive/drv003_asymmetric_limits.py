"""Drive limits whose two ends differ in size, are zero or have the wrong sign.

A robot that drives at −2 to 3 m/s is rare; usually only one of the two figures was changed. A limit
of zero, or a minimum above zero, forbids a direction: the robot cannot reverse, or never stops. No
accepted package that we checked has this fault.

Fix: write the negated maximum as the minimum, unless measurements of the vehicle differ.
Source: parameters of Gazebo's drive systems; SubT review practice.
"""

from collections.abc import Iterator

from checker.model.locomotion.locomotion import MotionLimits
from checker.model.locomotion.motion_limits import Ends, bounded_motions
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked


@rule("DRV003", "asymmetric-limits", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot, *, tolerance: float = 0.001) -> Findings:
    """Compare the two ends of each limit.

    Options:
        tolerance: Share of the larger end by which the minimum and maximum of a limit may differ in
            size; more is reported.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    for what, ends in _limits(robot):
        yield from _uneven(what, ends, tolerance)


def _limits(robot: Robot) -> Iterator[tuple[str, Ends]]:
    motions = bounded_motions(robot.locomotion)
    for motion in (motion for motion in motions if not motion.both_kinds):
        for quantity, _, ends in motion.quantities:
            yield f"{quantity} of {motion.plugin.class_name}", ends
    for track in robot.locomotion.tracks:
        for quantity, ends in _of_track(track.limits):
            yield f"{quantity} of the track {track.link.name.value!r}", ends


def _of_track(limits: MotionLimits) -> Iterator[tuple[str, Ends]]:
    yield "velocity", (limits.min_velocity, limits.max_velocity)
    yield "acceleration", (limits.min_acceleration, limits.max_acceleration)


def _uneven(what: str, ends: Ends, tolerance: float) -> Iterator[Finding]:
    low, high = ends
    if high is not None and high.value <= 0:
        yield finding(high, f"maximum {what} is {high.value:g}, expected a positive number")
    elif low is not None and low.value >= 0:
        yield finding(low, f"minimum {what} is {low.value:g}, expected a negative number")
    elif low is None or high is None:
        return
    elif abs(low.value + high.value) > tolerance * max(-low.value, high.value):
        yield finding(
            low,
            f"{what} ranges from {low.value:g} to {high.value:g}: expected the same size both ways",
            related=[(high, "the other end")],
        )


_MARK = "  <!-- ^ DRV003 -->"


def _drive(low: str, high: str, mark: str = "", above: str = "") -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <min_velocity>{low}</min_velocity>{mark}
  <max_velocity>{high}</max_velocity>{above}
</plugin>
"""


def _copter(velocity: str) -> str:
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::MulticopterVelocityControl">
  <maximumLinearVelocity>{velocity}
</plugin>
"""


_END = "</maximumLinearVelocity>"

GOOD = [
    _drive("-2", "2"),
    _drive("-1.79769e308", "1.79769e308"),
    _drive("-1e16", "1e16"),
    _copter(f"4 4 2{_END}"),
]
BAD = [
    _drive("-2", "3", _MARK),
    _drive("0", "2", _MARK),
    _drive("2", "2", _MARK),
    _drive("-2", "0", above=_MARK),
    _copter(f"4 4 0{_END}{_MARK}"),
    """
<plugin filename="libp.so" name="ignition::gazebo::systems::TrackController">
  <link>base_link</link>
  <min_velocity>-1</min_velocity>  <!-- ^ DRV003 -->
  <max_velocity>2</max_velocity>
</plugin>
""",
]
