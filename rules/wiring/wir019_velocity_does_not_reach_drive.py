"""No velocity reaches the drive: what is published, and what the drive reads, have other names.

Navigation plans and the robot stands still. Velocities often pass several nodes of Nav2,
`controller_server`, `velocity_smoother` and `collision_monitor`: the last one has to publish on the
topic that the drive controller, the plugin or the bridge reads.

It is reported where all launch files of the package, started side by side, publish velocities that
nothing reads, the drive of a robot reads a topic on which nothing publishes, and all nodes are
known.

Fix: write the topic of the drive into the parameter of the last node, or remap one of the two.
Source: navigation2, `cmd_vel_out_topic` of nav2_collision_monitor; ros2_controllers,
`~/cmd_vel` of diff_drive_controller.
"""

from checker.ros.wiring.endpoints import Endpoint
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wirings
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_TYPES = frozenset({"geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"})


@rule("WIR019", "velocity-does-not-reach-drive", Severity.WARNING, Concern.INTERFACE)
def check(wirings: Wirings) -> Findings:
    """Report velocities that nothing reads, beside a drive that gets none."""
    velocities = [
        it for each in wirings.all for it in each.endpoints if not _TYPES.isdisjoint(it.types)
    ]
    published = {it.topic for it in velocities if it.publishes}
    read = {it.topic for it in velocities if not it.publishes}
    drives = [it for it in velocities if not it.publishes and _is_drive(it)]
    sent = (it for it in velocities if it.publishes and isinstance(it.owner, WiredNode))
    lost = [it for it in sent if it.certain and it.topic not in read]
    if not drives or not lost or any(it.topic in published for it in drives):
        return
    if reason := wirings.unknown_readers:
        yield unchecked(f"the readers of {lost[0].topic} are not all known: {reason}")
        return
    for sender in lost:
        yield finding(
            sender.span,
            f"{sender.by} publishes {sender.topic}, which nothing reads: "
            f"{drives[0].by} reads {drives[0].topic}, on which nothing publishes",
            key=sender.topic,
            related=[(drives[0].span, f"reads {drives[0].topic}")],
        )


def _is_drive(endpoint: Endpoint) -> bool:
    return endpoint.certain and not isinstance(endpoint.owner, WiredNode)


_NAVIGATION = """<launch>
  <node pkg="nav2_collision_monitor" exec="collision_monitor">%
    <param name="cmd_vel_in_topic" value="cmd_vel_smoothed"/>
    <param name="cmd_vel_out_topic" value="@"/>
  </node>
</launch>
"""
_BRIDGE = """- ros_topic_name: base/cmd_vel
  gz_topic_name: /model/rover/cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
"""


def _example(topic: str, mark: str = "", bridge: str = _BRIDGE) -> dict[str, object]:
    return {
        "@bridge": bridge,
        "launch/navigation.launch.xml": _NAVIGATION.replace("@", topic).replace("%", mark),
    }


GOOD = [_example("base/cmd_vel"), _example("cmd_vel", bridge="[]\n")]
BAD = [_example("cmd_vel", "  <!-- ^ WIR019 -->")]
