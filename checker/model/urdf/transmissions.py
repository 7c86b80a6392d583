"""Transmissions and `<gazebo>` tags of a URDF document."""

from __future__ import annotations

from checker.model.urdf.description import (
    GazeboTag,
    Transmission,
    TransmissionEnd,
    UrdfDescription,
)
from checker.source.text import Located
from checker.source.xml import Element, XmlDocument


def read_description(document: XmlDocument, file: str, *, for_rviz: bool) -> UrdfDescription:
    """Read what a URDF document says beside links and joints.

    Args:
        document: The document, expanded.
        file: Path of the file that was expanded.
        for_rviz: Whether it accompanies an SDF model, only to be looked at.
    """
    root = document.root
    return UrdfDescription(
        file,
        document,
        tuple(_read_transmission(each) for each in root.all("transmission")),
        tuple(_read_gazebo(each) for each in root.all("gazebo")),
        for_rviz,
    )


def _read_transmission(element: Element) -> Transmission:
    return Transmission(
        _attribute(element, "name"),
        _type(element),
        tuple(_read_end(each) for each in element.all("joint")),
        tuple(_read_end(each) for each in element.all("actuator")),
        element,
    )


def _type(transmission: Element) -> Located[str]:
    """Return the type: an element, or an attribute as the PR2 wrote it."""
    element = transmission.child("type")
    return element.text if element is not None else _attribute(transmission, "type")


def _read_end(element: Element) -> TransmissionEnd:
    interfaces = (each.text for each in element.all("hardwareInterface"))
    return TransmissionEnd(
        _attribute(element, "name"),
        tuple(interface for interface in interfaces if interface.stated),
        element.span,
    )


def _read_gazebo(element: Element) -> GazeboTag:
    return GazeboTag(_attribute(element, "reference"), element)


def _attribute(element: Element, name: str) -> Located[str]:
    return element.attribute(name) or Located("", element.span, stated=False)
