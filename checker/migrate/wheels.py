"""The wheels that drive a robot: named by the author, by a plugin of Gazebo 9, or guessed."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence

from checker.base.record import Record
from checker.convert.conversion import CarriedPlugin
from checker.migrate.options import MigrationOptions, NotMigrated
from checker.model.components import Joint
from checker.model.locomotion.locomotion import Side, Wheel
from checker.model.locomotion.wheels import WheelReader, is_misaligned, tread
from checker.model.robot import Robot

_LEVEL = 0.2
"""Share of its radius by which a wheel may be above the lowest one."""
_ALIKE = 0.1
"""Share of the radius by which the wheels of a pair may differ in size and place."""
_ACROSS = 0.94
"""Cosine of the greatest angle, 20°, between a wheel's axis and the robot's y axis."""
_ROUND = 0.1
"""Share of its size by which a wheel's mesh may differ from a round one."""
_WORDS = ("wheel", "tyre", "tire")
_SEVERAL = 24
"""Wheels; a robot with more is not guessed at."""


class Wheels(Record, eq=False):
    """The wheels that turn to drive the robot.

    Attributes:
        left: The left wheels from front to rear.
        right: The right wheels from front to rear.
        reason: The way they were found, as the end of a sentence.
        steering: Joints that steer a wheel, driven or not: left, right; empty without.
    """

    left: tuple[Wheel, ...] = ()
    right: tuple[Wheel, ...] = ()
    reason: str = ""
    steering: tuple[Joint, ...] = ()

    @property
    def all(self) -> tuple[Wheel, ...]:
        """Both sides."""
        return (*self.left, *self.right)


def find_drive_wheels(
    robot: Robot, wishes: MigrationOptions, plugins: Sequence[CarriedPlugin], driven: frozenset[str]
) -> Wheels:
    """Find the wheels of the converted robot; none for a robot without any.

    Args:
        robot: The converted robot, with its meshes.
        wishes: What the author names.
        plugins: The plugins that drove it in Gazebo 9.
        driven: Joints with a transmission.

    Raises:
        NotMigrated: The author names a joint that does not exist, or it is unclear which wheels
            make pairs.
    """
    if wishes.left_wheels or wishes.right_wheels:
        return _named_wheels(robot, wishes.left_wheels, wishes.right_wheels, "from your options")
    for carried in plugins:
        left, right = _of_plugin(carried, robot)
        if left and right:
            reason = f"named by {carried.plugin.filename.value}"
            return _named_wheels(robot, left, right, reason)
    return _guessed(robot, driven)


def _named_wheels(robot: Robot, left: Iterable[str], right: Iterable[str], reason: str) -> Wheels:
    reader, knuckles = _reader(robot)
    sides = []
    for side, names in ((Side.LEFT, left), (Side.RIGHT, right)):
        wheels = []
        for name in names:
            joint = robot.joints_by_name.get(name)
            wheel = None if joint is None else reader.wheel_below(joint, side, knuckles)
            if wheel is None or wheel.axis is None or wheel.centre is None:
                raise NotMigrated(
                    f"{name!r} is not a joint that turns a wheel; joints that turn: "
                    f"{_turning(robot)}"
                )
            wheels.append(wheel)
        if not wheels:
            raise NotMigrated(
                f"no wheel on the {side} is named; give --left-wheels and --right-wheels"
            )
        sides.append(_front_first(wheels))
    return Wheels(sides[0], sides[1], reason, _steering(robot))


def _of_plugin(carried: CarriedPlugin, robot: Robot) -> tuple[list[str], list[str]]:
    """Return the joints that a plugin of Gazebo 9 names: `leftFrontJoint`, `right_joint`."""
    left: list[str] = []
    right: list[str] = []
    for child in carried.node:
        tag = child.tag.lower() if isinstance(child.tag, str) else ""
        if "joint" not in tag or "steer" in tag:
            continue
        for word in (child.text or "").replace(",", " ").split():
            name = word.rpartition("/")[2]
            if name in robot.joints_by_name:
                (left if "left" in tag else right if "right" in tag else []).append(name)
    return left, right


def _guessed(robot: Robot, driven: frozenset[str]) -> Wheels:
    wheels = list(_rolling(robot))
    motors = [wheel for wheel in wheels if wheel.joint.scoped_name in driven]
    chosen, reason = (motors, "their joints have transmissions") if motors else (wheels, "")
    left = [wheel for wheel in chosen if wheel.centre is not None and wheel.centre[1] > 0.0]
    right = [wheel for wheel in chosen if wheel.centre is not None and wheel.centre[1] < 0.0]
    pairs = [(one, other) for one in left for other in right if _are_a_pair(one, other)]
    if not chosen:
        return Wheels()
    paired = {id(wheel) for pair in pairs for wheel in pair}
    alone = [wheel for wheel in (*left, *right) if id(wheel) not in paired]
    if alone or not pairs or len(pairs) != len(left) or len(left) != len(right):
        raise NotMigrated(_unsure(left, right, alone))
    found = "round parts on continuous joints about their own axis"
    why = ", ".join(filter(None, (found, reason)))
    return Wheels(_front_first(left), _front_first(right), why, _steering(robot))


