"""`<ros2_control>` tags of a URDF document: hardware, its joints, and their interfaces."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from types import MappingProxyType

from checker.base.record import Record
from checker.model.values import parse_number
from checker.source.text import Located
from checker.source.xml import Element, Tagged

TYPES = ("system", "actuator", "sensor")
KNOWN_CHILDREN = ("hardware", "joint", "sensor", "gpio", "transmission", "properties")
"""Elements below `<ros2_control>`; the controller manager stops at any other."""
STANDARD_INTERFACES = (
    *("position", "velocity", "acceleration", "effort"),
    *("torque", "force", "current", "temperature"),
)
WITH_PID = MappingProxyType({"position_pid": "position", "velocity_pid": "velocity"})
"""Command interfaces that gazebo_ros2_control offers by another name, held by its own PID."""


class Interface(Tagged, Record, eq=False):
    """A `<command_interface>` or `<state_interface>`.

    Attributes:
        name: The name, such as `velocity`.
        numbers: What `min`, `max` and `initial_value` state; what reads as no number is left out.
        params: Texts of its `<param>`s by their names.
        element: The tag.
    """

    name: Located[str]
    numbers: Mapping[str, Located[float]]
    params: Mapping[str, Located[str]]
    element: Element


class HardwareJoint(Tagged, Record, eq=False):
    """A `<joint>`, `<sensor>` or `<gpio>` of a `<ros2_control>` tag.

    Attributes:
        name: The name of the joint in the URDF, or of the sensor or gpio.
        mimic: Its attribute `mimic`; None if it has none.
        commands: Its command interfaces.
        states: Its state interfaces.
        params: Its own `<param>`s.
        element: The tag.
    """

    name: Located[str]
    mimic: Located[str] | None
    commands: tuple[Interface, ...]
    states: tuple[Interface, ...]
    params: Mapping[str, Located[str]]
    element: Element


class Hardware(Tagged, Record, eq=False, dict=True):
    """A `<ros2_control>` tag.

    Attributes:
        name: Empty when not stated.
        type: `system`, `actuator` or `sensor`; empty if not stated.
        plugin: Class of the hardware component; empty if not stated.
        joints: The joints in order.
        sensors: The sensors in order.
        gpios: The GPIOs in order.
        element: The tag.
    """

    name: Located[str]
    type: Located[str]
    plugin: Located[str]
    joints: tuple[HardwareJoint, ...]
    sensors: tuple[HardwareJoint, ...]
    gpios: tuple[HardwareJoint, ...]
    element: Element

    @cached_property
    def joints_by_name(self) -> Mapping[str, HardwareJoint]:
        """Joints by name; the first one when a name is given twice."""
        return {joint.name.value: joint for joint in reversed(self.joints)}


def read_hardware(root: Element) -> tuple[Hardware, ...]:
    """Read the `<ros2_control>` tags of a robot."""
    return tuple(_hardware(element) for element in root.all("ros2_control"))


def _hardware(element: Element) -> Hardware:
    holder = element.child("hardware") or element
    plugin = element.child("hardware", "plugin")
    return Hardware(
        _attribute(element, "name"),
        _attribute(element, "type"),
        plugin.text if plugin is not None else Located("", holder.span, stated=False),
        tuple(map(_joint, element.all("joint"))),
        tuple(map(_joint, element.all("sensor"))),
        tuple(map(_joint, element.all("gpio"))),
        element,
    )


def _joint(element: Element) -> HardwareJoint:
    return HardwareJoint(
        _attribute(element, "name"),
        element.attribute("mimic"),
        tuple(map(_interface, element.all("command_interface"))),
        tuple(map(_interface, element.all("state_interface"))),
        _params(element),
        element,
    )


def _interface(element: Element) -> Interface:
    params = _params(element)
    numbers = {
        name: Located(number, text.span)
        for name, text in params.items()
        if (number := parse_number(text.value)) is not None
    }
    return Interface(_attribute(element, "name"), numbers, params, element)


def _params(element: Element) -> dict[str, Located[str]]:
    return {param.get("name") or "": param.text for param in element.all("param")}


def _attribute(element: Element, name: str) -> Located[str]:
    return element.attribute(name) or Located("", element.span, stated=False)
