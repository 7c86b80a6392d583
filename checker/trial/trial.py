"""What a trial measured: data only, the same in the report's JSON."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any


@dataclass(frozen=True)
class Repair:
    """A change that was needed so that the trial could go on.

    Attributes:
        part: Scoped name of a link or joint of the robot.
        what: The change, as the end of a sentence: `has a zero principal moment, 1e-7 kg·m² taken`.
        serious: Whether MuJoCo refuses the model as written for it.
    """

    part: str
    what: str
    serious: bool = False


@dataclass(frozen=True)
class Leg:
    """A stretch of the course.

    Attributes:
        name: `settle`, `drive`, `stop after drive`, `turn`, `stop after turn`, `full speed`;
            `hover`, `climb` of copters; `hold` of legged robots and those without drive.
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


@dataclass(frozen=True)
class Measurement:
    """One figure.

    Attributes:
        name: Such as `speed_ratio`; the list is in `checker/trial/measures.py`.
        value: In the unit that the list says; never NaN (a figure that is none is left out).
        part: Scoped name of the link or joint it is about; empty for the robot.
        other: Scoped name of the second part, for figures about pairs; `ground` for the ground.
    """

    name: str
    value: float
    part: str = ""
    other: str = ""


@dataclass(frozen=True)
class Replay:
    """How the robot moved, to be looked at.

    Attributes:
        time: Of each sample, seconds.
        poses: By the scoped name of each link that moves by itself: position x, y, z (metres) and
            quaternion w, x, y, z of the link's frame in the world, flat, seven numbers a sample.
        carriers: Scoped name of the link in `poses` that carries it, for each other link.
    """

    time: tuple[float, ...]
    poses: Mapping[str, tuple[float, ...]]
    carriers: Mapping[str, str]


@dataclass(frozen=True)
class Trial:
    """The outcome of a trial.

    Attributes:
        drive: What was driven, a value of `DriveKind`.
        versions: Of MuJoCo and of the course, by name.
        legs: The course that was driven; empty when MuJoCo refused the model.
        measurements: All figures.
        repairs: What had to be changed.
        refused: MuJoCo's reason not to take the model even with repairs; empty if it did.
        refused_part: Scoped name of the link or joint that the reason is about; empty if unknown.
        trouble: Solver warnings and NaN, as ends of sentences; empty for a sound run.
        notes: What was left out of the trial and why, as sentences.
        not_driven: Why a robot that has a drive was only let stand, as the end of a sentence.
        series: Samples by name, all of one length: `time`, `x`, `y`, `z`, `roll`, `pitch`, `yaw`,
            `speed`, `yaw_rate`, `command_linear`, `command_angular`; `load:<link>` (N),
            `torque:<joint>` (N·m), `joint:<joint>` (rad or m).
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
    not_driven: str = ""
    series: Mapping[str, Sequence[float]] = field(default_factory=dict)

    def value(self, name: str, part: str = "") -> float | None:
        """Return a figure; None when it was not measured."""
        for each in self.measurements:
            if each.name == name and each.part == part:
                return each.value
        return None

    def all(self, name: str) -> tuple[Measurement, ...]:
        """Return the figures of one name, of every part they were measured for."""
        return tuple(each for each in self.measurements if each.name == name)

    def as_json(self) -> dict[str, Any]:
        """Return what JSON can express."""
        return asdict(self)

    @classmethod
    def from_json(cls, said: Mapping[str, Any]) -> Trial:
        """Return the trial that `as_json` expressed.

        Raises:
            KeyError, TypeError: It is no trial.
        """
        return cls(
            drive=said["drive"],
            versions=dict(said["versions"]),
            legs=tuple(Leg(**each) for each in said["legs"]),
            measurements=tuple(Measurement(**each) for each in said["measurements"]),
            repairs=tuple(Repair(**each) for each in said["repairs"]),
            refused=said["refused"],
            refused_part=said["refused_part"],
            trouble=tuple(said["trouble"]),
            notes=tuple(said["notes"]),
            not_driven=said["not_driven"],
            series={name: tuple(values) for name, values in said["series"].items()},
        )
