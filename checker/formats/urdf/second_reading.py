"""A URDF as yourdfpy reads it, compared with our own reading."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from checker.base.background import Background, Work, work_key
from checker.base.cache import Cache
from checker.base.child_process import Limits
from checker.base.extras import PHYSICS
from checker.base.parts import NotAvailable, WorkerFailed, part
from checker.base.record import Record
from checker.formats.urdf.description import UrdfDescription
from checker.model.components import Joint, Link
from checker.model.robot import Robot

_LIMITS = Limits(seconds=20.0, memory=1_000_000_000)
_KILOGRAMS = 1e-9
_METRES = 1e-6
"""Differences below it are ignored; also for entries of rotation matrices."""


class Difference(Record, eq=False):
    """Something that the two readers do not read alike.

    Attributes:
        part: A link or joint of our reading; the robot for what only the other one has.
        words: What yourdfpy reads, and what was expected: the end of a sentence.
    """

    part: Robot | Link | Joint
    words: str


class SecondReading(Record, eq=False):
    """A robot, and what yourdfpy reads from the same text.

    Attributes:
        robot: The robot as our reader has it.
        error: The reason why yourdfpy gives up; else empty.
        differences: The differences between the two.
    """

    robot: Robot
    error: str
    differences: tuple[Difference, ...]


@part
def second_readings(
    descriptions: tuple[UrdfDescription, ...], cache: Cache
) -> tuple[SecondReading, ...] | NotAvailable:
    """Return the robots of URDF files as yourdfpy reads them."""
    PHYSICS.require_for("a second reader of URDF")
    read = read_again([description.robot for description in descriptions], cache)
    return NotAvailable(f"yourdfpy {read.reason}") if isinstance(read, WorkerFailed) else read


def read_again(robots: Sequence[Robot], cache: Cache) -> tuple[SecondReading, ...] | WorkerFailed:
    """Read robots with yourdfpy in a child process, and compare."""
    texts = [robot.document.source.text for robot in robots]
    keys = [work_key([text], ["formats/urdf/yourdfpy_worker.py"], ["yourdfpy"]) for text in texts]
    items = {key: {"urdf": text} for key, text in zip(keys, texts, strict=True)}
    module = f"{__package__}.yourdfpy_worker"
    answers = Background(Work("yourdfpy", module, _LIMITS, items, _decoded), cache).results()
    readings = []
    for robot, key in zip(robots, keys, strict=True):
        answer = answers[key]
        if isinstance(answer, WorkerFailed):
            return answer
        readings.append(_reading(robot, answer))
    return tuple(readings)


def _decoded(answer: Any) -> dict[str, Any]:
    """Return an answer of the child, which may be compromised, after a look at its types."""
    if "error" in answer:
        return {"error": str(answer["error"])[:300]}
    links = {
        str(name): (
            None if link["mass"] is None else float(link["mass"]),
            [[float(number) for number in row] for row in link["pose"]],
        )
        for name, link in answer["links"].items()
    }
    return {"links": links, "joints": list(map(str, answer["joints"]))}


def _reading(robot: Robot, answer: dict[str, Any]) -> SecondReading:
    if "error" in answer:
        return SecondReading(robot, answer["error"], ())
    links, joints = answer["links"], answer["joints"]
    differences = (
        *_missing(robot, "link", set(links), robot.links_by_name),
        *_missing(robot, "joint", set(joints), robot.joints_by_name),
        *(it for name in links for it in _of_link(robot, name, *links[name])),
    )
    return SecondReading(robot, "", differences)


def _missing(
    robot: Robot, kind: str, theirs: set[str], ours: dict[str, Any]
) -> Iterator[Difference]:
    yield from (Difference(ours[name], f"reads no such {kind}") for name in ours.keys() - theirs)
    for name in sorted(theirs - ours.keys()):
        yield Difference(robot, f"reads a {kind} {name!r} that is not in the file")


def _of_link(
    robot: Robot, name: str, mass: float | None, pose: list[list[float]]
) -> Iterator[Difference]:
    link = robot.links_by_name.get(name)
    if link is None:
        return
    own = None if link.inertial is None else link.inertial.mass.value
    if (own is None) != (mass is None) or not math.isclose(own or 0, mass or 0, abs_tol=_KILOGRAMS):
        yield Difference(link, f"reads the mass {mass} kg instead of {own} kg")
    placed = robot.pose_of(name)
    if placed is None:
        return
    away = math.dist(placed.translation, [row[3] for row in pose])
    turned = max(math.dist(one, two[:3]) for one, two in zip(placed.rotation, pose, strict=True))
    if away > _METRES:
        yield Difference(link, f"places it {away:.3g} m away from where its joints place it")
    elif turned > _METRES:
        yield Difference(link, "turns it otherwise than its joints do")
