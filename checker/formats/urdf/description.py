"""Content of a URDF file besides links and joints: transmissions and `<gazebo>` tags."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property

from msgspec.structs import replace

from checker.base.record import Record
from checker.formats.urdf.macro_calls import MacroCall
from checker.formats.urdf.reader import read_urdf
from checker.model.robot import Robot
from checker.source.text import Located, Span
from checker.source.xml import Element, Tagged, XmlDocument


class TransmissionEnd(Record, eq=False):
    """A `<joint>` or `<actuator>` of a transmission.

    Attributes:
        name: The name of the joint or actuator.
        interfaces: Its `<hardwareInterface>`s as written, `hardware_interface/` in front or not.
        span: The start tag.
    """

    name: Located[str]
    interfaces: tuple[Located[str], ...]
    span: Span


class Transmission(Tagged, Record, eq=False):
    """A `<transmission>`."""

    name: Located[str]
    type: Located[str]
    joints: tuple[TransmissionEnd, ...]
    actuators: tuple[TransmissionEnd, ...]
    element: Element


class GazeboTag(Tagged, Record, eq=False):
    """A `<gazebo>` tag; `reference` is empty for one that is meant for the whole robot."""

    reference: Located[str]
    element: Element


class UrdfDescription(Record, eq=False, dict=True):
    """One URDF file, after xacro where it is one.

    Attributes:
        file: Path of the file as the package lists it.
        document: The expanded document; places are those of the files that a person wrote.
        transmissions: The transmissions in order.
        gazebo: The `<gazebo>` tags in order.
        for_rviz: Whether it accompanies an SDF model, for display only.
        call: The call of the macro that makes the robot, where the file itself makes none.
        values: Values of arguments that differ from those the file is read with: `model:=waffle`.
        shown_only: Why no simulator gets it, as a clause; empty if one may.
        unloaded: That no launch file loads it, as a clause, where one loads another; else empty.
    """

    file: str
    document: XmlDocument
    transmissions: tuple[Transmission, ...]
    gazebo: tuple[GazeboTag, ...]
    for_rviz: bool
    call: MacroCall | None = None
    values: str = ""
    shown_only: str = ""
    unloaded: str = ""

    @cached_property
    def robot(self) -> Robot:
        """The robot, without its meshes."""
        return replace(read_urdf(self.document), shown_only=self.shown_only, unloaded=self.unloaded)


# Transmissions and `<gazebo>` tags of a URDF document.


def read_description(document: XmlDocument, file: str, *, for_rviz: bool) -> UrdfDescription:
    """Read what a URDF document states besides links and joints.

    Args:
        document: The document, expanded.
        file: Path of the file that was expanded.
        for_rviz: Whether it accompanies an SDF model, for display only.
    """
    root = document.root
    return UrdfDescription(
        file,
        document,
        tuple(_read_transmission(element) for element in root.all("transmission")),
        tuple(GazeboTag(_attribute(each, "reference"), each) for each in root.all("gazebo")),
        for_rviz,
    )


def _read_transmission(element: Element) -> Transmission:
    return Transmission(
        _attribute(element, "name"),
        _type(element),
        tuple(_read_end(joint) for joint in element.all("joint")),
        tuple(_read_end(actuator) for actuator in element.all("actuator")),
        element,
    )


def _type(transmission: Element) -> Located[str]:
    """Return the type: an element, or an attribute as the PR2 wrote it."""
    element = transmission.child("type")
    return element.text if element is not None else _attribute(transmission, "type")


def _read_end(element: Element) -> TransmissionEnd:
    interfaces = (item.text for item in element.all("hardwareInterface"))
    return TransmissionEnd(
        _attribute(element, "name"),
        tuple(interface for interface in interfaces if interface.stated),
        element.span,
    )


def _attribute(element: Element, name: str) -> Located[str]:
    return element.attribute(name) or Located("", element.span, stated=False)


def joints_with_motor(robot: Robot) -> Iterator[str]:
    """Yield the names of joints that transmissions and ros2_control let a controller move."""
    yield from motor_interfaces(robot)


def motor_interfaces(robot: Robot) -> dict[str, set[str]]:
    """Return the joints that transmissions and ros2_control let a controller move.

    Each has the interfaces that are stated: `position`, `velocity`, `effort` or another word.
    """
    root, found = robot.element, dict[str, set[str]]()
    for transmission in root.all("transmission"):
        for joint in transmission.all("joint"):
            holders = (joint, *transmission.all("actuator"))
            stated = [each for holder in holders for each in holder.all("hardwareInterface")]
            # hardware_interface/PositionJointInterface
            words = {each.text.value.strip().rpartition("/")[2] for each in stated}
            names = {word.removesuffix("JointInterface").lower() for word in words}
            found.setdefault(joint.get("name") or "", set()).update(names)
    for control in root.all("ros2_control"):
        for joint in control.all("joint"):
            if commands := joint.all("command_interface"):
                words = {command.get("name") or "" for command in commands}
                found.setdefault(joint.get("name") or "", set()).update(words)
    return found
