"""Facts of the robots of a package, as `subt-check robot` shows them.

Lengths in m, masses in kg, angles in rad, and the units made of these. The JSON has the same
members in the same order.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

import msgspec
from msgspec import field

from checker.base.record import Record
from checker.report.launched import Launched

Numbers = tuple[float, ...]


class NotRead(Record):
    """A fact that could not be read, and the reason."""

    fact: str
    reason: str


class LinkFacts(Record):
    """A link.

    Attributes:
        mass_kg: None if it is not known.
        position_m: x, y, z of its frame in that of the robot; None if it is not known.
    """

    name: str
    mass_kg: float | None
    position_m: Numbers | None


class AxisFacts(Record):
    """An axis of a joint; None for a limit is none.

    Attributes:
        unit: `rad` or `m`: of both limits, and a second of the velocity.
        effort: N·m about the axis, or N along it.
    """

    xyz: Numbers
    unit: str
    lower: float | None
    upper: float | None
    velocity: float | None
    effort: float | None


class JointFacts(Record):
    """A joint.

    Attributes:
        parent: The link, or `world`; as written if there is none of this name.
        connected: Whether both ends exist.
        mimics: Joints that it follows.
        moved_by: The plugin that moves it; empty without one.
        commands: Command interfaces that its ros2_control hardware offers.
    """

    name: str
    type: str
    parent: str
    child: str
    connected: bool
    axes: tuple[AxisFacts, ...] = ()
    mimics: tuple[str, ...] = ()
    moved_by: str = ""
    commands: tuple[str, ...] = ()


class SensorFacts(Record):
    """A sensor.

    Attributes:
        on: The link or joint that carries it.
        rate_hz: None if it measures at each step of the simulation.
        topics: `*` represents the names of world and model.
        topic_is_stated: False if the topics are defaults.
        frame: The frame of its messages; empty if it is not stated, so that the simulator chooses.
    """

    name: str
    type: str
    on: str
    rate_hz: float | None
    topics: tuple[str, ...]
    topic_is_stated: bool
    frame: str


class DriveFacts(Record):
    """A plugin or controller that moves the robot.

    Attributes:
        by: The plugin or controller.
        moves: Names of the joints of wheels, rotors and legs, and of the links of tracks.
    """

    by: str
    moves: tuple[str, ...]
    wheel_separation_m: float | None = None
    wheel_radius_m: float | None = None
    max_velocity_m_s: float | None = None
    max_turn_rate_rad_s: float | None = None


class ControllerFacts(Record):
    """A controller of ros2_control or ROS 1, as parameter files configure it."""

    name: str
    type: str


class TopicFacts(Record):
    """A topic of a sensor or plugin in the simulator.

    Attributes:
        types: Its messages; several where a parameter decides.
        direction: `publishes`, `reads` or `both`.
        by: The sensor or plugin.
    """

    name: str
    types: tuple[str, ...]
    direction: str
    by: str


class FrameFacts(Record):
    """A `<frame>` of SDF; links are frames as well."""

    name: str
    attached_to: str


class RobotFacts(Record):
    """One robot.

    Attributes:
        file: The file that describes it, relative to the package.
        format: `sdf`, `urdf` or `mjcf`.
        overview: Its figures in the report: mass, size, counts of parts, drive.
        not_read: What is missing here, and why.
    """

    name: str
    file: str
    format: str
    overview: Mapping[str, Any]
    links: tuple[LinkFacts, ...]
    joints: tuple[JointFacts, ...]
    sensors: tuple[SensorFacts, ...]
    drives: tuple[DriveFacts, ...]
    controllers: tuple[ControllerFacts, ...]
    topics: tuple[TopicFacts, ...]
    frames: tuple[FrameFacts, ...]
    not_read: tuple[NotRead, ...] = ()


class PackageFacts(Record):
    """The robots of a package, and what its ROS 2 launch files start.

    Attributes:
        target: The profile, by which topics and frames are named.
        not_read: What of the package is missing here, and why.
    """

    name: str
    path: str
    target: str
    robots: tuple[RobotFacts, ...] = ()
    launched: tuple[Launched, ...] = ()
    not_read: tuple[NotRead, ...] = ()


class FactsJson(Record):
    """All of the JSON.

    Attributes:
        format: Version of this form; members are added without another one.
    """

    packages: tuple[PackageFacts, ...]
    format: int = field(default=1)


def facts_json(packages: tuple[PackageFacts, ...]) -> str:
    """Return the facts as JSON in plain ASCII."""
    return json.dumps(msgspec.to_builtins(FactsJson(packages)), indent=2) + "\n"
