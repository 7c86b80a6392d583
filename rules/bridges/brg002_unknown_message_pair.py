"""A bridge between two message types that ros_gz_bridge cannot convert.

The bridge warns "Failed to create a bridge" and continues, and the topic has no messages. It
converts a fixed list of pairs, written as `package/msg/Name` and `gz.msgs.Name`; the names are
case-sensitive. The list of this rule ends in October 2024: a pair that is not similar to one of the
list is a warning or an info. An entry beside another that passes the same topic is needless: a
warning. Where the message of Gazebo is in the place of that of ROS, the finding names the line to
write.

Fix: write the pair that the finding names.
Source: ros_gz_bridge, mappings.py; gazebosim/ros_gz issues 383 and 558.
"""

from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.words import and_list
from checker.finding import Fix
from checker.launch.ros2.bridges.entry import GZ_PREFIXES, MARKS, BridgeEntry, gz_name
from checker.launch.ros2.graph import is_known
from checker.ros.bridge_types import (
    all_ros_types,
    gz_messages,
    meant_gz_message,
    meant_ros_type,
    ros_types,
)
from checker.ros.simulation import Simulations
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    rename,
    rule,
)
from checker.source.text import Located

_AS_LISTED = ("", "humble", "jazzy")
"""Distributions of which the table is complete."""


@rule("BRG002", "unknown-message-pair", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations, context: Context) -> Findings:
    """Report the pairs that are not known."""
    for simulation in simulations.all:
        for entry in simulation.entries:
            passed = entry.passed
            if entry.is_own and is_known(passed.ros_type.value + passed.gz_type.value):
                messages = {m for topic in simulation.topics_of(entry) for m in topic.messages}
                for found in _judged(entry, messages, context.distro):
                    needless = any(_passes(it, entry.ros_topic) for it in simulation.entries)
                    yield _needless(found, entry.ros_topic) if needless else found


def _passes(entry: BridgeEntry, topic: str) -> bool:
    """Return whether an entry passes a topic of ROS in a pair that the bridge converts."""
    is_known_pair = entry.passed.ros_type.value in ros_types(entry.gz_name)
    return bool(topic) and entry.ros_topic == topic and is_known_pair


def _needless(found: Finding, topic: str) -> Finding:
    message = f"{found.message}, but another entry passes {topic}: remove this one"
    severity = Severity.INFO if found.severity is Severity.INFO else Severity.WARNING
    return replace(found, message=message, severity=severity, fix=None)


def _judged(entry: BridgeEntry, behind: set[str], distro: str) -> Iterator[Finding]:
    ros, gz = entry.passed.ros_type, entry.passed.gz_type
    partners = ros_types(entry.gz_name)
    if ros.value.startswith(GZ_PREFIXES) and gz.value in ros_types(gz_name(ros.value)):
        yield _swapped(entry)
    elif not gz.value.startswith(GZ_PREFIXES) or not partners:
        yield _unknown_message(gz, ros.value)
    elif ros.value not in partners and not behind.intersection(gz_messages(ros.value)):
        expected = and_list(partners)
        said = f"the bridge does not convert {gz.value} to {ros.value}"
        if meant := meant_ros_type(ros.value, partners):
            yield finding(ros, f"{said}; expected {meant}", fix=rename(ros, meant))
        elif ros.value in all_ros_types():
            severity = None if distro in _AS_LISTED else Severity.WARNING
            yield finding(ros, f"{said}; it knows {expected}", severity=severity)
        else:
            yield finding(ros, f"{said}; it knows {expected}", severity=Severity.WARNING)


