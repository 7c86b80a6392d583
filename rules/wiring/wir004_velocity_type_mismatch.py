"""A velocity whose publisher and subscriber use different message types.

The robot does not move: a topic connects publishers and readers of one type only. From Jazzy on,
drive controllers read only `TwistStamped`, while teleop_twist_keyboard, teleop_twist_joy and Nav2
of Jazzy publish `Twist` unless a parameter is set, and twist_mux `TwistStamped` unless
`use_stamped: false` is; a bridge to Gazebo reads the type that is configured.

It is reported where no known node of the launch reads the type that is published. If the launch
starts unknown nodes, this is a warning: one of them may read it.

Fix: state the parameter that the message names, or put twist_stamper between the two.
Source: ros2_controllers, navigation2, teleop_twist_keyboard, teleop_twist_joy and twist_mux by
distribution.
"""

from checker.ros.ros2_control.distributions import distribution_of
from checker.ros.wiring.velocity import Velocity, velocities
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Context, Findings, Severity, finding, rule


@rule("WIR004", "velocity-type-mismatch", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring, context: Context) -> Findings:
    """Report publishers of velocities whose known readers all expect another type."""
    distribution = distribution_of(context)
    known = [*velocities(wiring, distribution)]
    for published in known:
        readers = [it for it in known if it.topic == published.topic and not it.publishes]
        if not published.publishes or not readers:
            continue
        if all(reader.message != published.message for reader in readers):
            unknown = wiring.more_publishers(f"geometry_msgs/msg/{readers[0].message}")
            yield finding(
                published.span,
                f"{published.by} publishes {published.message} on {published.topic}, where "
                f"{readers[0].by} reads {readers[0].message} on {distribution}: no message "
                f"arrives; {_cure(published, readers[0])}",
                severity=Severity.WARNING if unknown else None,
                key=f"{published.by} {published.topic}",
                related=[(readers[0].span, f"reads {readers[0].message}")],
            )


def _cure(published: Velocity, reader: Velocity) -> str:
    stamped = str(reader.message == "TwistStamped").lower()
    if published.switch:
        return f"state `{published.switch}: {stamped}` for {published.by}"
    if reader.switch:
        return f"state `{reader.switch}: {str(published.message == 'TwistStamped').lower()}`"
    return f"{reader.by} must get {reader.message}: put twist_stamper between them"


_HEAD = "LaunchDescription([\n"
_TELEOP = """LaunchDescription([
        Node(package="teleop_twist_keyboard", executable="teleop_twist_keyboard",{}
             {}),
"""
_SPAWNER = """        Node(package="controller_manager", executable="spawner", arguments=["base"]),
"""
_TO_GAZEBO = """- topic_name: cmd_vel
  ros_type_name: geometry_msgs/msg/{}
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
"""
_YAML = """controller_manager:
  ros__parameters:
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters: {}
"""
_ROBOT = """<robot name="rover">
  <link name="base_link"/>
  <ros2_control name="base" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  </ros2_control>
  <gazebo>
    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
      <parameters>$(find acme_rover_bringup)/config/base.yaml</parameters>
      <ros><remapping>~/cmd_vel:=/cmd_vel</remapping></ros>
    </plugin>
  </gazebo>
</robot>
"""


def _bridged_example(message: str, more: str = "", mark: str = "") -> dict[str, object]:
    """Return a rover to which a bridge passes velocities."""
    launch = _TELEOP.format(mark, more)
    return {"@bridge": _TO_GAZEBO.format(message), "@launch": {_HEAD: launch}}


def _controlled_example(more: str = "", mark: str = "") -> dict[str, object]:
    """Return a rover with a drive controller."""
    return {
        "@bridge": "[]\n",
        "@launch": {_HEAD: _TELEOP.format(mark, more) + _SPAWNER},
        "urdf/rover.urdf": _ROBOT,
        "config/base.yaml": _YAML,
    }


_STAMPED = 'parameters=[{"stamped": True}]'
_ELSEWHERE = 'remappings=[("cmd_vel", "/base/teleop")]'
_MARK = "  # ^ WIR004"
_COMPONENT = """LaunchDescription([
        LoadComposableNodes(target_container="box", composable_node_descriptions=[
            ComposableNode(package="teleop_twist_joy", plugin="teleop_twist_joy::TeleopTwistJoy",
                parameters=[{"publish_stamped_twist": @}])]),%
"""
_MUX = """LaunchDescription([
        Node(package="twist_mux", executable="twist_mux", remappings=[("cmd_vel_out", "cmd_vel")],@
             parameters=[{"topics": {"joy": {"topic": "a", "timeout": 1.0, "priority": 9}}}@]),
"""
_IMPORTS = "from launch_ros.actions import Node\n"
_MORE = """from launch_ros.actions import LoadComposableNodes, Node
from launch_ros.descriptions import ComposableNode
"""


def _component(stamped: str, mark: str = "") -> dict[str, object]:
    launch = {_HEAD: _COMPONENT.replace("@", stamped).replace("%", mark), _IMPORTS: _MORE}
    return {"@bridge": _TO_GAZEBO.format("Twist"), "@launch": launch}


def _mux(mark: str, more: str) -> dict[str, object]:
    launch = _MUX.replace("@", mark, 1).replace("@", more)
    return {"@bridge": _TO_GAZEBO.format("Twist"), "@launch": {_HEAD: launch}}


GOOD = [
    _mux("", ', {"use_stamped": False}'),
    _component("False"),
    _bridged_example("Twist"),
    _bridged_example("TwistStamped", _STAMPED),
    _bridged_example("TwistStamped", _ELSEWHERE),
    _controlled_example(_STAMPED),
    _controlled_example(_ELSEWHERE),
]
BAD = [
    _mux(_MARK, ""),
    _component("True", _MARK),
    _bridged_example("TwistStamped", mark=_MARK),
    _bridged_example("Twist", f"{_STAMPED},{_MARK}\n"),
    _controlled_example(mark=_MARK),
]
