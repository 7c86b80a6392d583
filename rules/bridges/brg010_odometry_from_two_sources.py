"""Gazebo and a controller both publish the robot's odometry.

A drive of Gazebo (DiffDrive, OdometryPublisher …) reports odometry, and so does a drive controller
of ros2_control, which publishes the transform from `odom` to the robot's base by itself. With
Gazebo's odometry bridged to `/odom`, navigation reads velocities and positions from one source, and
transforms from the other. WIR001 reports Gazebo's transforms that are bridged to `/tf` as well.

Fix: bridge Gazebo's odometry to another topic, such as `/ground_truth`, or state `enable_odom_tf:
false` for the controller so that only one source publishes odometry.
Source: ros2_controllers, diff_drive_controller; gazebosim/gz-sim issue 2372.
"""

from collections.abc import Iterator

from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.bridges.entry import BridgeEntry
from checker.model.components import Plugin
from checker.model.controllers import Controller
from checker.ros.simulation import Simulation
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_CHILD_FRAMES = {
    "AckermannSteering": "child_frame_id",
    "DiffDrive": "child_frame_id",
    "MecanumDrive": "child_frame_id",
    "TrackedVehicle": "child_frame_id",
    "OdometryPublisher": "robot_base_frame",
}
"""Classes that report odometry, each with the parameter that names the frame of the base."""
_TOPIC = "/odom"


@rule("BRG010", "odometry-from-two-sources", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report bridges of odometry whose base a controller of ros2_control moves in /tf, too."""
    for transform in wiring.transforms:
        controller = transform.source
        if isinstance(controller, Controller) and wiring.simulation is not None:
            for entry, plugin in _odometry_bridges(wiring.simulation, transform.child):
                yield finding(
                    entry.passed.gz_topic,
                    f"{plugin.class_name} reports the odometry of {transform.child!r}, bridged to "
                    f"{_TOPIC}, while {controller.label} publishes the transform of that frame",
                    key=controller.name,
                    related=[(plugin, "reports odometry"), (controller, "also publishes it")],
                )


def _odometry_bridges(simulation: Simulation, base: str) -> Iterator[tuple[BridgeEntry, Plugin]]:
    """Yield the bridges to /odom from plugins that report odometry of a frame."""
    for entry in simulation.entries:
        if entry.direction is Direction.TO_IGN or entry.ros_topic != _TOPIC:
            continue
        for topic in simulation.topics_of(entry):
            owner = topic.owner
            if isinstance(owner, Plugin):
                frames = [text.value for text in owner.at(_CHILD_FRAMES.get(owner.class_name, ""))]
                if frames[:1] == [base]:
                    yield entry, owner


_CONTROL = """
  <ros2_control name="base" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
    <joint name="left_wheel_joint"><command_interface name="velocity"/></joint>
    <joint name="right_wheel_joint"><command_interface name="velocity"/></joint>
  </ros2_control>
  <gazebo>
    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
      <parameters>$(find acme_rover_bringup)/config/base.yaml</parameters>
    </plugin>
    <plugin filename="gz-sim-odometry-publisher-system"
            name="gz::sim::systems::OdometryPublisher">
      <odom_frame>odom</odom_frame><robot_base_frame>@</robot_base_frame>
    </plugin>
  </gazebo>
</robot>
"""
_WHEEL = """
  <link name="@_wheel"/>
  <joint name="@_wheel_joint" type="continuous">
    <parent link="base_link"/><child link="@_wheel"/><axis xyz="0 1 0"/>
  </joint>"""
_HEAD = '<robot name="rover">\n  <link name="base_link"/>'
_ROBOT = _HEAD + _WHEEL.replace("@", "left") + _WHEEL.replace("@", "right") + _CONTROL
_YAML = """controller_manager:
  ros__parameters:
    base_controller: {type: diff_drive_controller/DiffDriveController}
base_controller:
  ros__parameters:
    left_wheel_names: [left_wheel_joint]
    right_wheel_names: [right_wheel_joint]
    enable_odom_tf: @
"""
_ENTRY = """- ros_topic_name: {}
  gz_topic_name: /model/rover/{}  # {}
  ros_type_name: {}
  gz_type_name: gz.msgs.{}
  direction: GZ_TO_ROS
"""
_SPAWNER = """LaunchDescription([
        Node(package="controller_manager", executable="spawner", arguments=["base_controller"]),
"""


def _rover(topic: str, odom_tf: str = "true", base: str = "base_link") -> dict[str, object]:
    return {
        "@bridge": topic,
        "@launch": {"LaunchDescription([\n": _SPAWNER},
        "urdf/rover.urdf": _ROBOT.replace("@", base),
        "config/base.yaml": _YAML.replace("@", odom_tf),
    }


def _odometry(topic: str = "odom", mark: str = "") -> str:
    return _ENTRY.format(topic, "odometry", mark, "nav_msgs/msg/Odometry", "Odometry")


GOOD = [
    _rover(_odometry(), odom_tf="false"),
    _rover(_odometry(), base="rover/base"),
    _rover(_odometry("ground_truth")),
    {**_rover(_odometry()), "@launch": {}},
]
BAD = [_rover(_odometry(mark="^ BRG010"))]
