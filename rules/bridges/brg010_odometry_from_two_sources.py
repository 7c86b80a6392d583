"""Gazebo and a controller both say where the robot is.

A drive of Gazebo (DiffDrive, OdometryPublisher …) reports odometry, and so does a drive controller
of ros2_control, which publishes the transform from `odom` to the robot's base by itself. With
Gazebo's odometry bridged to `/odom`, navigation reads speeds and places from one source, and
transforms from the other. WIR001 reports Gazebo's transforms that are bridged to `/tf` as well.

Fix: bridge Gazebo's odometry to another topic, such as `/ground_truth`, or state
`enable_odom_tf: false` for the controller and let one source alone give odometry.
Source: ros2_controllers, diff_drive_controller; gazebosim/gz-sim issue 2372.
"""

from collections.abc import Iterator

from checker.expand.launch.bridge import Direction
from checker.expand.ros2_launch.bridges.entry import BridgeEntry
from checker.model.components import Plugin
from checker.model.ros.simulation import Simulation, Simulations
from checker.model.ros.spawned import SpawnedRobot
from checker.model.ros2_control.controllers import Controller
from checker.model.ros2_control.launched import spawner_of
from checker.rule import Concern, Findings, Severity, finding, rule

_CHILD_FRAMES = {
    "AckermannSteering": "child_frame_id",
    "DiffDrive": "child_frame_id",
    "MecanumDrive": "child_frame_id",
    "TrackedVehicle": "child_frame_id",
    "OdometryPublisher": "robot_base_frame",
}
"""Classes that report odometry, each with the parameter that names the frame of the base."""
_CONTROLLERS = ("DiffDriveController", "OmniWheelDriveController")
"""Those whose transforms go to /tf itself; others publish them on a topic of their own."""
_TOPIC = "/odom"


@rule("BRG010", "odometry-from-two-sources", Severity.WARNING, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report bridges of odometry whose base a controller of the same robot moves in /tf, too."""
    for simulation in simulations.launched:
        for spawned in simulation.robots:
            for controller in _publishing(simulation, spawned):
                stated = next(iter(controller.texts("base_frame_id")), None)
                base = stated.value if stated is not None else "base_link"
                for entry, plugin in _bridged(simulation, spawned, base):
                    yield finding(
                        entry.passed.gz_topic,
                        f"{plugin.class_name} reports the odometry of {base!r}, bridged to "
                        f"{_TOPIC}, while {controller.called} publishes the transform of that "
                        "frame",
                        key=controller.name,
                        related=[(plugin, "reports odometry"), (controller, "publishes it, too")],
                    )


def _publishing(simulation: Simulation, spawned: SpawnedRobot) -> Iterator[Controller]:
    """Yield the controllers of a robot that are spawned and publish odometry in /tf."""
    control = spawned.control
    if control is None or any(it.namespace.value != "/" for it in control.managers):
        return
    nodes = simulation.graph.nodes if simulation.graph is not None else ()
    spawners = [spawner_of(node) for node in nodes if node.starts is not False]
    names = {name.value for spawner in spawners if spawner for name in spawner.names}
    for controller in control.controllers:
        if controller.class_name not in _CONTROLLERS or controller.name not in names:
            continue
        prefixed = "tf_frame_prefix" in controller.parameters
        if controller.flag("enable_odom_tf", default=True) and not prefixed:
            yield controller


def _bridged(
    simulation: Simulation, spawned: SpawnedRobot, base: str
) -> Iterator[tuple[BridgeEntry, Plugin]]:
    """Yield the bridges to /odom from plugins that report odometry of a frame."""
    for entry in simulation.entries:
        if entry.direction is Direction.TO_IGN or entry.ros_topic != _TOPIC:
            continue
        for topic in simulation.topics_of(entry):
            owner = topic.owner
            if not isinstance(owner, Plugin) or owner not in spawned.robot.plugins:
                continue
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