def _steering(robot: Robot) -> tuple[Joint, ...]:
    """Return the joints, left and right, that steer the foremost pair of wheels that is steered."""
    steered = [w for w in _rolling(robot) if w.steering is not None and w.centre is not None]
    front = _front_first(steered)
    left = next((w.steering for w in front if w.centre and w.centre[1] > 0.0), None)
    right = next((w.steering for w in front if w.centre and w.centre[1] < 0.0), None)
    return () if left is None or right is None else (left, right)


def _unsure(left: Sequence[Wheel], right: Sequence[Wheel], alone: Sequence[Wheel]) -> str:
    named = (
        f"{side}: {', '.join(w.joint.name.value for w in wheels) or 'none'}"
        for side, wheels in (("left", left), ("right", right))
    )
    odd = ", ".join(wheel.joint.name.value for wheel in alone)
    without = f"; without a partner: {odd}" if odd else ""
    return (
        f"it is unclear which wheels drive the robot ({'; '.join(named)}{without}); name their "
        "joints with --left-wheels and --right-wheels"
    )


def _rolling(robot: Robot) -> Iterator[Wheel]:
    """Yield what looks like a wheel, stands on the ground, and does not swivel."""
    reader, knuckles = _reader(robot)
    swivelling = {
        reader.child_of[joint]
        for joint in robot.joints
        if joint in reader.child_of and _is_upright(robot, joint) and _is_endless(joint)
    }
    wheels = []
    for joint in robot.joints[:_JOINTS_LIMIT]:
        if not _is_endless(joint) or reader.parent_of.get(joint) in swivelling:
            continue
        wheel = reader.wheel_below(joint, Side.LEFT, knuckles)
        if wheel is not None and wheel.radius and _lies_across(wheel) and _is_round(robot, wheel):
            wheels.append(wheel)
    low = min((_bottom(wheel) for wheel in wheels), default=0.0)
    on_ground = [w for w in wheels if _bottom(w) - low <= _LEVEL * (w.radius or 0.0)]
    yield from on_ground if len(on_ground) <= _SEVERAL else ()


_JOINTS_LIMIT = 2_000


def _is_endless(joint: Joint) -> bool:
    """Return whether a joint turns without end."""
    return joint.type.value in ("revolute", "continuous") and any(
        math.isinf(axis.lower.value) and math.isinf(axis.upper.value) for axis in joint.axes[:1]
    )


def _is_upright(robot: Robot, joint: Joint) -> bool:
    axis = robot.axis_in_model(joint, joint.axes[0]) if joint.axes else None
    return axis is not None and abs(axis[2]) > _ACROSS


def _lies_across(wheel: Wheel) -> bool:
    return wheel.axis is not None and abs(wheel.axis[1]) > _ACROSS


def _is_round(robot: Robot, wheel: Wheel) -> bool:
    """Return whether the wheel rolls on a shape that is round about its axis."""
    rolls = tread(robot, wheel)
    if rolls is None or is_misaligned(robot, wheel):
        return False
    if rolls.shape.geometry.shape in ("cylinder", "sphere", "capsule"):
        return True
    name = f"{wheel.joint.name.value} {wheel.link.name.value}".lower()
    high, low = rolls.box.high, rolls.box.low
    sides = (high[0] - low[0], high[2] - low[2])
    return any(word in name for word in _WORDS) and (
        rolls.shape.geometry.shape == "mesh" and abs(sides[0] - sides[1]) <= _ROUND * max(sides)
    )


def _bottom(wheel: Wheel) -> float:
    return (wheel.centre[2] if wheel.centre else 0.0) - (wheel.radius or 0.0)


def _are_a_pair(one: Wheel, other: Wheel) -> bool:
    if one.centre is None or other.centre is None or not one.radius or not other.radius:
        return False
    near = _ALIKE * one.radius
    return (
        abs(one.centre[0] - other.centre[0]) <= near
        and abs(one.centre[1] + other.centre[1]) <= max(near, _ALIKE * abs(one.centre[1]))
        and abs(one.radius - other.radius) <= near
    )


def _front_first(wheels: Iterable[Wheel]) -> tuple[Wheel, ...]:
    return tuple(sorted(wheels, key=lambda wheel: -wheel.centre[0] if wheel.centre else 0.0))


def _reader(robot: Robot) -> tuple[WheelReader, Mapping[str, Joint]]:
    """Return a reader of wheels, and the joints that steer by the link that each turns."""
    reader = WheelReader(robot)
    upright = (joint for joint in robot.joints if _is_upright(robot, joint))
    return reader, reader.knuckles(joint for joint in upright if not _is_endless(joint))


def _turning(robot: Robot) -> str:
    names = [joint.name.value for joint in robot.joints if joint.axes]
    return ", ".join(names[:20]) or "none"
