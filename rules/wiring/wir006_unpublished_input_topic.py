"""A node reads a topic that nothing publishes, while its messages are on another topic.

The node starts and waits without a message: a filter gets no odometry, a costmap or a map stays
empty. The name is often that of another package or tutorial: DiffDrive in Gazebo publishes `odom`
below the name of its model, `diff_drive_controller` publishes `~/odom`, the steering controllers
`~/odometry`.

It is reported for odometry, scans, point clouds, ranges and IMUs where a parameter names the topic,
and a robot or driver of the same launch publishes the type under another name which the node does
not read. Where the launch starts nodes whose topics are not known, it is only reported if both
names differ only in separators (`imu_data`, `imu/data`): such a node may pass messages on. A topic
counts as published where the source of such a node's package names it in `create_publisher` or
`advertise`.

Fix: write the name that is published, or remap it.
Source: robot_localization, slam_toolbox and navigation2: parameters that name topics;
ros2_controllers, topics of the controllers.
"""

from checker.package.package import Package
from checker.ros.wiring.sensed import (
    alike,
    sources,
    topics_read_by,
    unpublished_inputs,
    where_published,
)
from checker.ros.wiring.source_topics import source_topics
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("WIR006", "unpublished-input-topic", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, package: Package) -> Findings:
    """Report inputs of known nodes whose messages are on a topic of another name."""
    published = {each.topic for each in wiring.endpoints if each.publishes}
    missed = [
        (wanted, message, others)
        for wanted, message in unpublished_inputs(wiring, published)
        if (others := sources(wiring, wanted, message, topics_read_by(wiring, wanted.owner)))
    ]
    in_source = source_topics(package, wiring.every_node) if missed else frozenset[str]()
    for wanted, message, others in missed:
        if wanted.topic in in_source:
            continue
        unknown = wiring.more_publishers(message) or wiring.unknown_parts
        if unknown and not alike(wanted, others[0]):
            yield unchecked(f"the publishers of {wanted.topic} are not all known: {unknown}")
            continue
        yield finding(
            wanted.span,
            f"{wanted.by} reads {wanted.topic} ({wanted.parameter}), which nothing in this launch "
            f"publishes: {where_published(message, others)}",
            key=f"{wanted.by} {wanted.topic}",
            related=[(it.span, f"{it.by} publishes {it.topic}") for it in others],
        )


_HEAD = "LaunchDescription([\n"
_NODE = """LaunchDescription([
        Node(package="{}", executable="{}",{}
             parameters=[os.path.join(HERE, "config", "a.yaml")]),
"""
_ODOMETRY = """- ros_topic_name: odom
  gz_topic_name: /model/rover/odometry
  ros_type_name: nav_msgs/msg/Odometry
  gz_type_name: gz.msgs.Odometry
  direction: GZ_TO_ROS
"""
_UNKNOWN = 'LaunchDescription([Node(package="acme_rover", executable="relay"),\n'
_MARK = "  # ^ WIR006"


def _example(
    program: str, yaml: str, bridge: object = _ODOMETRY, more: str = "", launch: str = _HEAD
) -> dict[str, object]:
    """Return a rover with a node whose input topic a parameter file sets."""
    node = _NODE.format(*program.split("/"), more).replace(_HEAD, launch)
    return {"@bridge": bridge, "@launch": {_HEAD: node}, "config/a.yaml": yaml}


def _filter(
    topic: str,
    bridge: object = _ODOMETRY,
    more: str = "",
    launch: str = _HEAD,
    key: str = "ekf_filter_node",
) -> dict[str, object]:
    yaml = f"{key}:\n  ros__parameters:\n    odom0: {topic}\n"
    return _example("robot_localization/ekf_node", yaml, bridge, more, launch)


_COSTMAP = """local_costmap:
  local_costmap:
    ros__parameters:
      plugins: [obstacle_layer]
      obstacle_layer:
        observation_sources: scan
        scan:
          topic: @
"""
_ROBOT = """<robot name="rover">
  <link name="base_link"/>
  <ros2_control name="base" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  </ros2_control>
  <gazebo>
    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
      <parameters>$(find acme_rover_bringup)/config/base.yaml</parameters>@
    </plugin>
  </gazebo>
</robot>
"""
_CONTROLLERS = """controller_manager:
  ros__parameters:
    base: {type: diff_drive_controller/DiffDriveController}
base:
  ros__parameters: {}
"""
_SPAWNER = 'LaunchDescription([Node(package="controller_manager", executable="spawner",\n'
_SPAWNER += '             arguments=["base"]),\n'


