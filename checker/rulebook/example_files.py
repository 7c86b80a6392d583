"""The packages that examples of rules make: minimal ones, with the changes of the example.

`checker.rule_testing` describes the form of an example.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from importlib.resources import files
from typing import Any

from checker.base.record import Record
from checker.base.resources import PACKAGE

Example = str | Mapping[str, Any]
ROBOTS = ("rover",)
"""Robots that examples share: `rover` drives on four wheels by DiffDrive (checker/data/robots)."""

NAME = "acme_rover_sensor_config_1"

_HEAD = f"""<?xml version="1.0"?>
<sdf version="1.6">
<model name="{NAME}">
"""
_LINK_PARTS = ("sensor", "visual", "collision", "inertial", "light")
_TAIL = "</model>\n</sdf>\n"

SPAWNER = f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
  <spawn name="#{{_name}}">
    <name>#{{_name}}</name>
    <allow_renaming>false</allow_renaming>
    <pose>#{{_x}} #{{_y}} #{{_z + 0.2}} #{{_roll}} #{{_pitch}} #{{_yaw}}</pose>
    <world>#{{_worldName}}</world>
    <is_performer>true</is_performer>
    <sdf version="1.6">
      <include>
        <name>#{{_name}}</name>
        <uri>#{{_modelURI}}</uri>
      </include>
    </sdf>
  </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  <<-HEREDOC
  <executable name="description">
    <command>roslaunch --wait {NAME} description.launch world_name:=#{{_worldName}} name:=#{{_name}}</command>
  </executable>
  <executable name="topics">
    <command>roslaunch --wait {NAME} vehicle_topics.launch world_name:=#{{_worldName}} name:=#{{_name}}</command>
  </executable>
  HEREDOC
end
"""  # noqa: E501

MINIMAL: Mapping[str, str] = {
    "package.xml": f"""<package format="2">
  <name>{NAME}</name>
  <version>1.0.0</version>
  <description>A rover</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>
""",
    "CMakeLists.txt": f"""cmake_minimum_required(VERSION 3.0.2)
project({NAME})
find_package(catkin REQUIRED)
catkin_package()
install(DIRECTORY launch urdf worlds thumbnails
  DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})
install(FILES model.sdf model.config DESTINATION ${{CATKIN_PACKAGE_SHARE_DESTINATION}})
""",
    "model.config": f"""<model>
  <name>{NAME}</name>
  <sdf version="1.6">model.sdf</sdf>
</model>
""",
    "specifications.md": "# Acme Rover Sensor Config 1\n\n## Description\nA rover.\n",
    "launch/spawner.rb": SPAWNER,
    "launch/description.launch": (
        '<launch>\n<arg name="name"/>\n<arg name="world_name"/>\n</launch>\n'
    ),
    "launch/vehicle_topics.launch": (
        '<launch>\n<arg name="name"/>\n<arg name="world_name"/>\n</launch>\n'
    ),
    "launch/example.ign": "<ignition/>\n",
    "worlds/example.sdf": '<sdf version="1.6"><world name="w"/></sdf>\n',
    "urdf/robot_from_sdf.xacro": '<robot name="rover"/>\n',
    "thumbnails/1.png": "",
}


URDF_NAME = "acme_arm_description"

_ARM = """<robot name="arm">
  <link name="base_link"/>
  <link name="upper_arm"/>
  <joint name="shoulder" type="revolute">
    <parent link="base_link"/>
    <child link="upper_arm"/>
    <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="10" velocity="1"/>
  </joint>
@
</robot>
"""
_ARM_CONTROL = """  <transmission name="shoulder_transmission">
    <type>transmission_interface/SimpleTransmission</type>
    <joint name="shoulder">
      <hardwareInterface>hardware_interface/EffortJointInterface</hardwareInterface>
    </joint>
    <actuator name="shoulder_motor"/>
  </transmission>
  <gazebo>
    <plugin name="control" filename="libgazebo_ros_control.so">
      <robotNamespace>/arm</robotNamespace>
    </plugin>
  </gazebo>"""

