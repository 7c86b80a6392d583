"""A bridge names another message than its topic in Gazebo carries.

A subscriber in Gazebo gets only messages of its own type, so no message ever arrives, and no
program reports it. Topics of an RGBD camera are often mixed up: `<topic>/image` and
`<topic>/depth_image` carry images, `<topic>/points` a point cloud.

Fix: write the message that the sensor or system publishes, or the topic that carries this message.
Source: gz-sensors and Gazebo's systems; gazebosim/gz-sensors issue 175.
"""

from checker.base.words import and_list
from checker.launch.ros2.bridges.entry import GZ_PREFIXES
from checker.ros.bridge_types import ros_types
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("BRG003", "mismatched-message-type", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report bridges whose message is not that of the sensors and systems behind the topic."""
    for simulation in simulations.launched:
        for entry in simulation.entries:
            behind = simulation.topics_of(entry)
            messages = list(dict.fromkeys(name for topic in behind for name in topic.messages))
            stated = entry.passed.gz_type
            known = stated.value.startswith(GZ_PREFIXES) and ros_types(entry.gz_name)
            if not messages or not known:
                continue
            if entry.gz_name not in messages:
                expected = " or ".join(f"gz.msgs.{name}" for name in messages)
                owners = and_list(list(dict.fromkeys(topic.owner_name for topic in behind)))
                yield finding(
                    stated,
                    f"the bridge reads {entry.gz_topic} as {stated.value}, but {owners} "
                    f"uses {expected} there",
                )


def _entry(topic: str, ros: str, gz: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": f"- topic_name: {topic}\n  ros_type_name: {ros}\n  gz_type_name: {gz}{mark}\n"
    }


_MARK = "  # ^ BRG003"
GOOD = [
    {"@bridge": True},
    _entry("scan/points", "sensor_msgs/msg/PointCloud2", "gz.msgs.PointCloudPacked"),
    _entry("scan", "sensor_msgs/msg/LaserScan", "gz.msgs.Laserscan"),
    _entry("elsewhere", "sensor_msgs/msg/PointCloud2", "gz.msgs.PointCloudPacked"),
]
BAD = [
    _entry("scan", "sensor_msgs/msg/PointCloud2", "gz.msgs.PointCloudPacked", _MARK),
    _entry("/model/rover/odometry", "tf2_msgs/msg/TFMessage", "gz.msgs.Pose_V", _MARK),
    {
        "@bridge": True,
        "@launch": {
            'executable="parameter_bridge", arguments=[],': 'executable="parameter_bridge", '
            'arguments=["/scan/points@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"],  # ^ BRG003'
        },
    },
]
