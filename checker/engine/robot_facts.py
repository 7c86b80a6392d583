"""Reads the facts of the robots of a package; what could not be read is stated with its reason."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from checker.base.allowance import Exceeded
from checker.base.extras import PHYSICS
from checker.base.parts import NotAvailable
from checker.base.words import count
from checker.engine.facts import ROBOTS_LIMIT, facts_of
from checker.engine.launched import launched_files_of
from checker.engine.mujoco_facts import model_facts
from checker.engine.part_facts import (
    drive_facts,
    joint_facts,
    link_facts,
    sensor_facts,
    topic_facts,
)
from checker.engine.subject import Subject
from checker.engine.unread_robots import unread_robots
from checker.model.mesh import MeshFault
from checker.model.robot import Robot
from checker.physics.compiled.model import CompiledModel
from checker.report.report import NO_PHYSICS
from checker.report.robot_facts import (
    ControllerFacts,
    FrameFacts,
    NotRead,
    PackageFacts,
    RobotFacts,
)
from checker.robots.urdf_files import UrdfFiles
from checker.ros.ros2_control.robot_control import RobotControl
from checker.ros.simulated_topics import unknown_owner
from checker.ros.wiring.classic import unknown_plugin
from checker.ros.wiring.wiring import Wiring
from checker.settings import Settings

_ROS_1 = "urdf"
"""The profile whose plugins name topics by parameters that no table has."""


def package_facts(subject: Subject, shown: str, settings: Settings) -> PackageFacts:
    """Return the facts of a package; those that a limit interrupts are stated as not read.

    Args:
        subject: The package.
        shown: Its path as the user would write it.
        settings: Its settings, with the target detected.
    """
    name, target = subject.package.name, settings.profile
    try:
        with subject.allowance.piece():
            robots, not_read = _robots(subject, settings)
            unwired = subject.all(Wiring)
            launched = launched_files_of(subject)
    except Exceeded as exceeded:
        return PackageFacts(name, shown, target, not_read=(NotRead("robots", exceeded.reason),))
    if isinstance(unwired, NotAvailable) and unwired.applicable:
        not_read = (*not_read, NotRead("launch files", unwired.reason))
    more = (NotRead(each.file, each.unknown) for each in launched if each.unknown)
    return PackageFacts(name, shown, target, robots, launched, (*not_read, *more))


def _robots(
    subject: Subject, settings: Settings
) -> tuple[tuple[RobotFacts, ...], tuple[NotRead, ...]]:
    robots = subject.all(Robot)
    not_read = [*_unread_files(subject)]
    if isinstance(robots, NotAvailable):
        models = subject.all(CompiledModel) if PHYSICS.is_installed else robots
        if not isinstance(models, NotAvailable):
            return tuple(map(model_facts, models[:ROBOTS_LIMIT])), ()
        reasons = [unread.reason for unread in unread_robots(subject)] or [robots.reason]
        return (), (*(NotRead("robots", reason) for reason in reasons), *not_read)
    if len(robots) > ROBOTS_LIMIT:
        more = f"only the first {ROBOTS_LIMIT} of {len(robots)} are shown"
        not_read.append(NotRead("robots", more))
    for robot in robots[:ROBOTS_LIMIT] if PHYSICS.is_installed else ():
        _ = robot.mesh_uses  # reads the meshes, which the size needs
    controls = subject.all(RobotControl)
    known = () if isinstance(controls, NotAvailable) else controls
    by_document = {id(control.robot.document): control for control in reversed(known)}
    facts = zip(robots, facts_of(subject), strict=False)
    found = (
        _robot(robot, overview, by_document.get(id(robot.document)), settings)
        for robot, overview in facts
    )
    return tuple(found), tuple(not_read)


def _unread_files(subject: Subject) -> Iterator[NotRead]:
    files = subject.one(UrdfFiles)
    if isinstance(files, UrdfFiles):
        for fault in files.faults:
            yield NotRead(fault.file, "it cannot be expanded")
        yield from (NotRead("a URDF file", reason) for reason in (*files.unread, *files.unused))


def _robot(
    robot: Robot, overview: Mapping[str, Any], control: RobotControl | None, settings: Settings
) -> RobotFacts:
    release = settings.judge_profile.context.release
    known_topics = settings.profile != _ROS_1
    unweighed = robot.unweighed
    shown = {name: value for name, value in overview.items() if name not in ("robot", "file")}
    if unweighed:
        shown.pop("mass_kg", None)
    return RobotFacts(
        robot.name.value,
        robot.document.source.file,
        robot.format,
        shown,
        tuple(link_facts(robot)),
        tuple(joint_facts(robot, control)),
        tuple(sensor_facts(robot, release, known_topics=known_topics)),
        tuple(drive_facts(robot)),
        tuple(ControllerFacts(each.name, each.type.value) for each in robot.controllers),
        tuple(topic_facts(robot, release)) if known_topics else (),
        tuple(FrameFacts(frame.scoped_name, frame.attached_to) for frame in robot.frames),
        tuple(_not_read(robot, shown, control, release, known_topics=known_topics)),
    )


def _not_read(
    robot: Robot,
    overview: Mapping[str, Any],
    control: RobotControl | None,
    release: str,
    *,
    known_topics: bool,
) -> Iterator[NotRead]:
    reasons = {
        "parts": robot.missing_parts,
        "mass": robot.unweighed,
        "size": "" if "size_m" in overview else _why_no_size(robot),
        "positions": robot.unplaced_part,
        "plugins": robot.unread_plugins,
        "drive": robot.locomotion.doubt,
        "topics": _unknown_topics(robot, release) if known_topics else _unnamed(robot),
        "values": _faults(robot),
    }
    yield from (NotRead(fact, reason) for fact, reason in reasons.items() if reason)
    for reason in control.unread if control is not None else ():
        yield NotRead("controllers", reason)
    for broken in robot.tree.broken:
        missing = f"no link is called {broken.missing.value!r}"
        yield NotRead(f"ends of joint {broken.joint.scoped_name}", missing)


def _why_no_size(robot: Robot) -> str:
    if not PHYSICS.is_installed and robot.file_uris:
        return NO_PHYSICS
    files = ((use.uri.value, use.file) for use in robot.mesh_uses)
    mesh = next((f"{uri} {it.reason}" for uri, it in files if isinstance(it, MeshFault)), "")
    shaped = any(link.collisions or link.visuals for link in robot.links)
    unknown = "the extent of a shape is not known" if shaped else "no link has a shape"
    return mesh or robot.unplaced_part or unknown


def _unknown_topics(robot: Robot, release: str) -> str:
    return unknown_plugin(robot) if release == "classic" else unknown_owner(robot)


def _unnamed(robot: Robot) -> str:
    return "those of plugins of ROS 1 are not known" if robot.all_plugins else ""


def _faults(robot: Robot) -> str:
    if not robot.faults:
        return ""
    first = robot.faults[0].message
    more = f"; {count(len(robot.faults) - 1, 'more fault')}" if len(robot.faults) > 1 else ""
    return f"{first}{more}"
