"""Parts of robots that an element of a file describes, and parts by their names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property

from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.editor.name_kinds import is_srdf
from checker.editor.names.mention import NameKind
from checker.engine.subject import Subject
from checker.formats.sdf.includes import ModelIncludes
from checker.formats.sdf.reader import read_sdf
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.reader import read_urdf
from checker.formats.xacro.expanded import ExpandedText
from checker.model.components import Frame, Joint, Link, Model, Part, Plugin, Sensor
from checker.model.robot import Robot
from checker.model.world import World
from checker.source.xml import Element, XmlDocument

NamedPart = Robot | Link | Joint | Frame | Model | Sensor | Plugin


class RobotPart(Record, eq=False):
    """A part and the robot that it belongs to."""

    robot: Robot
    part: NamedPart


class RobotParts(Record, eq=False, dict=True):
    """The parts of robots by the elements that a person wrote.

    Attributes:
        robots: The robots that count.
    """

    robots: tuple[Robot, ...]

    def parts_of(self, element: Element) -> Sequence[RobotPart]:
        """Return the parts that an element describes: several where a macro is called again."""
        return self._by_element.get(element, ())

    @cached_property
    def _by_element(self) -> Mapping[Element, Sequence[RobotPart]]:
        parts: dict[Element, list[RobotPart]] = {}
        for robot in self.robots:
            for part in parts_of(robot):
                parts.setdefault(part.element.written, []).append(RobotPart(robot, part))
        return parts

    def copies_of(self, element: Element) -> Iterator[Element]:
        """Yield what xacro made of an element; nothing for one that xacro did not read."""
        for robot in self.robots:
            for copy in robot.document.elements:
                if copy.written is element and copy is not element:
                    yield copy

    def part_named(
        self, name: str, kinds: Iterable[NameKind], scopes: Sequence[str] = ("",)
    ) -> RobotPart | None:
        """Return the part that has a name; the first of the kinds that has one.

        Args:
            name: The name as written.
            kinds: What it may be.
            scopes: What may be in front of it in a scoped name, the likeliest first.
        """
        for kind in kinds:
            for robot in self.robots:
                known = _by_name(robot, kind)
                for scope in scopes:
                    if (part := known.get(scope + name)) is not None:
                        return RobotPart(robot, part)
        return None

    def names(self, kind: NameKind) -> Iterator[tuple[str, RobotPart]]:
        """Yield the scoped names of all parts of a kind."""
        for robot in self.robots:
            for name, part in _by_name(robot, kind).items():
                yield name, RobotPart(robot, part)


def parts_of(robot: Robot) -> Iterator[NamedPart]:
    """Yield a robot and its named parts."""
    yield robot
    yield from robot.links
    yield from robot.joints
    yield from robot.frames
    yield from robot.models
    yield from robot.sensors
    yield from robot.all_plugins


def _by_name(robot: Robot, kind: NameKind) -> Mapping[str, NamedPart]:
    match kind:
        case NameKind.LINK:
            return robot.links_by_name
        case NameKind.JOINT:
            return robot.joints_by_name
        case NameKind.SENSOR:
            return {sensor.name.value: sensor for sensor in reversed(robot.sensors)}
        case NameKind.FRAME:
            return {frame.scoped_name: frame for frame in robot.frames}
        case NameKind.MODEL:
            return {model.scoped_name: model for model in robot.models}
        case _:
            return {}


def robot_parts(subject: Subject, path: str) -> RobotParts:
    """Return the parts of the robots that a file of a package is about.

    Args:
        subject: The package.
        path: The path of the file. A model that is none of the package's robots is read by itself;
            a file that describes no part of any robot is about all of them.
    """
    robots = (*package_robots(subject),)
    document = subject.package.xml(path)
    if not isinstance(document, XmlDocument):
        return RobotParts(robots)
    own = tuple(robot for robot in robots if _is_about(robot, document))
    return RobotParts(own or _robots(subject, document) or robots)


def package_robots(subject: Subject) -> Iterator[Robot]:
    """Yield the robots of a package, those of its worlds, and those that RViz is shown."""
    robots, worlds = subject.all(Robot), subject.all(World)
    yield from () if isinstance(robots, NotAvailable) else robots
    for world in () if isinstance(worlds, NotAvailable) else worlds:
        yield from world.models
    if isinstance(robots, NotAvailable) or robots[0].conventions.read_by_gazebo:
        descriptions = subject.all(UrdfDescription)
        if not isinstance(descriptions, NotAvailable):
            yield from (description.robot for description in descriptions)


def _is_about(robot: Robot, document: XmlDocument) -> bool:
    """Return whether a robot has parts that a document describes."""
    source = robot.document.source
    if isinstance(source, ExpandedText):
        return any(it is not None and it.document is document for it in source.origins)
    parts: tuple[Part, ...] = (robot, *robot.links, *robot.joints, *robot.plugins)
    return any(part.element.document is document for part in parts)


def _robots(subject: Subject, document: XmlDocument) -> tuple[Robot, ...]:
    if document.root.tag == "sdf":
        return tuple(read_sdf(document, ModelIncludes(subject.package)))
    source = document.source
    is_urdf = document.root.tag == "robot" and "xmlns:xacro" not in source.text
    return (read_urdf(document),) if is_urdf and not is_srdf(source.file) else ()
