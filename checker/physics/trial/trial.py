"""Measurements of a trial: data only, the same in the report's JSON."""

from __future__ import annotations

import math
import sys
from array import array
from base64 import b64decode, b64encode
from collections.abc import Mapping, Sequence
from typing import Any

import msgspec
from msgspec import field
from msgspec.structs import replace

from checker.base.record import Record


class Repair(Record):
    """A change that was needed so that the trial could run.

    Attributes:
        part: Scoped name of a link or joint of the robot.
        what: The change, as the end of a sentence: `has a zero principal moment, 1e-7 kg·m² taken`.
        serious: Whether MuJoCo refuses the model as written for it.
    """

    part: str
    what: str
    serious: bool = False


class Leg(Record):
    """A stretch of the course.

    Attributes:
        name: `settle`, `drive`, `stop after drive`, `turn`, `stop after turn`, `full speed`;
            `hover`, `climb` of copters; `hold` of legged robots and those without drive, and
            `joint by joint`, `all joints` where controllers move only joints.
        start: Seconds.
        end: Seconds.
        linear: Commanded forward speed (for `climb` the height rate), m/s.
        angular: Commanded turn rate, rad/s.
    """

    name: str
    start: float
    end: float
    linear: float = 0.0
    angular: float = 0.0


class Measurement(Record):
    """One figure.

    Attributes:
        name: The name, such as `speed_ratio`; the list is in
            `checker/physics/trial/measures/figures.py`.
        value: The value in the unit of the list; never NaN (a figure that is none is left out).
        part: Scoped name of the link or joint it is about; empty for the robot.
        other: Scoped name of the second part, for figures about pairs; `ground` for the ground.
    """

    name: str
    value: float
    part: str = ""
    other: str = ""


TORQUE, TORQUE_LIMIT, MOVE_TORQUE = "torque", "torque_limit", "move_torque"
"""Names of the figures of a joint that has a servo."""


def too_weak(figures: Sequence[Measurement]) -> tuple[str, ...]:
    """Return the joints whose largest torque is above their effort limit."""
    limits = {figure.part: figure.value for figure in figures if figure.name == TORQUE_LIMIT}
    largest = (figure for figure in figures if figure.name in (TORQUE, MOVE_TORQUE))
    weak = (it.part for it in largest if it.value > limits.get(it.part, math.inf))
    return tuple(dict.fromkeys(weak))


class Replay(Record):
    """Motion of the robot, for a replay in the report.

    Attributes:
        time: The time of each sample, seconds.
        poses: The poses by the scoped name of each link that moves by itself: position x, y, z
            (metres) and quaternion w, x, y, z of the link's frame in the world, flat, seven numbers
            a sample.
        carriers: Scoped name of the link in `poses` that carries it, for each other link.
    """

    time: tuple[float, ...]
    poses: Mapping[str, tuple[float, ...]]
    carriers: Mapping[str, str]

    def as_json(self) -> dict[str, Any]:
        """Return what JSON can express: the poses in single precision, little-endian, as base64."""
        return {
            "time": list(self.time),
            "poses": {name: _to_text(poses) for name, poses in self.poses.items()},
            "carriers": dict(self.carriers),
        }

    @classmethod
    def from_json(cls, data: Mapping[str, Any]) -> Replay:
        """Return the replay that `as_json` expressed.

        Raises:
            KeyError, TypeError, ValueError: It is no replay.
        """
        time = tuple(data["time"])
        poses = {name: _from_text(text) for name, text in data["poses"].items()}
        if any(len(pose) != POSE_NUMBERS * len(time) for pose in poses.values()):
            raise ValueError("a replay needs seven numbers a sample of each link")
        return cls(time, poses, dict(data["carriers"]))


def _to_text(numbers: Sequence[float]) -> str:
    return b64encode(_swapped(array("f", numbers)).tobytes()).decode("ascii")


def _from_text(text: str) -> tuple[float, ...]:
    numbers = array("f", b64decode(text))
    return tuple(_swapped(numbers))


def _swapped(numbers: array[float]) -> array[float]:
    """Turn the machine's order of bytes into little-endian, or back."""
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


POSE_NUMBERS = 7
"""Numbers of a pose in a replay: x, y, z, and the quaternion w, x, y, z."""


class Trial(Record):
    """The outcome of a trial.

    Attributes:
        drive: What was driven, a value of `DriveKind`.
        versions: The versions of MuJoCo and of the course, by name.
        legs: The course that was driven; empty when MuJoCo refused the model.
        measurements: All figures.
        repairs: What had to be changed.
        refused: MuJoCo's reason not to take the model even with repairs; empty if it did.
        refused_part: Scoped name of the link or joint that the reason is about; empty if unknown.
        trouble: Solver warnings and NaN, as ends of sentences; empty for a sound run.
        notes: What was left out of the trial and why, as sentences.
        moved: What was moved joint by joint: `6 joints by JointTrajectoryController 'arm'`.
        not_driven: The reason why a robot that can move was not driven, as the end of a sentence.
        series: Samples by name, all of one length: `time`, `x`, `y`, `z`, `roll`, `pitch`, `yaw`,
            `speed`, `yaw_rate`, `command_linear`, `command_angular`; `load:<link>` (N),
            `torque:<joint>` (N·m, the mean of the 0.1 s before), `joint:<joint>` (rad or m).
        replay: Its motion; None if nothing moved, and of robots of too many moving parts.
    """

    drive: str
    versions: Mapping[str, str] = field(default_factory=dict)
    legs: tuple[Leg, ...] = ()
    measurements: tuple[Measurement, ...] = ()
    repairs: tuple[Repair, ...] = ()
    refused: str = ""
    refused_part: str = ""
    trouble: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    moved: str = ""
    not_driven: str = ""
    series: Mapping[str, Sequence[float]] = field(default_factory=dict)
    replay: Replay | None = None

    def value(self, name: str, part: str = "") -> float | None:
        """Return a figure; None if it was not measured."""
        for measurement in self.measurements:
            if measurement.name == name and measurement.part == part:
                return measurement.value
        return None

    def all(self, name: str) -> tuple[Measurement, ...]:
        """Return the figures of one name, of every part they were measured for."""
        return tuple(measurement for measurement in self.measurements if measurement.name == name)

    def as_json(self) -> dict[str, Any]:
        """Return what JSON can express."""
        replay = self.replay.as_json() if self.replay is not None else None
        members: dict[str, Any] = msgspec.to_builtins(replace(self, replay=None))
        return {**members, "replay": replay}

    @classmethod
    def from_json(cls, members: Mapping[str, Any]) -> Trial:
        """Return the trial that `as_json` expressed.

        Raises:
            KeyError, TypeError, ValueError: It is no trial.
        """
        replay = members["replay"]
        trial = msgspec.convert({**members, "replay": None}, cls)
        return trial if replay is None else replace(trial, replay=Replay.from_json(replay))
