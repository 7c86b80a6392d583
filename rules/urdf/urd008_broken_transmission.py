"""A transmission without effect.

gazebo_ros_control registers a joint with the controllers through its transmission. It skips a
transmission without a joint, an actuator or an interface, and the controller does not find its
joint. Without a plugin that reads transmissions, the transmission of a fixed joint has no effect
anyway, and the finding is an info. So it is where no launch file gives the robot to a simulator.
The interface of an actuator is read only if the joint has none: another one there is a warning.

Fix: give the transmission one joint of the robot with its hardware interface, and one actuator.
Source: transmission_interface, TransmissionParser: a transmission without name, type, joint or
actuator is skipped; gazebo_ros_control, DefaultRobotHWSim: uses the first interface of the joint.
"""

from collections import Counter
from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.words import Suggestions
from checker.formats.urdf.description import Transmission, TransmissionEnd, UrdfDescription
from checker.model.robot import Robot
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    misspelt,
    rename,
    rule,
)
from checker.source.text import Located

_MOVING = ("continuous", "prismatic", "revolute")
_PREFIX = "hardware_interface/"
_OF_ROS_CONTROL = "transmission_interface/"


@rule("URD008", "broken-transmission", Severity.ERROR, Concern.INTERFACE)
def check(description: UrdfDescription, context: Context) -> Findings:
    """Report transmissions without effect, and joints without one unlike others of their type.

    In ROS 2 nothing reads transmissions outside of `<ros2_control>`: there it is an info.
    """
    if not description.for_rviz:
        is_read = context.is_gazebo_alone or not description.robot.shown_only
        for found in _faults(description):
            ignored = context.distro or not is_read
            yield replace(found, severity=Severity.INFO) if ignored else found


def _faults(description: UrdfDescription) -> Iterator[Finding]:
    robot = description.robot
    names = Suggestions(robot.joints_by_name)
    for transmission in description.transmissions:
        if _is_of_ros_control(transmission):
            yield from _broken_transmissions(transmission)
        for end in transmission.joints:
            yield from _joint(transmission, end, robot, names)
    yield from _twice(description)
    yield from _left_without(description)


def _is_of_ros_control(transmission: Transmission) -> bool:
    """Return whether ros_control reads a transmission; types of the PR2, say, have another form."""
    kind = transmission.type.value
    return not kind or kind.startswith(_OF_ROS_CONTROL)


def _broken_transmissions(transmission: Transmission) -> Iterator[Finding]:
    missing = [
        word
        for word, there in (
            ("type", transmission.type.value),
            ("joint", transmission.joints),
            ("actuator", transmission.actuators),
        )
        if not there
    ]
    if missing:
        yield finding(
            transmission,
            f"transmission {transmission.name.value!r} has no {' and no '.join(missing)}",
        )


def _joint(
    transmission: Transmission, end: TransmissionEnd, robot: Robot, names: Suggestions
) -> Iterator[Finding]:
    name, own = end.name.value, transmission.name.value
    joint = robot.joints_by_name.get(name)
    used = any("control" in plugin.filename.value for plugin in robot.plugins)
    if joint is None:
        message = f"transmission {own!r} moves joint {name!r}, which does not exist"
        yield misspelt(end.name, message, names, severity=None if used else Severity.WARNING)
    elif joint.type.value not in _MOVING:
        phrase = f"moves joint {name!r}, which is {joint.type.value}"
        level = Severity.WARNING if used else Severity.INFO
        yield finding(end.name, f"transmission {own!r} {phrase}", severity=level)
    if not end.interfaces:
        if _is_of_ros_control(transmission):
            message = f"joint {name!r} of transmission {own!r} has no <hardwareInterface>"
            yield finding(end, message)
        return
    wanted = {_plain(interface) for interface in end.interfaces}
    for actuator in transmission.actuators:
        for interface in actuator.interfaces:
            if _plain(interface) not in wanted:
                yield finding(
                    interface,
                    f"actuator {actuator.name.value!r} has {_plain(interface)}, but joint "
                    f"{name!r} has {', '.join(sorted(wanted))}, which is used: expected the same",
                    severity=Severity.WARNING,
                    related=[(end.interfaces[0], "the joint's interface")],
                    fix=rename(interface, end.interfaces[0].value) if len(wanted) == 1 else None,
                )


def _plain(interface: Located[str]) -> str:
    return interface.value.removeprefix(_PREFIX)