def _swapped(entry: BridgeEntry) -> Finding:
    """Report messages of ROS and Gazebo that are in each other's places."""
    passed, ros, gz = entry.passed, entry.passed.gz_type, entry.passed.ros_type
    said = "the two types are swapped, that of ROS comes first: write"
    topic = passed.ros_topic
    if ros.span is not gz.span:  # an entry of a file
        edits = (ros.span.replacement(gz.value), gz.span.replacement(ros.value))
        expected = f"ros_type_name: {ros.value}, gz_type_name: {gz.value}"
        return finding(gz, f"{said} {expected}", fix=Fix(Safety.UNSAFE, edits))
    mark = next(mark for mark, way in MARKS.items() if way is entry.direction)
    wanted = f"{topic.value}@{ros.value}{mark}{gz.value}"
    written = Located(f"{topic.value}@{gz.value}{mark}{ros.value}", topic.span)
    return finding(topic, f"{said} {wanted}", fix=rename(written, wanted))


def _unknown_message(gz: Located[str], ros: str) -> Finding:
    meant = meant_gz_message(gz.value)
    if meant:
        message = f"Gazebo has no message {gz.value!r:.200}; expected gz.msgs.{meant}"
        return finding(gz, message, fix=rename(gz, f"gz.msgs.{meant}"))
    near = gz_messages(ros)
    hint = f"; for {ros} it knows {and_list([f'gz.msgs.{name}' for name in near])}" if near else ""
    return finding(
        gz,
        f"the bridge is not known to convert {gz.value:.200}{hint}",
        severity=Severity.WARNING if near else Severity.INFO,
    )


_BETWEEN = "- topic_name: a\n  ros_type_name: {}\n  gz_type_name: {}"


def _entry(ros: str, gz: str, mark: str = "") -> dict[str, object]:
    text = _BETWEEN.format(ros, gz)
    return {"@bridge": text.replace(mark, f"{mark}  # ^ BRG002") if mark else text}


GOOD = [
    {"@bridge": True},
    _entry("sensor_msgs/msg/Imu", "gz.msgs.IMU"),
    _entry("sensor_msgs/msg/Imu", "ignition.msgs.IMU"),
    _entry("geometry_msgs/msg/TwistStamped", "gz.msgs.Twist"),
    {
        # A file of another package is reported there.
        "@bridge": True,
        "@launch": {
            'os.path.join(HERE, "config", "bridge.yaml")': (
                'get_package_share_directory("acme_bridges") + "/config/bridge.yaml"'
            )
        },
        "../acme_bridges/package.xml": "<package><name>acme_bridges</name></package>",
        "../acme_bridges/CMakeLists.txt": (
            "project(acme_bridges)\ninstall(DIRECTORY config DESTINATION share/acme_bridges)\n"
        ),
        "../acme_bridges/config/bridge.yaml": _BETWEEN.format(
            "std_msgs/msg/float64", "gz.msgs.Double"
        ),
    },
]
BAD = [
    _entry("std_msgs/JointState", "gz.msgs.Model", "std_msgs/JointState"),
    _entry("std_msgs/msg/float64", "gz.msgs.Double", "std_msgs/msg/float64"),
    _entry("sensor_msgs/msg/Imu", "ign_msgs.IMU", "ign_msgs.IMU"),
    _entry("sensor_msgs/msg/Imu", "gz.msgs.Imu", "gz.msgs.Imu"),
    _entry("sensor_msgs/msg/Imu", "gz.msgs.Odometry", "sensor_msgs/msg/Imu"),
    _entry("gz.msgs.Odometry", "nav_msgs/msg/Odometry", "gz.msgs.Odometry"),
    _entry("acme_msgs/msg/Pulse", "gz.msgs.Odometry", "acme_msgs/msg/Pulse"),
    _entry("acme_msgs/msg/Pulse", "acme.msgs.Pulse", "acme.msgs.Pulse"),
    {
        "@bridge": True,
        "@launch": {
            "arguments=[]": 'arguments=["/a@sensor_msgs/Imu[gz.msgs.IMU"],  # ^ BRG002\n#',
        },
    },
    {
        "@bridge": True,
        "@launch": {
            "arguments=[]": (
                'arguments=["/tf@gz.msgs.Pose_V[tf2_msgs/msg/TFMessage"],  # ^ BRG002\n#'
            ),
        },
    },
]
