"""A `ros2_control` tag that the controller manager cannot read.

The tag needs a `name`, a `type` of `system`, `actuator` or `sensor`, and `<hardware>` with a
`<plugin>`. Its children are `<hardware>`, `<joint>`, `<sensor>`, `<gpio>`, `<transmission>` and
`<properties>`; any other child ends the controller manager with "invalid tag name", including
`<param>`: parameters of the hardware belong inside `<hardware>`. Each tag of a robot needs a name
of its own: the controller manager refuses the second one of a name.

Fix: move `<param>` into `<hardware>`, correct the tag's name, and state name, type and plugin; of
two tags of a name, remove or rename one.
Source: ros2_control, hardware_interface/src/component_parser.cpp, `parse_resource_from_xml`;
resource_manager.cpp, "is duplicated".
"""

from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.finding import Fix, Safety
from checker.ros.ros2_control.hardware import (
    KNOWN_CHILDREN,
    TYPES,
    Hardware,
    HardwareJoint,
    Interface,
)
from checker.ros.ros2_control.robot_control import RobotControl
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.rulebook.example_parts import ros2_control
from checker.source.xml import Element
from checker.source.xml_insertion import append_to, removal


@rule("R2C003", "invalid-ros2-control-tag", Severity.ERROR, Concern.INTERFACE)
def check(control: RobotControl) -> Findings:
    """Report what is missing in a `<ros2_control>` tag, and tags that do not belong there.

    A joint that occurs twice in a tag is a warning, and so is a plugin that a condition of xacro
    leaves out: the robot may be meant to be shown alone then.
    """
    yield from _same_name(control)
    for hardware in control.hardware:
        yield from _missing(hardware)
        yield from _strange(hardware)
        for part in (*hardware.joints, *hardware.sensors, *hardware.gpios):
            yield from _nameless(part)
        yield from _twice(hardware)


def _missing(hardware: Hardware) -> Iterator[Finding]:
    called = f"<ros2_control> {hardware.name.value!r}" if hardware.name.value else "<ros2_control>"
    if not hardware.name.value:
        yield finding(hardware, "<ros2_control> has no name")
    kind = hardware.type
    if kind.value not in TYPES:
        says = f"is of type {kind.value!r}" if kind.stated else "has no type"
        yield finding(kind, f"{called} {says}, expected system, actuator or sensor")
    if not hardware.plugin.value:
        inside = hardware.element.child("hardware")
        chosen = inside is not None and _has_plugin_elsewhere(inside)
        lacks = "<plugin>" if inside is not None else "<hardware>"
        where = " with these arguments" if chosen else ""
        yield finding(
            hardware.plugin,
            f"{called} has no {lacks}{where}, so no hardware is loaded",
            severity=Severity.WARNING if chosen else None,
        )


def _same_name(control: RobotControl) -> Iterator[Finding]:
    first: dict[str, Hardware] = {}
    for hardware in control.hardware:
        name = hardware.name
        before = first.setdefault(name.value, hardware)
        if before is not hardware and name.value:
            yield finding(
                name,
                f"<ros2_control> {name.value!r} is there twice: the controller manager stops with "
                f'"Hardware name {name.value} is duplicated", and nothing is controlled; remove '
                "one, or give it another name",
                key=f"duplicated {name.value}",
                related=[(before, "the first one")],
            )


def _has_plugin_elsewhere(hardware: Element) -> bool:
    """Return whether xacro leaves out a plugin because of the values of its arguments."""
    return next(hardware.written.descendants("plugin"), None) is not None


def _strange(hardware: Hardware) -> Iterator[Finding]:
    suggestions = Suggestions(KNOWN_CHILDREN)
    for child in hardware.element.children:
        if child.tag not in KNOWN_CHILDREN:
            hint = suggestions.hint(child.tag)
            inside = "; move it into <hardware>" if child.tag == "param" else hint
            message = f"<{child.tag}> does not belong below <ros2_control>{inside}"
            yield finding(child, message, fix=_moved(child) if child.tag == "param" else None)