def _twice(description: UrdfDescription) -> Iterator[Finding]:
    seen: dict[str, TransmissionEnd] = {}
    for transmission in description.transmissions:
        for end in transmission.joints:
            first = seen.setdefault(end.name.value, end)
            if first is not end and end.name.value:
                yield finding(
                    end.name,
                    f"joint {end.name.value!r} has a second transmission, expected one",
                    related=[(first.name, "the first one")],
                )


def _left_without(description: UrdfDescription) -> Iterator[Finding]:
    """Yield joints without transmission if most joints of their type have one."""
    # Transmissions of the PR2 name joints in elements such as <flexJoint> and <passive_joint>.
    named = {
        part.attributes.get("name", "")
        for transmission in description.transmissions
        for part in transmission.element.descendants()
    }
    robot = description.robot
    moved = named | {
        descendant.text.value
        for plugin in robot.plugins
        for descendant in plugin.element.descendants()
    }
    joints = [joint for joint in robot.joints if joint.type.value in _MOVING and not joint.mimics]
    driven = Counter(joint.type.value for joint in joints if joint.name.value in named)
    loose = Counter(joint.type.value for joint in joints if joint.name.value not in moved)
    for joint in joints:
        kind, name = joint.type.value, joint.name.value
        if name not in moved and driven[kind] > loose[kind]:
            yield finding(
                joint,
                f"{kind} joint {name!r} has no transmission, unlike {driven[kind]} others",
                severity=Severity.WARNING,
            )


_TYPE = "<type>transmission_interface/SimpleTransmission</type>"
_INTERFACE = "<hardwareInterface>EffortJointInterface</hardwareInterface>"
_MARK = "  <!-- ^ URD008 -->"


def _transmission(inside: str, mark: str = "") -> str:
    return f'<transmission name="t">{mark}{_TYPE}\n{inside}\n</transmission>\n'


def _shoulder(interface: str = _INTERFACE, mark: str = "") -> str:
    return f'<joint name="shoulder">{mark}\n{interface}\n</joint>'


_MOTOR = '<actuator name="m"/>'
_SOUND = _transmission(_shoulder() + _MOTOR)


def _hinge(name: str, mark: str = "", kind: str = "revolute") -> str:
    ends = f'<parent link="base_link"/><child link="{name}_link"/>'
    return f'<link name="{name}_link"/><joint name="{name}" type="{kind}">{ends}</joint>{mark}\n'


GOOD = [
    {"@urdf": True},
    {
        "@urdf": _transmission(
            _shoulder(_INTERFACE.replace(">E", ">hardware_interface/E"))
            + f'<actuator name="m">{_INTERFACE}</actuator>'
        )
    },
    {"@urdf": _SOUND + _hinge("elbow")},
    {
        "@urdf": _SOUND
        + _transmission(f'<joint name="elbow">{_INTERFACE}</joint>{_MOTOR}')
        + '<transmission name="w" type="WristTransmission"><flexJoint name="wrist"/></transmission>'
        + _hinge("elbow")
        + _hinge("wrist")
    },
    {
        "@urdf": "".join(_hinge(name) for name in ("left", "right", "caster"))
        + "<gazebo><plugin name='drive' filename='libgazebo_ros_diff_drive.so'>"
        "<leftJoint>left</leftJoint><rightJoint>right</rightJoint></plugin></gazebo>"
    },
]
BAD = [
    {"@urdf": _transmission(_shoulder(), _MARK)},
    {"@urdf": _transmission(_MOTOR, _MARK)},
    {
        "@urdf": _transmission(_shoulder().replace("shoulder", "elbow") + _MOTOR).replace(
            '<joint name="elbow">', f'<joint name="elbow">{_MARK}'
        )
    },
    {"@urdf": _transmission(_shoulder("", _MARK) + _MOTOR)},
    {
        "@urdf": _transmission(
            _shoulder()
            + f"""<actuator name="m">
<hardwareInterface>VelocityJointInterface</hardwareInterface>{_MARK}
</actuator>"""
        )
    },
    {"@urdf": _SOUND + _transmission(_shoulder(mark=_MARK) + _MOTOR)},
    {
        "@urdf": _hinge("mount", kind="fixed")
        + _transmission(f'<joint name="mount">{_MARK}\n{_INTERFACE}</joint>{_MOTOR}')
    },
    {
        "@urdf": _SOUND
        + _transmission(f'<joint name="elbow">{_INTERFACE}</joint>{_MOTOR}')
        + _hinge("elbow")
        + _hinge("wrist", _MARK)
    },
]