URDF_MINIMAL: Mapping[str, str] = {
    "package.xml": MINIMAL["package.xml"].replace(NAME, URDF_NAME),
    "config/control.yaml": """arm:
  state_controller:
    type: joint_state_controller/JointStateController
    publish_rate: 50
  shoulder_controller:
    type: effort_controllers/JointPositionController
    joint: shoulder
    pid: {p: 10.0, i: 0.1, d: 0.0}
""",
    "launch/control.launch": f"""<launch>
  <rosparam file="$(find {URDF_NAME})/config/control.yaml" command="load"/>
  <node name="spawner" pkg="controller_manager" type="spawner" ns="/arm"
        args="state_controller shoulder_controller"/>
  <node name="states" pkg="robot_state_publisher" type="robot_state_publisher">
    <remap from="/joint_states" to="/arm/joint_states"/>
  </node>
</launch>
""",
    "launch/spawn.launch": f"""<launch>
  <param name="robot_description" textfile="$(find {URDF_NAME})/urdf/arm.urdf"/>
  <node name="spawn" pkg="gazebo_ros" type="spawn_model"
        args="-urdf -param robot_description -model arm"/>
</launch>
""",
}

BRIDGE_NAME = "acme_rover_bringup"
_LAUNCHED = "launch/rover.launch.py"


def _ament(name: str, description: str) -> dict[str, str]:
    """Return the manifest of a ROS 2 package, and the build that installs its folders."""
    return {
        "package.xml": f"""<package format="3">
  <name>{name}</name>
  <version>1.0.0</version>
  <description>{description}</description>
  <maintainer email="a@example.org">A</maintainer>
  <license>Apache-2.0</license>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
""",
        "CMakeLists.txt": f"""cmake_minimum_required(VERSION 3.8)
project({name})
find_package(ament_cmake REQUIRED)
install(DIRECTORY config launch urdf DESTINATION share/${{PROJECT_NAME}})
ament_package()
""",
    }


BRIDGE_MINIMAL: Mapping[str, str] = {
    **_ament(BRIDGE_NAME, "A rover in Gazebo"),
    "config/bridge.yaml": """- topic_name: clock
  ros_type_name: rosgraph_msgs/msg/Clock
  gz_type_name: gz.msgs.Clock
  direction: GZ_TO_ROS
- topic_name: scan
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
  direction: GZ_TO_ROS
- ros_topic_name: cmd_vel
  gz_topic_name: /model/rover/cmd_vel
  ros_type_name: geometry_msgs/msg/Twist
  gz_type_name: gz.msgs.Twist
  direction: ROS_TO_GZ
""",
    _LAUNCHED: f"""import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import IncludeLaunchDescription
from launch_ros.actions import Node

HERE = get_package_share_directory("{BRIDGE_NAME}")
URDF = os.path.join(HERE, "urdf", "rover.urdf")


def generate_launch_description():
    gazebo = os.path.join(get_package_share_directory("ros_gz_sim"), "launch", "gz_sim.launch.py")
    with open(URDF) as file:
        description = file.read()
    return LaunchDescription([
        IncludeLaunchDescription(gazebo, launch_arguments=[("gz_args", "-r empty.sdf")]),
        Node(package="robot_state_publisher", executable="robot_state_publisher",
             parameters=[{{"robot_description": description}}, {{"use_sim_time": True}}]),
        Node(package="ros_gz_sim", executable="create",
             arguments=["-name", "rover", "-file", URDF]),
        Node(package="ros_gz_bridge", executable="parameter_bridge", arguments=[],
             parameters=[{{"config_file": os.path.join(HERE, "config", "bridge.yaml")}}]),
    ])
""",
    "urdf/rover.urdf": """<robot name="rover">
  <link name="base_link"/>
  <link name="lidar_link"/>
  <joint name="lidar_joint" type="fixed">
    <parent link="base_link"/>
    <child link="lidar_link"/>
  </joint>
  <gazebo reference="lidar_link">
    <sensor name="lidar" type="gpu_lidar">
      <topic>scan</topic>
      <gz_frame_id>lidar_link</gz_frame_id>
    </sensor>
  </gazebo>
  <gazebo>
    <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
      <left_joint>left_wheel_joint</left_joint>
      <right_joint>right_wheel_joint</right_joint>
    </plugin>
  </gazebo>
</robot>
""",
}


ROS2_NAME = "acme_arm_bringup"

