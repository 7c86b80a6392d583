"""The reason why the trial does not drive a robot, with the plugin or controller that moves it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from checker.base.words import and_list, count
from checker.model.locomotion.commanded_joints import has_own_joints, moving_controllers
from checker.model.locomotion.controlled import DRIVING_CONTROLLERS
from checker.model.locomotion.drive import WING_CLASSES, body_velocity
from checker.model.locomotion.locomotion import DriveKind, Locomotion
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot

_WATER = frozenset({"Buoyancy", "BuoyancyEngine", "Hydrodynamics", "Thruster"})
"""Plugin classes of what swims."""

_PUSHES = "gazebo_ros_force"
"""Library of a plugin that pushes a body."""

_NAMED = 3
"""Names in a sentence, at most."""


def reason_not_driven(robot: Robot, locomotion: Locomotion) -> str:
    """Return why a robot without a drive is not driven; empty if nothing shows that it moves."""
    untried = reason_not_tried(robot, locomotion)
    if untried or locomotion.kind is DriveKind.LEGGED:
        return untried
    return next(_reasons(robot, locomotion), "")


def reason_not_tried(robot: Robot, locomotion: Locomotion) -> str:
    """Return why a robot moves in a way that the trial does not try; empty without such a way."""
    classes = {plugin.class_name for plugin in robot.all_plugins}
    if classes & _WATER:
        return "it swims, and water is not simulated"
    if classes & set(WING_CLASSES) or locomotion.rotors:
        return "it flies on wings or blades, and air is not simulated"
    if locomotion.kind is DriveKind.LEGGED:
        return ""
    return locomotion.doubt or next(_drives(robot), "")


def moved_as_a_whole(mover: str) -> str:
    """Return why a robot is not driven whose body a plugin moves."""
    return f"{mover} sets the body's velocity: there is nothing to drive"


def _drives(robot: Robot) -> Iterator[str]:
    """Yield what moves the robot as a whole, with the reason why it is not driven."""
    for plugin in robot.all_plugins:
        if mover := body_velocity(plugin):
            yield moved_as_a_whole(mover)
        elif _PUSHES in (library_stem(plugin.filename.value), plugin.class_name):
            yield f"{_PUSHES} pushes the body: there is nothing to drive"
    for controller in moving_controllers(robot):
        if controller.class_name in DRIVING_CONTROLLERS:
            what = "names no wheel of the model, or gives its wheels no radius"
            yield f"the {controller.class_name} {controller.name!r} {what}"


def _reasons(robot: Robot, locomotion: Locomotion) -> Iterator[str]:
    """Yield the other reasons, the most certain one first."""
    if moving := moving_controllers(robot):
        what = "names no joint of the model that can be moved"
        if moving[0].joints_without_gains:
            what = "has gains of 0 for its joints, so it moves none of them"
        elif has_own_joints(moving[0], robot):
            what = "commands joints in a way that the trial does not know"
        yield f"the {moving[0].class_name} {moving[0].name!r} {what}"
    if robot.element.child("ros2_control") is not None:
        joints = [j for system in robot.element.all("ros2_control") for j in system.all("joint")]
        hardware = f"ros2_control has the hardware of {count(len(joints), 'joint')}"
        yield f"{hardware}, and the package configures no controller that moves them"
    if robot.driven_joints:
        yield _moved_by(plugin.class_name for plugin in robot.driven_joints.values())
    if transmissions := len(robot.element.all("transmission")):
        has = f"it has {count(transmissions, 'transmission')}"
        yield f"{has} for controllers of ROS 1, and the package loads none that moves it"
    if robot.driven_in:
        yield f"its drive is in {robot.driven_in}, which describes the same robot for Gazebo"
    wheels = [wheel.link.name.value for wheel in locomotion.undriven if wheel.steering is None]
    if wheels:
        named = f"its wheels {and_list(wheels)}" if len(wheels) <= _NAMED else "its wheels"
        yield f"its file and the parameters of its controllers name nothing that turns {named}"


def _moved_by(classes: Iterable[str]) -> str:
    names = sorted(set(classes))
    moved = and_list(names) if len(names) <= _NAMED else f"{len(names)} kinds of controllers"
    return f"its joints are moved by {moved}; none of these is a drive, and the trial holds them"
