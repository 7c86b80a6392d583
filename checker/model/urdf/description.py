"""What a URDF file says beside links and joints: transmissions and `<gazebo>` tags."""

from __future__ import annotations

from functools import cached_property

from checker.model.robot import Robot
from checker.model.urdf.reader import read_urdf
from checker.record import record
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument


@record(eq=False)
class TransmissionEnd:
    """A `<joint>` or `<actuator>` of a transmission.

    Attributes:
        name: Of the joint or actuator.
        interfaces: Its `<hardwareInterface>`s as written, `hardware_interface/` in front or not.
        span: The start tag.
    """

    name: Located[str]
    interfaces: tuple[Located[str], ...]
    span: Span


@record(eq=False)
class Transmission:
    """A `<transmission>`."""

    name: Located[str]
    type: Located[str]
    joints: tuple[TransmissionEnd, ...]
    actuators: tuple[TransmissionEnd, ...]
    element: Element

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.element.span


@record(eq=False)
class GazeboTag:
    """A `<gazebo>` tag; `reference` is empty for one that is meant for the whole robot."""

    reference: Located[str]
    element: Element

    @property
    def span(self) -> Span:
        """The start tag."""
        return self.element.span


@record(eq=False)
class UrdfDescription:
    """One URDF file, after xacro where it is one.

    Attributes:
        file: Path of the file as the package lists it.
        document: The expanded document; places are those of the files that a person wrote.
        transmissions: In order.
        gazebo: In order.
        for_rviz: Whether it accompanies an SDF model, only to be looked at.
    """

    file: str
    document: XmlDocument
    transmissions: tuple[Transmission, ...]
    gazebo: tuple[GazeboTag, ...]
    for_rviz: bool

    @cached_property
    def robot(self) -> Robot:
        """The robot, without its meshes."""
        return read_urdf(self.document)
