"""A bridge whose direction is not that of its messages.

A sensor publishes in Gazebo; bridged from ROS to Gazebo, its messages do not arrive in ROS.
Commands come from ROS; bridged from Gazebo to ROS, they do not move the robot. A bridge in both
directions of a topic that Gazebo only publishes works, but creates an unnecessary publisher in
Gazebo: an info.

Fix: write `[` or GZ_TO_ROS for what Gazebo publishes, `]` or ROS_TO_GZ for commands.
Source: ros_gz_bridge; gz-sensors and Gazebo's systems.
"""

from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.bridges.entry import BridgeEntry
from checker.ros.simulation import Simulation, Simulations
from checker.rule import Concern, Findings, Severity, finding, rule

_WAYS = {Direction.TO_ROS: "Gazebo to ROS", Direction.TO_IGN: "ROS to Gazebo"}
_PUBLISHED = "rosgraph_msgs/msg/Clock"


@rule("BRG005", "wrong-bridge-direction", Severity.WARNING, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report bridges whose direction is not that of the messages."""
    for simulation in simulations.launched:
        for entry in simulation.entries:
            ways = {topic.direction for topic in simulation.topics_of(entry)}
            if entry.passed.ros_type.value == _PUBLISHED:
                ways = {Direction.TO_ROS}
            if len(ways) != 1 or entry.direction in ways or not entry.gz_topic:
                continue
            way = next(iter(ways))
            if entry.direction is Direction.BOTH:
                if way is Direction.TO_ROS:
                    yield finding(
                        entry.passed.way,
                        f"{entry.gz_topic} is bridged in both directions, but Gazebo only "
                        "publishes it: expected '[' or GZ_TO_ROS",
                        severity=Severity.INFO,
                        key="both directions",
                    )
            elif not _also_bridged(simulation, entry, way):
                yield finding(
                    entry.passed.way,
                    f"{entry.gz_topic} is bridged from {_WAYS[entry.direction]}, but its "
                    f"messages go from {_WAYS[way]}",
                )


def _also_bridged(simulation: Simulation, entry: BridgeEntry, way: Direction) -> bool:
    """Return whether another bridge of the topic has the right direction."""
    return any(
        other.gz_topic == entry.gz_topic and other.direction in (way, Direction.BOTH)
        for other in simulation.entries
    )


def _entry(topic: str, ros: str, gz: str, way: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": f"- topic_name: {topic}\n  ros_type_name: {ros}\n  gz_type_name: {gz}\n"
        f"  direction: {way}{mark}\n"
    }


_MARK = "  # ^ BRG005"
_SCAN = ("scan", "sensor_msgs/msg/LaserScan", "gz.msgs.LaserScan")
_TWIST = ("/model/rover/cmd_vel", "geometry_msgs/msg/Twist", "gz.msgs.Twist")
_CLOCK = ("/clock", "rosgraph_msgs/msg/Clock", "gz.msgs.Clock")
GOOD = [
    {"@bridge": True},
    _entry(*_TWIST, "BIDIRECTIONAL"),
    _entry("other", *_SCAN[1:], "ROS_TO_GZ"),
]
BAD = [
    _entry(*_SCAN, "ROS_TO_GZ", _MARK),
    _entry(*_SCAN, "BIDIRECTIONAL", _MARK),
    _entry(*_TWIST, "GZ_TO_ROS", _MARK),
    _entry(*_CLOCK, "ROS_TO_GZ", _MARK),
]
