"""A drive plugin without limits for velocity and acceleration.

Without limits the simulated robot starts, stops and drives as no real robot can. Reviewers reject a
robot without limits that match the real vehicle. ±1.79769e308 and ±1e16 mean "no limit".

Fix: state `<min_velocity>`, `<max_velocity>`, `<min_acceleration>` and `<max_acceleration>`; for a
TrackedVehicle below `<linear_velocity>`; for a MulticopterVelocityControl
`<maximumLinearVelocity>`, `<maximumLinearAcceleration>` and `<maximumAngularVelocity>`, each for x,
y and z.
Source: Model Migration Guide, checklist: velocity limits; parameters of Gazebo's drive systems.
"""

from collections.abc import Iterator

from checker.model.locomotion.motion_limits import (
    BoundedMotion,
    bounded_motions,
    is_unlimited,
)
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_LINEAR_ONLY = ("AckermannSteering", "TrackedVehicle")
"""Plugins whose turn rate follows from the speed, by the steering angle or the tracks."""

_COPTER_WORDS = {
    ("linear", "velocity"): "maximumLinearVelocity",
    ("linear", "acceleration"): "maximumLinearAcceleration",
    ("angular", "velocity"): "maximumAngularVelocity",
}


@rule("DRV002", "no-motion-limits", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report each motion of a drive that is not limited in both directions.

    An unlimited turn rate is a warning if the plugin limits the linear motion.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    unbounded: set[object] = set()
    for motion in bounded_motions(robot.locomotion):
        linear = motion.kind == "linear"
        if not linear and (motion.plugin.class_name in _LINEAR_ONLY or motion.plugin in unbounded):
            continue
        for fault in _unbounded_motions(motion):
            if linear:
                unbounded.add(motion.plugin)
            yield fault


def _unbounded_motions(motion: BoundedMotion) -> Iterator[Finding]:
    milder = motion.kind == "angular" and not motion.flies
    severity = Severity.WARNING if milder else Severity.ERROR
    missing = []
    for quantity, unit, ends in motion.quantities:
        for end, number in zip(("min", "max"), ends, strict=True):
            name = _parameter(motion, end, quantity)
            if number is None and name:
                missing.append(f"{name} ({unit})")
            elif number is not None and is_unlimited(number):
                yield _beyond(motion, name, number, unit, severity)
    if missing:
        names = ", ".join(dict.fromkeys(missing))
        yield finding(
            motion.limits.holder,
            f"{motion.plugin.class_name} states no {names}: its {motion.kind} motion is unlimited",
            severity=severity,
        )


def _beyond(
    motion: BoundedMotion, name: str, number: Located[float], unit: str, severity: Severity
) -> Finding:
    return finding(
        number,
        f"{name} of {motion.plugin.class_name} is {number.value:g} {unit}, which means no limit",
        severity=severity,
    )


def _parameter(motion: BoundedMotion, end: str, quantity: str) -> str:
    """Return the name of a parameter; nothing if the plugin has no such parameter."""
    if motion.flies:
        return _COPTER_WORDS.get((motion.kind, quantity), "")
    return f"{end}_{'angular_' if motion.kind == 'angular' else ''}{quantity}"


_SPEED = "<min_velocity>-1</min_velocity><max_velocity>1</max_velocity>"
_CHANGE = "<min_acceleration>-2</min_acceleration><max_acceleration>2</max_acceleration>"
_MARK = "  <!-- ^ DRV002 -->"


def _drive(name: str, *lines: str, mark: str = "") -> str:
    text = "\n  ".join(lines)
    return f"""
<plugin filename="libp.so" name="ignition::gazebo::systems::{name}">{mark}
  {text}
</plugin>
"""


_COPTER = (
    "<maximumLinearVelocity>4 4 4</maximumLinearVelocity>",
    "<maximumLinearAcceleration>3 3 3</maximumLinearAcceleration>",
    "<maximumAngularVelocity>3 3 3</maximumAngularVelocity>",
)

GOOD = [
    _drive("DiffDrive", _SPEED, _CHANGE),
    _drive(
        "DiffDrive",
        _SPEED.replace("_v", "_linear_v"),
        _CHANGE.replace("_a", "_linear_a"),
        _SPEED.replace("_v", "_angular_v"),
        _CHANGE.replace("_a", "_angular_a"),
    ),
    _drive("TrackedVehicle", f"<linear_velocity>{_SPEED}{_CHANGE}</linear_velocity>"),
    _drive("MulticopterVelocityControl", *_COPTER),
]
BAD = [
    _drive("DiffDrive", mark=_MARK),
    _drive("AckermannSteering", _SPEED, mark=_MARK),
    _drive("DiffDrive", f"<min_velocity>-1</min_velocity>{_CHANGE}", mark=_MARK),
    _drive(
        "DiffDrive",
        "<min_velocity>-1.79769e308</min_velocity>  <!-- ^ DRV002 -->",
        "<max_velocity>1e16</max_velocity>  <!-- ^ DRV002 -->",
        _CHANGE,
    ),
    _drive(
        "DiffDrive",
        _SPEED.replace("_v", "_linear_v"),
        _CHANGE.replace("_a", "_linear_a"),
        mark=_MARK,
    ),
    _drive("TrackedVehicle", _SPEED, _CHANGE, mark=_MARK),
    _drive("MulticopterVelocityControl", *_COPTER[1:], mark=_MARK),
    _drive("MulticopterVelocityControl", *_COPTER[:2], mark=_MARK),
]
