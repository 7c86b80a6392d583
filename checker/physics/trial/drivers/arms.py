"""Arms, hands and gimbals: joints that controllers move, and nothing else of the robot."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping

from msgspec.structs import replace

from checker.base.record import Record
from checker.base.words import and_list, count
from checker.model.components import Joint
from checker.model.locomotion.commanded_joints import Mover, commanded_joints, followers
from checker.model.robot import Robot
from checker.physics.mass.mechanism import AXES
from checker.physics.trial.course import CORNERS, MOVE, moving_legs
from checker.physics.trial.mjcf.names import clamp
from checker.physics.trial.plan import Movement, Plan
from checker.physics.trial.profile import FASTEST_OF_SMOOTH, Knots

_SHARE = 0.2
"""Share of its range that a joint moves from its start, at most."""
_FARTHEST_TURN, _FARTHEST_SLIDE = 0.3, 0.1
"""rad and m that it moves, at most: it stays in poses like the one that it starts in."""
_LEAST_SECONDS, _MOST_SECONDS = 1.0, 1.5
"""Time of this move, and of the same way back; a joint that is slower moves less."""
_TURNS = 10
"""Turns in which joints move, at most; of more joints, several move in one turn."""
_CORNER_SECONDS = 1.5
"""Time of each of the moves (`CORNERS`) of the path of all joints."""
_WIDER = 2.0
"""How far a joint moves on this path / alone, at most."""
_NAMED = 3
"""Controllers or joints in a sentence, at most."""


class _Step(Record):
    """A step of a joint towards the middle of its range.

    Attributes:
        way: rad or m.
        seconds: The time of it; twice with the way back.
        reach: How far the joint may move on the path of all joints, rad or m.
    """

    way: float
    seconds: float
    reach: float


def plan_arm(robot: Robot, hold: Plan) -> Plan | None:
    """Return the plan of a robot whose joints are moved; None if there are none to move.

    Args:
        robot: The robot.
        hold: Its plan if nothing moves: where its joints are held.
    """
    movers = commanded_joints(robot)
    tried = {
        joint.scoped_name: _step(joint, hold.places[joint.scoped_name][0][1])
        for joint in _movable(robot, movers)
        if joint.scoped_name in hold.places
    }
    steps = {name: step for name, step in tried.items() if step.way}
    if not steps:
        return None
    turns = [list(steps)[turn::_TURNS] for turn in range(min(_TURNS, len(steps)))]
    lasting = [max(steps[name].seconds for name in turn) for turn in turns]
    legs = moving_legs(2 * sum(lasting), CORNERS * _CORNER_SECONDS)
    moves = dict(_movements(robot, steps, hold))
    begins = next(leg.start for leg in legs if leg.name == MOVE)
    places = dict(hold.places)
    for turn, seconds in zip(turns, lasting, strict=True):
        for name, move in moves.items():
            if move.leader in turn:
                start = places[name][0][1]
                places[name] = _there_and_back(start, move.step, begins, seconds, legs[-1].end)
        begins += 2 * seconds
    still = [name for name in tried if name not in steps]
    return replace(
        hold,
        legs=legs,
        places=places,
        moves=moves,
        moved=_moved(movers[name] for name in steps),
        notes=(*hold.notes, *_why_still(still)),
    )


def _movable(robot: Robot, movers: Mapping[str, Mover]) -> Iterator[Joint]:
    """Yield commanded joints with one axis that turn no wheel and copy no commanded joint."""
    wheels = {wheel.scoped_name for wheel in robot.wheels}
    turning = {tie.joint.scoped_name for tie in robot.tree.ties if tie.child in wheels}
    copying = {name for name, it in followers(robot).items() if it.joint in movers}
    for name in movers:
        joint = robot.joints_by_name[name]
        if AXES.get(joint.type.value) == 1 and name not in turning | copying:
            yield joint


def _limits(joint: Joint) -> tuple[float, float]:
    """Return the limits of a joint, rad or m; none if it turns without an end."""
    axis = joint.axes[0]
    if joint.type.value == "continuous":
        return -math.inf, math.inf
    return axis.lower.value, axis.upper.value


def _step(joint: Joint, start: float) -> _Step:
    low, high = _limits(joint)
    farthest = _FARTHEST_SLIDE if joint.type.value == "prismatic" else _FARTHEST_TURN
    length = min(_SHARE * max(high - low, 0.0), farthest)
    stated = joint.axes[0].velocity.value
    fastest = stated if 0.0 <= stated < math.inf else math.inf
    least = FASTEST_OF_SMOOTH * length / fastest if fastest else math.inf
    seconds = min(max(least, _LEAST_SECONDS), _MOST_SECONDS)
    length = min(length, fastest * seconds / FASTEST_OF_SMOOTH)
    reach = min(_WIDER * length, fastest * _CORNER_SECONDS / FASTEST_OF_SMOOTH)
    back = start - low > high - start
    return _Step(-length if back else length, seconds, -reach if back else reach)


def _movements(
    robot: Robot, steps: Mapping[str, _Step], hold: Plan
) -> Iterator[tuple[str, Movement]]:
    """Yield the joints that move: those that are commanded, and those that copy them."""
    for name, step in steps.items():
        yield name, Movement(name, step.way, step.reach)
    for name, follower in followers(robot).items():
        leader = steps.get(follower.joint)
        if leader is not None and name in hold.places and name not in steps:
            start, (low, high) = hold.places[name][0][1], _limits(robot.joints_by_name[name])
            alone, together = (
                clamp(start + follower.ratio * way, low, high, start) - start
                for way in (leader.way, leader.reach)
            )
            yield name, Movement(follower.joint, alone, together)


def _there_and_back(start: float, step: float, begins: float, seconds: float, end: float) -> Knots:
    turns = begins + seconds
    moving = ((begins, start), (turns, start + step), (turns + seconds, start))
    return ((0.0, start), *moving, (end, start))


def _moved(movers: Iterable[Mover]) -> str:
    """Return how many joints the controllers and plugins of each class move."""
    of_kind: dict[str, list[str]] = {}
    for mover in movers:
        of_kind.setdefault(mover.kind, []).append(mover.name)
    named = [
        f"{count(len(names), 'joint')} by {_by(kind, list(dict.fromkeys(names)))}"
        for kind, names in of_kind.items()
    ]
    return and_list(named)


def _by(kind: str, names: list[str]) -> str:
    if len(names) > _NAMED or not names[0]:
        return kind if not names[0] else f"{len(names)} controllers of the class {kind}"
    return f"{kind} {and_list([repr(name) for name in names])}"


def _why_still(joints: list[str]) -> Iterator[str]:
    if joints:
        more = f" and {len(joints) - _NAMED} more" if len(joints) > _NAMED else ""
        named = ", ".join(joints[:_NAMED]) + more
        yield f"Their velocity limit or range is 0, so these joints are not moved: {named}."
