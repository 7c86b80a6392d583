"""Nothing publishes the robot's transforms.

Without TF, the position of sensor data is not known: RViz shows nothing, and mapping and navigation
reject every message. The bridged poses are not TF; `pose_tf_broadcaster` converts them.

Fix: start `<node pkg="subt_ros" type="pose_tf_broadcaster" name="pose_tf_broadcaster"/>` in the
group of the robot's name.
Source: Model Migration Guide, vehicle_topics.launch; all accepted packages start it, themselves or
with the template all_robots.launch of subt_ros, whose content is assumed.
"""

from checker.launch.ros1.graph import LaunchGraph
from checker.package.inheritance import Found
from checker.package.package import Package
from checker.ros.transforms import (
    BROADCASTER,
    carries_transforms,
    may_publish_transforms,
    publishes_transforms,
)
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_TOPICS = "launch/vehicle_topics.launch"


@rule("ROS015", "no-transforms", Severity.WARNING, Concern.INTERFACE)
def check(package: Package, launch: LaunchGraph, context: Context) -> Findings:
    """Look for a node or bridge that publishes TF in all started files."""
    if any(map(publishes_transforms, launch.nodes)) or any(map(carries_transforms, launch.bridges)):
        return
    reasons = [reason for reason in launch.unread if reason != launch.unknown_commands]
    reasons += [
        f"node {node.name!r} of package {node.package} may publish transforms"
        for node in launch.nodes
        if may_publish_transforms(node)
    ]
    if reasons:
        for reason in dict.fromkeys(reasons):
            yield unchecked(reason)
        return
    part = package.part(_TOPICS)
    remedy = f"start {BROADCASTER}" if context.release == "dome" else "bridge the poses to /tf"
    yield finding(
        package.place(part.path) if isinstance(part, Found) else package.folder_place(),
        f"no node or bridge publishes transforms (TF): {remedy}",
    )


def _launch(line: str) -> dict[str, str]:
    return {_TOPICS: f'<launch>\n<arg name="name"/>\n<arg name="world_name"/>\n{line}\n</launch>\n'}


_BRIDGE = '<node pkg="ros_ign_bridge" type="parameter_bridge" name="pose" args="{}"/>'
_POSE = "/model/$(arg name)/pose@tf2_msgs/TFMessage[ignition.msgs.Pose_V"
_ALL = "$(find subt_ros)/launch/models_common/all_robots.launch"

GOOD = [
    _launch('<node pkg="subt_ros" type="pose_tf_broadcaster" name="tf"/>'),
    _launch('<node pkg="robot_state_publisher" type="robot_state_publisher" name="rsp"/>'),
    _launch('<node pkg="acme_tools" type="odom_to_tf.py" name="tf"/>'),
    _launch(_BRIDGE.format("/tf@tf2_msgs/TFMessage[ignition.msgs.Pose_V")),
    _launch(f'<include file="{_ALL}"><arg name="name" value="$(arg name)"/></include>'),
]
BAD = [
    {**_launch(_BRIDGE.format(_POSE)), "@reported": [f"{_TOPICS}:1"]},
    {
        **_launch('<node if="0" pkg="subt_ros" type="pose_tf_broadcaster" name="tf"/>'),
        "@reported": [f"{_TOPICS}:1"],
    },
]
