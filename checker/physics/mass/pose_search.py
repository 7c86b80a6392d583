"""Search for the pose in which a joint holds most, with Pinocchio's generalized gravity."""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.physics.mass.floating_base import floating_base
from checker.physics.mass.pinocchio_model import PinModel, joint_label, pin_model

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    Array = NDArray[np.float64]

_STARTS = 8
_SWEEPS = 4
_LEAST = 1e-9
"""N·m or N: less is rounding."""


class JointLoad(Record, eq=False):
    """The largest load of a joint.

    Attributes:
        joint: The joint, which turns or slides along one axis.
        effort: N·m, of a sliding joint N.
        pose: Positions of the joints on which it depends, by their scoped names, rad or m: the
            joint, those behind it, then those in front of it.
    """

    joint: Joint
    effort: float
    pose: Mapping[str, float]


class _Coordinate(Record, eq=False):
    """A joint of Pinocchio's model that turns or slides along one axis.

    Attributes:
        name: Scoped name of the robot's joint.
        number: Its number in the model.
        position: Its number in a configuration.
        speed: Its number in a velocity.
        low: The lower limit, rad or m.
        high: The upper limit.
        turns: Whether it turns.
    """

    name: str
    number: int
    position: int
    speed: int
    low: float
    high: float
    turns: bool


class PoseSearch:
    """Search for poses, along one joint after another.

    The load of a joint is a sine of the angle of any other, and linear in its way: three values
    give the largest one in a range exactly, so that a few sweeps find a pose that no single joint
    improves. The joints of a floating base stay at 0, and have no load.
    """

    def __init__(self, robot: Robot, tool: str, payload: float) -> None:
        import numpy as np
        import pinocchio as pin

        floating = [name for name, link in robot.tree.links.items() if not link.gravity.value]
        built = pin_model(robot, floating)
        self.model = built.model
        self.model.gravity.linear = np.array((0.0, 0.0, -robot.gravity))
        if tool:
            frame = self.model.frames[self.model.getFrameId(tool)]
            mass = pin.Inertia(payload, frame.placement.translation, np.zeros((3, 3)))
            self.model.appendBodyToJoint(frame.parentJoint, mass, pin.SE3.Identity())
        self.data = self.model.createData()
        held = floating_base(robot)
        found = _coordinates(robot, built)
        self.coordinates = {each.name: each for each in found if each.name not in held}
        self.neutral = pin.neutral(self.model)

    def worst(self, joint: Joint) -> JointLoad:
        """Return the largest load of a joint."""
        chosen = self.coordinates[joint.scoped_name]
        numbers = [*self.model.subtrees[chosen.number], *self.model.supports[chosen.number]]
        by_number = {each.number: each for each in self.coordinates.values()}
        moving = [by_number[number] for number in dict.fromkeys(numbers) if number in by_number]
        dice = random.Random(0)  # noqa: S311 - starts of a search, the same each time
        best, at = 0.0, self.neutral
        for number in range(_STARTS):
            pose = self._start(moving, dice if number else None)
            effort = self._climb(pose, moving, chosen.speed)
            if abs(effort) > abs(best) + _LEAST:
                best, at = effort, pose
        return JointLoad(joint, abs(best), {each.name: float(at[each.position]) for each in moving})

    def _start(self, moving: Sequence[_Coordinate], dice: random.Random | None) -> Array:
        """Return the pose nearest to zero, or one at random."""
        pose: Array = self.neutral.copy()
        for each in moving:
            low, high = max(each.low, -math.pi), min(each.high, math.pi)
            nearest = min(max(0.0, each.low), each.high)
            pose[each.position] = dice.uniform(low, high) if dice and low < high else nearest
        return pose

    def _climb(self, pose: Array, moving: Sequence[_Coordinate], speed: int) -> float:
        """Move a pose to where one load is largest; return the load."""
        now = self._load(pose, speed)
        for _ in range(_SWEEPS):
            before = now
            for each in moving:
                now = self._best(pose, each, speed, now)
            if abs(now) <= abs(before) * (1 + 1e-6):
                break
        return now

    def _best(self, pose: Array, each: _Coordinate, speed: int, now: float) -> float:
        """Move one joint to where a load is largest; return the load."""
        best = pose[each.position]

        def load(position: float) -> float:
            pose[each.position] = position
            return self._load(pose, speed)

        for position in _candidates(each, load):
            if abs(new := load(position)) > abs(now) + _LEAST:
                now, best = new, position
        pose[each.position] = best
        return now

    def _load(self, pose: Array, speed: int) -> float:
        import pinocchio as pin

        return float(pin.computeGeneralizedGravity(self.model, self.data, pose)[speed])


def _candidates(each: _Coordinate, load: Callable[[float], float]) -> Iterator[float]:
    """Yield where a load may be largest: the ends of a range, and the extremes of its sine."""
    yield from (end for end in (each.low, each.high) if math.isfinite(end))
    if each.turns:
        first, second, third = (load(angle) for angle in (0.0, math.tau / 3, -math.tau / 3))
        # load(x) = c + a·cos x + b·sin x
        cosine, sine = (2 * first - second - third) / 3, (second - third) / math.sqrt(3)
        peak = math.atan2(sine, cosine)
        extremes = (peak + math.pi * turns for turns in range(-2, 3))
        # Nearest to 0 first: of equal loads, the first is kept.
        yield from (it for it in sorted(extremes, key=abs) if each.low <= it <= each.high)


def _coordinates(robot: Robot, built: PinModel) -> Iterator[_Coordinate]:
    for name, joint in robot.joints_by_name.items():
        label = joint_label(name, 0)
        if not built.model.existJointName(label) or len(joint.axes) != 1:
            continue
        number = built.model.getJointId(label)
        place, axis = built.model.joints[number], joint.axes[0]
        endless = joint.type.value == "continuous"
        low, high = (-math.inf, math.inf) if endless else (axis.lower.value, axis.upper.value)
        if place.nq == 1 and low <= high:
            turns = joint.type.value != "prismatic"
            yield _Coordinate(name, number, place.idx_q, place.idx_v, low, high, turns)
