"""Contacts with the ground, and parts of a robot inside each other.

Links that are fixed to each other count as one, and those that a joint ties may overlap: wheels sit
on hubs. How deep shapes are inside each other is the shift that would separate them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from checker.base.record import Record
from checker.physics.trial.mjcf.scene import GROUND, Scene
from checker.physics.trial.simulation.rig import Rig
from checker.physics.trial.trial import Measurement

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]
    Numbers = NDArray[np.int64]


# The contacts with the ground: copied while the robot drives, computed when it has stopped.


class Touches(Record):
    """Contacts in a stretch of time: n samples, and k contacts in their order.

    Attributes:
        names: Scoped names of the robot's links.
        time: The time of each sample, seconds (n).
        anchors: Positions of the joints with a servo in the robot's frame, metres (n × joints × 3).
        axes: Their axes, in the robot's frame (n × joints × 3).
        sample: The number of the sample of each contact (k).
        link: The number of the link of each contact (k).
        points: The points of contact in the robot's frame, metres (k × 3).
        loads: Normal forces, N (k).
        friction: Coefficients along the way of a wheel and along its axle; of other links, the same
            in both (k × 2).
        depth: Penetration, metres (k).
    """

    names: tuple[str, ...]
    time: Array
    anchors: Array
    axes: Array
    sample: Numbers
    link: Numbers
    points: Array
    loads: Array
    friction: Array
    depth: Array

    def between(self, start: float, end: float) -> Touches:
        """Return the contacts of a stretch of time, seconds, its end excluded."""
        import numpy as np

        first, behind = np.searchsorted(self.time, (start, end))
        samples = slice(first, behind)
        rows = slice(*np.searchsorted(self.sample, (first, behind)))
        return Touches(
            names=self.names,
            time=self.time[samples],
            anchors=self.anchors[samples],
            axes=self.axes[samples],
            sample=self.sample[rows] - first,
            link=self.link[rows],
            points=self.points[rows],
            loads=self.loads[rows],
            friction=self.friction[rows],
            depth=self.depth[rows],
        )


class _Copied(NamedTuple):
    """Arrays of MuJoCo after a step; each has a row for every contact, except where noted."""

    time: float
    place: Array
    turn: Array
    anchors: Array
    axes: Array
    geoms: Numbers
    points: Array
    friction: Array
    distance: Array
    address: Numbers
    forces: Array


@dataclass
class ContactLog:
    """Copies contacts, step by step: working them out together takes a fraction of the time."""

    _copied: list[_Copied] = field(default_factory=list)

    def add(self, rig: Rig, time: float) -> None:
        """Copy the contacts of MuJoCo's last step."""
        data, contact = rig.data, rig.data.contact
        self._copied.append(
            _Copied(
                time,
                data.xpos[rig.root].copy(),
                data.xmat[rig.root].copy(),
                data.xanchor[rig.joints],
                data.xaxis[rig.joints],
                contact.geom.copy(),
                contact.pos.copy(),
                contact.friction[:, :2].copy(),
                contact.dist.copy(),
                contact.efc_address.copy(),
                data.efc_force.copy(),
            )
        )

    def touches(self, rig: Rig) -> Touches:
        """Return all that was copied, in the frame that the robot had at each time."""
        import numpy as np

        # The same record, of columns.
        copied = _Copied._make(zip(*self._copied, strict=True))
        counts = [len(geom) for geom in copied.geoms]
        sample = np.repeat(np.arange(len(counts)), counts)
        behind = np.cumsum([0, *map(len, copied.forces)])
        address = np.concatenate(copied.address)
        # A contact that the solver left out has no force.
        used = address >= 0
        sample, row = sample[used], (behind[sample] + address)[used]
        place, turn = rig.frame(np.array(copied.place), np.array(copied.turn))
        points = np.concatenate(copied.points)[used] - place[sample]
        names = tuple(dict.fromkeys(rig.parts))
        numbers = np.array([names.index(part) for part in rig.parts])
        return Touches(
            names=names,
            time=np.array(copied.time),
            anchors=(np.array(copied.anchors) - place[:, None]) @ turn,
            axes=np.array(copied.axes) @ turn,
            sample=sample,
            # The ground is the first geom.
            link=numbers[np.concatenate(copied.geoms)[used].max(axis=1)],
            points=(points[:, None] @ turn[sample])[:, 0],
            loads=np.concatenate(copied.forces)[row],
            friction=np.concatenate(copied.friction)[used],
            depth=-np.concatenate(copied.distance)[used],
        )


Pair = tuple[str, str]

_LEAST = 1e-3
"""Metres; less is a matter of how shapes are rounded."""
_MOST_PAIRS = 30
_STEPS = 24
"""Steps of a joint through its range: 15° of a full turn."""
_EFFORT = 100_000
"""Shapes times poses that are looked at: about a second."""
_FULL_TURN = 2 * math.pi
_LONGEST = 10.0
"""Metres that a sliding joint is moved at most."""