def _moved(parameter: Element) -> Fix | None:
    """Return the fix that moves a parameter to the end of `<hardware>`."""
    written = parameter.written
    holder = written.parent.child("hardware") if written.parent is not None else None
    if holder is None:
        return None
    text = written.whole_span.text
    return Fix(Safety.UNSAFE, (removal(written), append_to(holder, [text])))


def _twice(hardware: Hardware) -> Iterator[Finding]:
    first: dict[str, HardwareJoint] = {}
    for joint in hardware.joints:
        before = first.setdefault(joint.name.value, joint)
        if before is not joint and joint.name.value:
            yield finding(
                joint,
                f"joint {joint.name.value!r} occurs twice in <ros2_control> "
                f"{hardware.name.value!r}",
                severity=Severity.WARNING,
                key="twice",
                related=[(before, "the first one")],
            )


def _nameless(part: HardwareJoint) -> Iterator[Finding]:
    pieces: tuple[HardwareJoint | Interface, ...] = (part, *part.commands, *part.states)
    for piece in pieces:
        if not piece.name.value:
            yield finding(piece, f"<{piece.element.tag}> has no name")


_NAMED, _TYPED = ' name="arm"', ' type="system"'
_PLUGIN = "<plugin>mock_components/GenericSystem</plugin>"
_HARDWARE = f"<hardware>{_PLUGIN}</hardware>"
_MARK = "  <!-- ^ R2C003 -->"


def _arm(attributes: str = _NAMED + _TYPED, inside: str = _HARDWARE, mark: str = "") -> object:
    return {
        "@urdf": f"""
<ros2_control{attributes}>{mark}
  {inside}
  <joint name="shoulder">
    <command_interface name="position"/>
    <state_interface name="position"/>
  </joint>
</ros2_control>
"""
    }


def _conditional(mark: str) -> object:
    robot = f"""<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
<link name="base_link"/><link name="upper_arm"/>
<joint name="shoulder" type="revolute">
  <parent link="base_link"/><child link="upper_arm"/><axis xyz="0 1 0"/>
  <limit lower="-1" upper="1" effort="10" velocity="1"/>
</joint>
<xacro:arg name="gazebo" default="false"/>
<ros2_control name="arm" type="system">
  <hardware>{mark}
    <xacro:if value="$(arg gazebo)">{_PLUGIN}</xacro:if>
  </hardware>
  <joint name="shoulder"><command_interface name="position"/></joint>
</ros2_control>
</robot>
"""
    return {"@urdf": True, "urdf/arm.urdf": None, "urdf/arm.urdf.xacro": robot}


_OTHER = f"""
<ros2_control name="@" type="system">%
  {_HARDWARE}
  <joint name="elbow"><command_interface name="position"/></joint>
</ros2_control>
"""


def _two(name: str, mark: str = "") -> object:
    return {"@urdf": ros2_control() + _OTHER.replace("@", name).replace("%", mark)}


_SENSOR = '<sensor name="imu"><state_interface name="orientation.x"/></sensor>'
GOOD = [_arm(), _two("hand"), _arm(inside=_HARDWARE + _SENSOR)]
BAD = [
    _two("arm", _MARK),
    _conditional(_MARK),
    _arm(_TYPED, mark=_MARK),
    _arm(_NAMED, mark=_MARK),
    _arm(_NAMED + ' type="robot"', mark=_MARK),
    _arm(inside="", mark=_MARK),
    _arm(inside=f"<hardware>{_MARK}</hardware>"),
    _arm(inside=f'{_HARDWARE}\n<param name="port">/dev/ttyUSB0</param>{_MARK}'),
    _arm(inside=f"{_HARDWARE}\n<joints/>{_MARK}"),
    _arm(inside=f'{_HARDWARE}\n<joint name="elbow"/>\n<joint name="elbow"/>{_MARK}'),
    _arm(inside=f"{_HARDWARE}\n<sensor><state_interface name='force.x'/></sensor>{_MARK}"),
]