_ROS2_ARM = _ARM.replace("@\n", "").replace(
    '<robot name="arm">', '<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">'
)
_ROS2_LAUNCH = f"""import os
from ament_index_python.packages import get_package_share_directory
from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, ExecuteProcess, IncludeLaunchDescription
from launch.conditions import IfCondition, UnlessCondition
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def in_package(*parts):
    return PathJoinSubstitution([FindPackageShare('{ROS2_NAME}'), *parts])


def generate_launch_description():
    robot = Command(['xacro ', in_package('urdf', 'arm.urdf.xacro')])
    return LaunchDescription([
@
    ])
"""
_ROS2_STATE = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': ParameterValue(robot, value_type=str)}]),"""

ROS2_MINIMAL: Mapping[str, str] = {
    **_ament(ROS2_NAME, "An arm"),
    "urdf/arm.urdf.xacro": _ROS2_ARM,
    "config/arm.yaml": "arm:\n  ros__parameters: {rate: 10}\n",
}


MJCF_NAME = "acme_arm"


def model_with(fragment: str) -> str:
    """Return a model.sdf that contains a fragment where its first element belongs."""
    first = re.search(r"<([A-Za-z_][\w:.-]*)", fragment)
    tag = first.group(1) if first else ""
    if tag == "sdf" or fragment.lstrip().startswith("<?xml"):
        return fragment.lstrip("\n")
    if tag in _LINK_PARTS:
        return f'{_HEAD}<link name="base_link">\n{fragment}\n</link>\n{_TAIL}'
    return f'{_HEAD}<link name="base_link"/>\n{fragment}\n{_TAIL}'


class ExamplePackage(Record):
    """The package of an example.

    Attributes:
        name: Name of its folder.
        files: Their contents by path; `../other/package.xml` is a file of a sibling.
        links: Targets of symbolic links by path.
    """

    name: str
    files: Mapping[str, str | bytes]
    links: Mapping[str, str]


def example_package(example: Example) -> ExamplePackage:
    """Return the package that an example makes."""
    changes: dict[str, Any] = {"@fragment": example} if isinstance(example, str) else dict(example)
    name, contents = _base(changes)
    for path, text in changes.items():
        if path == "@fragment":
            contents["model.sdf"] = model_with(text)
        elif not path.startswith("@"):
            contents[path] = text
    if "@robot" in changes or "@change" in changes:
        robot = _robot(changes["@robot"]) if "@robot" in changes else str(contents["model.sdf"])
        contents["model.sdf"] = _changed(robot, changes.get("@change", {}))
    existing = {path: content for path, content in contents.items() if content is not None}
    return ExamplePackage(changes.get("@name", name), existing, changes.get("@links", {}))


def minimal_package(example: Example) -> ExamplePackage:
    """Return the minimal package that an example changes."""
    kinds = {} if isinstance(example, str) else example
    return example_package({kind: True for kind in ("@urdf", "@ros2", "@bridge") if kind in kinds})


def _base(changes: Mapping[str, Any]) -> tuple[str, dict[str, str | bytes | None]]:
    """Return the name and the files of the package that an example changes."""
    if (mjcf := changes.get("@mjcf")) is not None:
        return MJCF_NAME, {"arm.xml": f'<mujoco model="arm">\n{mjcf}\n</mujoco>\n'}
    if (bridge := changes.get("@bridge")) is not None:
        own = {} if bridge is True else {"config/bridge.yaml": bridge}
        launched = _changed(BRIDGE_MINIMAL[_LAUNCHED], changes.get("@launch", {}))
        return BRIDGE_NAME, {**BRIDGE_MINIMAL, **own, _LAUNCHED: launched}
    if (ros2 := changes.get("@ros2")) is not None:
        entities = _ROS2_STATE if ros2 is True else ros2.strip("\n")
        launch = _ROS2_LAUNCH.replace("@", entities)
        return ROS2_NAME, {**ROS2_MINIMAL, "launch/arm.launch.py": launch}
    if (urdf := changes.get("@urdf")) is not None:
        inside = _ARM_CONTROL if urdf is True else urdf
        return URDF_NAME, {**URDF_MINIMAL, "urdf/arm.urdf": _ARM.replace("@", inside)}
    return NAME, {**MINIMAL, "model.sdf": model_with("")}


def _robot(name: str) -> str:
    return files(PACKAGE).joinpath("data", "robots", f"{name}.sdf").read_text("utf-8")


def _changed(text: str, changes: Mapping[str, str]) -> str:
    for old, new in changes.items():
        if old not in text:
            raise ValueError(f"the example changes {old!r}, which the robot does not hold")
        text = text.replace(old, new)
    return text