def overlaps(query: ContactQuery) -> tuple[Measurement, ...]:
    """Return the overlaps of a robot at the start, and those that a joint's range adds."""
    at_start = query.depths()
    swept = query.swept_overlaps(already=at_start)
    left_out = (Measurement("unswept_joints", float(query.unswept)),) if query.unswept else ()
    overlapping = (*_measured("start_overlap", at_start), *_measured("sweep_overlap", swept))
    return (*overlapping, *left_out)


def _measured(name: str, depths: Mapping[Pair, float]) -> Iterator[Measurement]:
    deepest = sorted(depths.items(), key=lambda item: (-item[1], item[0]))
    for (first, second), depth in deepest[:_MOST_PAIRS]:
        yield Measurement(name, depth, first, second)


@dataclass
class ContactQuery:
    """Query for the parts of a robot that overlap, in poses of its joints.

    Attributes:
        unswept: Joints that `swept_overlaps` left out: with so many shapes it would take too long.
    """

    scene: Scene
    unswept: int = 0

    def __post_init__(self) -> None:
        import mujoco

        self.model = mujoco.MjModel.from_xml_string(self.scene.mjcf)
        self.model.geom_contype[:] = 1
        self.model.geom_conaffinity[:] = 1
        self.model.body_contype[:] = 1
        self.model.body_conaffinity[:] = 1
        self.data = mujoco.MjData(self.model)
        self.parts = [self._part(geom) for geom in range(self.model.ngeom)]
        self.pieces = [self.scene.welded.get(part, part) for part in self.parts]
        self.tied = {frozenset(pair) for pair in self.scene.tied}

    def depths(self, qpos: Array | None = None) -> dict[Pair, float]:
        """Return how deep pairs of links, or a link and the ground, are inside each other, metres.

        Args:
            qpos: The positions of the model; the pose at the start if none is given.
        """
        import mujoco

        self.data.qpos[:] = self.model.qpos0 if qpos is None else qpos
        mujoco.mj_kinematics(self.model, self.data)
        mujoco.mj_collision(self.model, self.data)
        deepest: dict[Pair, float] = {}
        geoms, distances = self.data.contact.geom.tolist(), self.data.contact.dist.tolist()
        for (one, two), distance in zip(geoms, distances, strict=True):
            if distance <= -_LEAST and self._counts(one, two):
                pair = self._pair(one, two)
                deepest[pair] = max(deepest.get(pair, 0.0), -distance)
        return deepest

    def pose(self, places: Mapping[str, float]) -> Array:
        """Return the positions of the model with joints at these places (rad or m), others at 0."""
        pose: Array = self.model.qpos0.copy()
        for joint, place in places.items():
            if joint in self.scene.joints:
                index = self.model.joint(self.scene.joints[joint]).id
                pose[self.model.jnt_qposadr[index]] = place
        return pose

    def swept_overlaps(self, already: Mapping[Pair, float]) -> dict[Pair, float]:
        """Return the deepest overlaps while one joint after another moves and all else rests.

        Args:
            already: Pairs that overlap at the start; nothing more is stated about them.
        """
        ranges = list(self._ranges())
        share = _EFFORT // max(self.model.ngeom * len(ranges), 1)
        steps = min(max(share, 4), _STEPS)
        most = _EFFORT // (self.model.ngeom * steps)
        self.unswept = max(len(ranges) - most, 0)
        deepest: dict[Pair, float] = {}
        for address, low, high in ranges[:most]:
            for step in range(steps + 1):
                pose = self.model.qpos0.copy()
                pose[address] = low + (high - low) * step / steps
                for pair, depth in self.depths(pose).items():
                    if pair not in already and GROUND not in pair:
                        deepest[pair] = max(deepest.get(pair, 0.0), depth)
        return deepest

    def _ranges(self) -> Iterator[tuple[int, float, float]]:
        """Yield where each joint to move is in `qpos`, and between which values it moves.

        Slides without limits are left out: nothing states how far they go.
        """
        import mujoco

        for joint in self.scene.swept:
            name = self.scene.joints[joint]
            for candidate in (name, f"{name}_2"):
                index = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_JOINT, candidate)
                if index < 0:
                    continue
                address = int(self.model.jnt_qposadr[index])
                slides = self.model.jnt_type[index] == mujoco.mjtJoint.mjJNT_SLIDE
                turns = self.model.jnt_type[index] == mujoco.mjtJoint.mjJNT_HINGE
                limited = bool(self.model.jnt_limited[index])
                low, high = (float(bound) for bound in self.model.jnt_range[index])
                if turns and not (limited and high - low < _FULL_TURN):
                    yield address, 0.0, _FULL_TURN
                elif limited and slides:
                    yield address, max(low, -_LONGEST), min(high, _LONGEST)
                elif limited:
                    yield address, low, high

    def _part(self, geom: int) -> str:
        name = self.model.geom(geom).name
        return self.scene.geoms.get(name, GROUND)

    def _pair(self, one: int, two: int) -> Pair:
        first, second = sorted((self.parts[one], self.parts[two]))
        return (second, first) if first == GROUND else (first, second)

    def _counts(self, one: int, two: int) -> bool:
        """Return whether two shapes are of parts that no joint ties directly."""
        first, second = self.pieces[one], self.pieces[two]
        return first != second and frozenset((first, second)) not in self.tied
