"""Actuators of an exported robot: which joint gets which, and the gains that its load needs."""

from __future__ import annotations

import enum
import math

from checker.base.record import Record
from checker.formats.urdf.description import motor_interfaces
from checker.model.components import Joint
from checker.model.locomotion.commanded_joints import commanded_joints, followers
from checker.model.locomotion.locomotion import DriveKind
from checker.model.robot import Robot
from checker.physics.mass.mechanism import AXES
from checker.physics.trial.home import Load
from checker.physics.trial.plan import Plan
from checker.physics.trial.run import TIMESTEP


class Drive(enum.StrEnum):
    """An actuator of MuJoCo, by its tag."""

    POSITION = "position"
    VELOCITY = "velocity"
    MOTOR = "motor"


_BY_INTERFACE = {
    "position": Drive.POSITION,
    "velocity": Drive.VELOCITY,
    "effort": Drive.MOTOR,
}
"""Drives by command interface; of several the first counts, which needs no controller outside."""
_BY_PLUGIN = {"ApplyJointForce": Drive.MOTOR, "JointController": Drive.VELOCITY}
_PASSIVE = ("caster", "castor")


def drives_of(robot: Robot, plan: Plan) -> dict[str, Drive]:
    """Return the actuator of each joint that has one, by scoped names.

    Joints that copy another one have none, and rotors, which their thrust drives.
    """
    interfaces = motor_interfaces(robot)
    commanded = {*interfaces, *commanded_joints(robot)}
    known = {*commanded, *robot.driven_joints}
    names = list(dict.fromkeys((*plan.speeds, *plan.places)))
    if known and robot.locomotion.kind is DriveKind.NONE:
        names = [name for name in names if name in known]
    rotors = {rotor.joint.scoped_name for rotor in robot.locomotion.rotors if rotor.joint}
    without = {*rotors, *followers(robot)}
    drives = {}
    for name in names:
        joint = robot.joints_by_name.get(name)
        if joint is None or name in without or not AXES.get(joint.type.value):
            continue
        if name not in known and any(word in name.lower() for word in _PASSIVE):
            continue
        # Some plugins only measure how far a spring gives way.
        if name not in commanded and joint.axes[0].stiffness.value > 0.0:
            continue
        drives[name] = _drive(robot, plan, joint, interfaces.get(name, set()))
    return drives


def _drive(robot: Robot, plan: Plan, joint: Joint, interfaces: set[str]) -> Drive:
    name = joint.scoped_name
    if name in plan.speeds:
        return Drive.VELOCITY
    for interface, drive in _BY_INTERFACE.items():
        if interface in interfaces:
            return drive
    if (plugin := robot.driven_joints.get(name)) is not None:
        return _BY_PLUGIN.get(plugin.class_name, Drive.POSITION)
    wheels = {wheel.name.value for wheel in robot.wheels}
    # The last joint of an arm may turn without end, and is put in place like the others.
    endless = joint.type.value == "continuous" and robot.stands_alone
    return Drive.VELOCITY if endless or joint.child.value in wheels else Drive.POSITION


FREQUENCY = 50.0
"""rad/s of a servo without load: a twentieth of the 1 / time step at which it would be unstable."""
_FASTEST = 250.0
"""rad/s that a servo never exceeds: half of 1 / time step."""
_SAG = {"hinge": 0.02, "slide": 0.002}
"""rad or m by which the weight of the robot may move a joint, in the worst pose."""
_FULL = {"hinge": 0.05, "slide": 0.005}
"""rad or m of error at which a servo exerts its effort limit; a smaller one gains nothing."""
_LOADED = {"hinge": 0.5, "slide": 0.05}
"""rad or m of error at which it exerts this limit at the latest: a soft gripper grips nothing."""
_CREEP_SECONDS = 0.1
"""Time constant, at most, of a servo against the damping of its joint alone."""
_SPEED_SECONDS = 0.02
"""Time constant of a servo that holds a speed."""
_FULL_SPEED = 0.5
"""rad/s or m/s of error at which such a servo exerts its effort limit."""


class Gains(Record):
    """Gains of a servo, N·m/rad and N·m·s/rad, or N/m and N·s/m; `stiffness` is 0 for a speed."""

    stiffness: float
    damping: float


def place_gains(load: Load, kind: str, effort: float, passive: float, friction: float) -> Gains:
    """Return the gains of a critically damped position servo.

    Args:
        load: What the joint carries.
        kind: `hinge` or `slide`.
        effort: The effort limit, N·m or N; inf without.
        passive: The damping of the joint itself.
        friction: The friction of the joint.
    """
    needed = max(
        load.inertia * FREQUENCY**2,
        (load.weight + friction) / _SAG[kind],
        passive / _CREEP_SECONDS,
        effort / _LOADED[kind] if math.isfinite(effort) else 0.0,
    )
    # What resists the motion counts like inertia within a time step.
    fastest = (load.felt + passive * TIMESTEP) * _FASTEST**2
    stiffness = min(needed, effort / _FULL[kind], fastest)
    damping = 2.0 * math.sqrt(stiffness * load.inertia) - passive
    return Gains(stiffness, max(damping, 0.0))


def speed_gain(load: Load, effort: float) -> float:
    """Return the gain of a servo that holds a speed."""
    return min(load.inertia / _SPEED_SECONDS, effort / _FULL_SPEED)
