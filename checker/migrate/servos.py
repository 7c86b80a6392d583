"""Joints that position controllers held in Gazebo 9, and that a system of Ignition holds now."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator

from checker.base.cache import NO_CACHE
from checker.base.record import Record
from checker.engine.subject import Subject
from checker.migrate.source import Source
from checker.model.control.controllers import Controller, ControlSystem
from checker.model.robot import Robot

_KIND = "JointPositionController"
_UNFIT = re.compile(r"\W+", re.ASCII)


class Servo(Record):
    """A JointPositionController.

    Attributes:
        joint: That it holds.
        topic: Below the robot's name.
        p: N·m/rad (or N/m).
        i: N·m/(rad·s).
        d: N·m·s/rad.
        effort: Greatest effort, N·m or N; 0 for none.
    """

    joint: str
    topic: str
    p: float
    i: float
    d: float
    effort: float


def servos_of(source: Source, robot: Robot) -> list[Servo]:
    """Return the joints of the new robot that the source's controllers hold at a position."""
    if source.package.only:
        return []
    subject = Subject(source.package, NO_CACHE)
    try:
        control = subject.control
    finally:
        subject.close()
    if not isinstance(control, ControlSystem):
        return []
    found: dict[str, Servo] = {}
    for joint, gains in _held(control.controllers):
        own = robot.joints_by_name.get(joint)
        if own is None or not own.axes or joint in found:
            continue
        effort = own.axes[0].effort.value
        limit = effort if math.isfinite(effort) and effort > 0.0 else 0.0
        topic = _UNFIT.sub("_", joint) + "_cmd"
        found[joint] = Servo(joint, topic, gains["p"], gains["i"], gains["d"], limit)
    return list(found.values())


def _held(controllers: Iterable[Controller]) -> Iterator[tuple[str, dict[str, float]]]:
    """Yield joints with their gains."""
    for controller in controllers:
        if controller.kind != _KIND:
            continue
        for joint, said in controller.gains.items():
            values = {name: said[name].value if name in said else 0.0 for name in "pid"}
            known = {
                name: 0.0 if x is None or not math.isfinite(x) else x for name, x in values.items()
            }
            yield joint.rpartition("/")[2], known
