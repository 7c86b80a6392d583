"""Facts of the parts of a robot: links, joints, sensors, drives and topics."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

from checker.launch.ros1.bridge import Direction
from checker.model.components import Axis, Joint, Sensor
from checker.model.geometry.transform import Transform
from checker.model.locomotion.locomotion import MotionLimits, WheelDrive
from checker.model.robot import Robot
from checker.model.sensing.kind import stated_frame
from checker.report.robot_facts import (
    AxisFacts,
    DriveFacts,
    JointFacts,
    LinkFacts,
    Numbers,
    SensorFacts,
    TopicFacts,
)
from checker.ros.ros2_control.robot_control import RobotControl
from checker.ros.simulated_topics import likely_topics, topics_of_sensors
from checker.ros.wiring.classic import classic_endpoints

_DIGITS = 6
_CLASSIC_FRAMES = ("frame_name", "frameName")
_DIRECTIONS = {
    Direction.TO_ROS: "publishes",
    Direction.TO_IGN: "reads",
    Direction.BOTH: "both",
}
_MOVING = ("revolute", "continuous", "prismatic", "screw", "revolute2", "universal", "gearbox")
"""Types of joints whose axis counts; others have one that nothing reads."""


def rounded(value: float) -> float | None:
    """Return a number with as many digits as can be distinguished; None if it is not finite."""
    return float(f"{value:.{_DIGITS}g}") if math.isfinite(value) else None


def link_facts(robot: Robot) -> Iterator[LinkFacts]:
    """Yield the links in the order of the file."""
    for link in robot.links:
        name = link.scoped_name
        mass = None if name in robot.unknown_masses else rounded(link.mass)
        yield LinkFacts(name, mass, _position(robot.pose_of(name)))


def _position(pose: Transform | None) -> Numbers | None:
    numbers = [] if pose is None else [rounded(value) for value in pose.translation]
    known = [number for number in numbers if number is not None]
    return tuple(number + 0.0 for number in known) if len(known) == 3 else None


def joint_facts(robot: Robot, control: RobotControl | None) -> Iterator[JointFacts]:
    """Yield the joints in the order of the file."""
    ends = {id(tie.joint): (tie.parent, tie.child) for tie in robot.tree.ties}
    for joint in robot.joints:
        parent, child = ends.get(id(joint), (joint.parent.value, joint.child.value))
        mover = robot.driven_joints.get(joint.scoped_name)
        driven = control.joints.get(joint.scoped_name) if control is not None else None
        yield JointFacts(
            joint.scoped_name,
            joint.type.value,
            parent,
            child,
            id(joint) in ends,
            tuple(_axis(joint, axis) for axis in joint.axes if joint.type.value in _MOVING),
            tuple(name.value for name in joint.mimics),
            mover.label if mover is not None else "",
            tuple(it.name.value for it in driven.commands) if driven is not None else (),
        )


def _axis(joint: Joint, axis: Axis) -> AxisFacts:
    limits = axis.lower, axis.upper, axis.velocity, axis.effort
    return AxisFacts(
        tuple(rounded(number.value) or 0.0 for number in axis.xyz),
        "m" if joint.type.value == "prismatic" else "rad",
        *(rounded(limit.value) for limit in limits),
    )


def sensor_facts(robot: Robot, release: str, *, known_topics: bool = True) -> Iterator[SensorFacts]:
    """Yield the sensors of links, then those of joints."""
    is_classic = release == "classic"
    topics = _classic_topics(robot) if is_classic else topics_of_sensors(robot)
    for sensor in robot.sensors:
        rate = sensor.update_rate.value
        yield SensorFacts(
            sensor.name.value,
            sensor.type.value,
            sensor.link,
            rounded(rate) if rate else None,
            topics[id(sensor)] if known_topics else (),
            is_classic or sensor.topic.stated,
            _frame(sensor, release),
        )


def _classic_topics(robot: Robot) -> Mapping[int, tuple[str, ...]]:
    """Return what the plugins of each sensor publish in Gazebo Classic."""
    published: dict[int, list[str]] = {}
    for end in classic_endpoints(robot):
        if end.publishes:
            published.setdefault(id(end.owner), []).append(end.topic)
    return {
        id(sensor): tuple(it for plugin in sensor.plugins for it in published.get(id(plugin), ()))
        for sensor in robot.sensors
    }


def _frame(sensor: Sensor, release: str) -> str:
    if release == "classic":
        named = (
            it.value
            for plugin in sensor.plugins
            for tag in _CLASSIC_FRAMES
            for it in plugin.at(tag)
        )
        return next((name.strip() for name in named if name.strip()), "")
    stated = stated_frame(sensor.element, release)
    return stated.value.strip() if stated is not None else ""


def drive_facts(robot: Robot) -> Iterator[DriveFacts]:
    """Yield what moves the robot on wheels, tracks, rotors and legs."""
    moving = robot.locomotion
    for drive in moving.drives:
        yield _wheel_drive(drive)
    for tracked in moving.tracked_drives:
        links = tuple(track.link.scoped_name for track in tracked.tracks)
        separation = rounded(tracked.separation.value)
        speeds = _speed(tracked.linear), _speed(tracked.angular)
        yield DriveFacts(tracked.plugin.label, links, separation, None, *speeds)
    for rotor in moving.rotors:
        yield DriveFacts(rotor.plugin.label, (rotor.name.value,))
    if moving.leg_joints:
        yield DriveFacts("legs", tuple(joint.scoped_name for joint in moving.leg_joints))


def _wheel_drive(drive: WheelDrive) -> DriveFacts:
    return DriveFacts(
        drive.plugin.label,
        tuple(dict.fromkeys(wheel.name.value for wheel in drive.wheels)),
        rounded(drive.wheel_separation.value),
        rounded(drive.wheel_radius.value),
        _speed(drive.linear),
        _speed(drive.angular),
    )


def _speed(limits: MotionLimits) -> float | None:
    return rounded(limits.max_velocity.value) if limits.max_velocity is not None else None


def topic_facts(robot: Robot, release: str) -> Iterator[TopicFacts]:
    """Yield the topics of sensors and plugins that are known, in the simulator's own names."""
    if release == "classic":
        for end in classic_endpoints(robot):
            way = "publishes" if end.publishes else "reads"
            yield TopicFacts(end.topic, end.types, way, end.by)
        return
    for topic in likely_topics(robot):
        way = _DIRECTIONS[topic.direction]
        yield TopicFacts(topic.topic, topic.messages, way, topic.owner_name)