def _controlled_example(topic: str, remap: str = "") -> object:
    ros = f"<ros><remapping>{remap}</remapping></ros>" if remap else ""
    return {
        **_filter(topic, "[]\n", launch=_SPAWNER),
        "urdf/rover.urdf": _ROBOT.replace("@", ros),
        "config/base.yaml": _CONTROLLERS,
    }


_CLASSIC = """<launch>
  <include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="gazebo_ros" exec="spawn_entity.py" args="-topic robot_description -entity rover"/>
  <node pkg="slam_toolbox" exec="async_slam_toolbox_node">
    <param name="scan_topic" value="/scan"/>%
  </node>
</launch>
"""
_LIDAR = """<robot name="rover">
  <link name="base_link"/>
  <gazebo reference="base_link">
    <sensor name="lidar" type="ray">
      <plugin name="lidar" filename="libgazebo_ros_ray_sensor.so">
        <ros>@</ros><output_type>sensor_msgs/LaserScan</output_type>
      </plugin>
    </sensor>
  </gazebo>
</robot>
"""


def _classic(remap: str, mark: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/classic.launch.xml": _CLASSIC.replace("%", mark),
        "urdf/rover.urdf": _LIDAR.replace("@", remap),
    }


_CONTAINER = """<launch>
  <node pkg="urg_node" exec="urg_node_driver"/>
  <node_container pkg="rclcpp_components" exec="component_container" name="nav" namespace="">
    <composable_node pkg="nav2_amcl" plugin="nav2_amcl::AmclNode" name="amcl" namespace="r1">
      <param name="scan_topic" value="lidar"/>%
      <remap from="lidar" to="@"/>
    </composable_node>
  </node_container>
</launch>
"""


def _component(topic: str, mark: str = "") -> dict[str, object]:
    """Return a lidar whose scans a component reads by a remap."""
    launch = _CONTAINER.replace("@", topic).replace("%", mark)
    return {"@bridge": True, "launch/nav.launch.xml": launch}


_INCLUDED = """<launch>
  <node pkg="urg_node" exec="urg_node_driver"/>
  <include file="$(find-pkg-share slam_toolbox)/launch/online_async_launch.py">
    <arg name="slam_params_file" value="$(find-pkg-share acme_rover_bringup)/config/slam.yaml"/>
  </include>
</launch>
"""


def _included_example(topic: str) -> dict[str, object]:
    """Return a lidar in addition to the mapping of another package."""
    yaml = f"slam_toolbox:\n  ros__parameters:\n    scan_topic: {topic}\n"
    return {"@bridge": True, "launch/slam.launch.xml": _INCLUDED, "config/slam.yaml": yaml}


_RELAY = """LaunchDescription([
        Node(package="topic_tools", executable="relay",
             parameters=[{"input_topic": "/odom", "output_topic": "/wheel/odometry"}]),
"""
_PYTHON = "self.pub = self.create_publisher(Odometry, 'o_dom', 10)\n"
_OWN = _UNKNOWN.replace("acme_rover", "acme_rover_bringup")
_PUBLISHES = """pub_ = this->create_publisher<nav_msgs::msg::Odometry>(
    "o_dom", rclcpp::SensorDataQoS());
"""
GOOD = [
    {**_filter("/o_dom", launch=_OWN), "src/relay.cpp": _PUBLISHES},
    {**_filter("/o_dom", launch=_OWN), "nodes/a.py": _PYTHON},
    _filter("/wheel/odometry", launch=_RELAY),
    _included_example("/scan"),
    _component("/scan"),
    _filter("odom"),
    _filter("/odom"),
    _filter("wheel/odometry", "[]\n"),
    _filter("wheel/odometry", more=' remappings=[("wheel/odometry", "odom")],'),
    _filter("wheel/odometry\n    odom1: odom"),
    _controlled_example("base/odom"),
    _controlled_example("odom", "~/odom:=/odom"),
    _classic("<remapping>~/out:=scan</remapping>"),
    _classic("<argument>~/out:=scan</argument>"),
    _example("nav2_controller/controller_server", _COSTMAP.replace("@", "/scan"), True),
]
BAD = [
    _included_example(f"/lidar/scan{_MARK}"),
    _component("scan", "  <!-- ^ WIR006 -->"),
    _filter(f"wheel/odometry{_MARK}"),
    _filter(f"odometry{_MARK}", launch=_RELAY),
    _filter(f"odom{_MARK}", more=' namespace="rover",', key="/**"),
    _controlled_example(f"base/odometry{_MARK}"),
    _classic("<remapping>out:=scan</remapping>", "  <!-- ^ WIR006 -->"),
    _example(
        "nav2_controller/controller_server", _COSTMAP.replace("@", f"/lidar/scan{_MARK}"), True
    ),
    _filter(f"/o_dom{_MARK}", launch=_UNKNOWN),
]
