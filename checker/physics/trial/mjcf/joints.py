"""Joints of a scene by type: none, one or two degrees of freedom, or a ball."""

from __future__ import annotations

from checker.base.record import Record
from checker.model.components import Axis, Joint
from checker.model.geometry.transform import Vector
from checker.model.locomotion.classic import classic_joints
from checker.model.robot import Robot
from checker.physics.mass.mechanism import AXES, Freedom, Motion, motions_of
from checker.physics.trial.mjcf.names import LARGEST, clamp, numbers
from checker.physics.trial.mjcf.repairs import Ledger

_KINDS = {Freedom.TURN: "hinge", Freedom.SLIDE: "slide", Freedom.BALL: "ball"}
_ENDLESS = 1e6
"""Metres or radians that represent no bound where a joint is bounded on one side alone."""


class Degree(Record):
    """One joint of MuJoCo; coefficients in N, N·m and their quotients by m, rad, m/s, rad/s.

    Attributes:
        kind: `hinge`, `slide` or `ball`.
        axis: Direction in the robot's frame, of length 1; any for a ball.
        range: The range, metres or radians; None without limit.
        rest: The rest position of the spring, metres or radians.
    """

    kind: str
    axis: Vector
    range: tuple[float, float] | None = None
    damping: float = 0.0
    friction: float = 0.0
    stiffness: float = 0.0
    rest: float = 0.0

    def mjcf(self, axis: Vector) -> str:
        """Return the attributes of `<joint>`.

        Args:
            axis: The axis in the frame of the link.
        """
        text = f'type="{self.kind}" damping="{numbers([self.damping])}"'
        if self.kind == "ball":
            return text
        text += f' axis="{numbers(axis)}"'
        if self.range is not None:
            text += f' limited="true" range="{numbers(self.range)}"'
        if self.friction:
            text += f' frictionloss="{numbers([self.friction])}"'
        if self.stiffness:
            text += f' stiffness="{numbers([self.stiffness])}" springref="{numbers([self.rest])}"'
        return text


def degrees_of(robot: Robot, joint: Joint, ledger: Ledger) -> tuple[Degree, ...]:
    """Return the degrees of freedom of a joint; none if it is held fixed."""
    motions = motions_of(robot, joint)
    type = joint.type.value
    if type not in AXES and type != "fixed":
        ledger.note(f"Joints of type {type!r} are held fixed", joint.scoped_name)
    moving = {motion.number for motion in motions}
    for number in range(AXES.get(type, 0)):
        if number not in moving:
            _say_why_held(joint, number, ledger)
    return tuple(_degree(robot, joint, motion, ledger) for motion in motions)


def _say_why_held(joint: Joint, number: int, ledger: Ledger) -> None:
    name, which = joint.scoped_name, ("an axis", "a second axis")[number]
    if number >= len(joint.axes):
        ledger.repair(name, f"lacks {which} and is held fixed about it")
        return
    axis = joint.axes[number]
    if axis.lower.value == axis.upper.value and joint.type.value != "continuous":
        ledger.note("Joints whose limits allow no range are held fixed", name)
    elif all(part.value == 0.0 for part in axis.xyz):
        what = f"has {which} of length 0 and is held fixed about it"
        ledger.repair(name, what, serious=True)
    else:
        what = f"has {which} whose direction is not known and is held fixed about it"
        ledger.repair(name, what)


def _degree(robot: Robot, joint: Joint, motion: Motion, ledger: Ledger) -> Degree:
    kind = _KINDS[motion.freedom]
    # Gazebo, up to Harmonic, reads no damping of ball joints (gz-physics#634).
    if not joint.axes or motion.freedom is Freedom.BALL:
        return Degree(kind, motion.axis)
    axis = joint.axes[motion.number]
    return Degree(
        kind,
        motion.axis,
        None if joint.type.value == "continuous" else _range(joint.scoped_name, axis, ledger),
        _resistance(axis.damping.value),
        _friction(robot, joint, axis),
        _resistance(axis.stiffness.value),
        clamp(axis.spring_reference.value, -_ENDLESS, _ENDLESS, 0.0),
    )


def _friction(robot: Robot, joint: Joint, axis: Axis) -> float:
    """Return the friction of a joint; a drive plugin of Classic replaces it, its motor in ODE."""
    friction = _resistance(axis.friction.value)
    if not friction or joint.name.value in classic_joints(robot.all_plugins):
        return 0.0
    return friction


def _range(name: str, axis: Axis, ledger: Ledger) -> tuple[float, float] | None:
    low, high = axis.lower.value, axis.upper.value
    if not low < high:
        limits = f"a lower limit of {low:g} that is not below its upper limit of {high:g}"
        ledger.repair(name, f"has {limits}; both are left out", serious=True)
        return None
    if not low <= 0.0 <= high:
        ledger.note("Joints whose limits exclude 0 start at the nearest limit", name)
    low, high = max(low, -_ENDLESS), min(high, _ENDLESS)
    endless = low >= high or (low == -_ENDLESS and high == _ENDLESS)
    return None if endless else (low, high)


def _resistance(value: float) -> float:
    """Return a coefficient that resists motion; one that would drive it counts as none."""
    return clamp(value, 0.0, LARGEST, 0.0)
