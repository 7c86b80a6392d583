"""A node reads a topic that no launch file publishes; its messages are on another one.

Navigation is often started beside the robot, by a launch file of its own. Nav2 reads `odom` by
default, and `diff_drive_controller` publishes `~/odom`: without odometry the controller takes the
robot to stand still, and drives at the first step of its acceleration only.

It is reported for odometry, scans, point clouds, ranges and IMUs where a parameter names the topic,
a robot or driver that another launch file of the package starts publishes the type under another
name, and all nodes of these launch files are known. WIR006 reports it within one launch file.

Fix: write the name that is published, or remap it.
Source: navigation2, parameters `odom_topic` and `topic`; ros2_controllers, topics of the
controllers.
"""

from checker.launch.ros2.bridges.entry import BridgeEntry
from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.sensed import (
    alike,
    sources,
    topics_read_by,
    unpublished_inputs,
    where_published,
)
from checker.ros.wiring.wiring import Wiring, Wirings
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("WIR018", "input-of-no-launch-file", Severity.WARNING, Concern.INTERFACE)
def check(wirings: Wirings) -> Findings:
    """Report inputs whose messages other launch files publish under another name."""
    published = {
        it.topic
        for each in wirings.all
        for it in each.endpoints
        if it.publishes and not _is_silent(each, it)
    }
    for wiring in wirings.all:
        for wanted, message in unpublished_inputs(wiring, published):
            read = topics_read_by(wiring, wanted.owner)
            if sources(wiring, wanted, message, read):
                continue  # WIR006 reports it
            others = [
                it
                for each in wirings.all
                for it in sources(each, wanted, message, read)
                if not _is_silent(each, it)
            ]
            if not others:
                continue
            reasons = (it.more_publishers(message) or it.unknown_parts for it in wirings.all)
            unknown = next(filter(None, reasons), "")
            if unknown and not any(alike(wanted, it) for it in others):
                yield unchecked(f"the publishers of {wanted.topic} are not all known: {unknown}")
                continue
            yield finding(
                wanted.span,
                f"{wanted.by} reads {wanted.topic} ({wanted.parameter}), which no launch file of "
                f"the package publishes: {where_published(message, others)}",
                key=wanted.topic,
                related=[(it.span, f"{it.by} publishes {it.topic}") for it in others],
            )


def _is_silent(wiring: Wiring, endpoint: Endpoint) -> bool:
    """Return whether a topic comes from a bridge of which nothing in Gazebo is the source."""
    entry, simulation = endpoint.owner, wiring.simulation
    return isinstance(entry, BridgeEntry) and simulation is not None and simulation.is_silent(entry)


_NAVIGATION = """<launch>
  <node pkg="nav2_bt_navigator" exec="bt_navigator">
    <param name="odom_topic" value="@"/>%
  </node>
</launch>
"""
_LIDAR = '<launch><node pkg="urg_node" exec="urg_node_driver"/></launch>\n'
_BRIDGE = """- ros_topic_name: base/odom
  gz_topic_name: /model/rover/odometry
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: GZ_TO_ROS
"""


def _example(
    topic: str, mark: str = "", bridge: str = _BRIDGE, more: str = _LIDAR
) -> dict[str, object]:
    return {
        "@bridge": bridge,
        "launch/navigation.launch.xml": _NAVIGATION.replace("@", topic).replace("%", mark),
        "launch/more.launch.xml": more,
    }


_MARK = "  <!-- ^ WIR018 -->"
_DEAD = _BRIDGE.replace("base/odom", "odom").replace("rover/odometry", "rover/wheel_odometry")
_UNKNOWN = '<launch><node pkg="acme_base" exec="base"/></launch>'
GOOD = [
    _example("base/odom"),
    _example("odom", bridge="[]\n"),
]
BAD = [
    _example("odom", _MARK),
    _example("base_odom", _MARK, more=_UNKNOWN),
    _example("odom", _MARK, bridge=_BRIDGE + _DEAD),
]
