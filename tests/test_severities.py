"""How grave a finding is depends on what the target suffers from it (docs/severity.md)."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from checker.pipeline import check_package
from checker.rule_testing import Example, write_example
from checker.settings import Settings

SIBLING = "../acme_rover_sensor_config_2/package.xml"
DEPENDS = """<package format="2">
  <name>acme_rover_sensor_config_1</name>
  <exec_depend>acme_rover_sensor_config_2</exec_depend>
</package>
"""
LINKED = {SIBLING: "<package/>", "@links": {"shared.xml": SIBLING}}
SHEET = "../acme_rover_sensor_config_2/specifications.md"
HELD = {"specifications.md": None, SIBLING: "<package/>"}
MESH = '<visual name="v"><geometry><mesh><uri>a.dae</uri></mesh></geometry></visual>'
OTHER_MESH = "../acme_rover_sensor_config_2/meshes/a.dae"
LEAVING = MESH.replace("a.dae", OTHER_MESH)
WHEEL = """
<link name="wheel">
  <collision name="c">
    <pose>0 0 0 1.5708 0 0</pose>
    <geometry><cylinder><radius>0.1</radius><length>0.1</length></cylinder></geometry>
  </collision>
</link>
"""
MADE = """<model><name>Wood</name><version>1.0</version>
<author><name>A</name><email>a@example.org</email></author><description>Trees</description>
<sdf version="1.6">made.sdf</sdf></model>
"""
UNMOVED = """<static>1</static><link name="wall"><inertial><mass>1</mass>
<inertia><ixx>nan</ixx><iyy>1</iyy><izz>1</izz></inertia></inertial></link>"""
CLOCKLESS = """- topic_name: scan
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
"""
TWICE_HELD = """{}<link name="shelf"/><link name="board"/>
<joint name="left" type="fixed"><parent>base_link</parent><child>board</child></joint>
<joint name="right" type="fixed"><parent>shelf</parent><child>board</child></joint>
"""
STAGE = """<sdf version="1.9"><world name="stage">
  <plugin filename="gz-sim-user-commands-system" name="gz::sim::systems::UserCommands"/>
  <plugin filename="gz-sim-scene-broadcaster-system" name="gz::sim::systems::SceneBroadcaster"/>
  <model name="prop">{}</model>
</world></sdf>
"""


def sdf(version: str) -> str:
    return f'<sdf version="{version}"><model name="rover"><link name="base_link"/></model></sdf>'


def metal(inside: str) -> str:
    return f"""
<visual name="v"><geometry><box><size>1 1 1</size></box></geometry>
  <material><pbr><metal>{inside}</metal></pbr></material>
</visual>
"""


def spawned(robot: str) -> dict[str, object]:
    """Return a robot that a launch file puts into Gazebo."""
    return {
        "@ros2": """Node(package='robot_state_publisher', executable='robot_state_publisher',
    parameters=[{'robot_description': Command(['xacro ', in_package('urdf', 'arm.urdf.xacro')])}]),
Node(package='ros_gz_sim', executable='create', arguments=['-topic', 'robot_description']),""",
        "urdf/arm.urdf.xacro": f'<robot name="arm"><link name="base_link"/>{robot}</robot>',
    }


def friction(inside: str) -> str:
    return f"""
<collision name="c"><geometry><box><size>1 1 1</size></box></geometry>
  <surface><friction><ode>{inside}</ode></friction></surface>
</collision>
"""


BRIDGE = """- topic_name: /model/{}/odometry
  ros_type_name: {}
  gz_type_name: gz.msgs.{}
  direction: GZ_TO_ROS
"""
JOINTS = """- topic_name: /model/rover/joint_state
  ros_type_name: sensor_msgs/msg/JointState
  gz_type_name: gz.msgs.Model
  direction: GZ_TO_ROS
"""
PUBLISHES_JOINTS = {
    "LaunchDescription([": """LaunchDescription([
        Node(package="joint_state_publisher", executable="joint_state_publisher"),"""
}
TOOL = '<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tool"/></joint>'
EMPTY_COPY = {
    "arm.urdf": "",
    "parts/arm.urdf": "<robot name='arm'/>",
    "launch/b.launch": "<launch><param name='a' textfile='$(find a)/parts/arm.urdf'/></launch>",
}
XACRO = "name='arm' xmlns:xacro='http://www.ros.org/wiki/xacro'"
EMPTY_PART = {
    "urdf/tool.xacro": "",
    "urdf/wrist.xacro": f"<robot {XACRO}><xacro:include filename='tool.xacro'/></robot>",
    "urdf/arm.xacro": f"<robot {XACRO}><xacro:include filename='wrist.xacro'/></robot>",
}
_INSTALLED = "install(DIRECTORY launch urdf worlds thumbnails DESTINATION share)\n"
MESHES = {
    "CMakeLists.txt": f"project(a)\n{_INSTALLED}install(FILES model.sdf DESTINATION share)\n",
    "meshes/arm.dae": "<COLLADA/>",
    "urdf/a.urdf": "<mesh filename='meshes/arm.dae'/>",
}
ABSENT = """<package format="3">
  <name>acme_arm_bringup</name>
  <depend>acme_drivers</depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
BESIDE = {"../acme_tools/package.xml": "<package><name>acme_tools</name></package>"}
NAMED_IN_README = {"README.md": "Clone acme_drivers too.\n"}
CONFIGURED = {
    "@ros2": True,
    "CMakeLists.txt": "project(acme_arm_bringup)\nfind_package(ament_cmake_auto REQUIRED)\n"
    "ament_auto_package(INSTALL_TO_SHARE launch urdf)\n",
    "config/arm.yaml": "arm: 1\n",
}
READS_CONFIG = "Node(package='p', executable='e', parameters=[in_package('config', 'arm.yaml')]),"
HUNG = """<link name="foot"/>
<joint name="j" type="floating"><parent link="base_link"/><child link="foot"/></joint>"""
ONLY_SHOWN = {
    "config/control.yaml": None,
    "launch/control.launch": None,
    "launch/spawn.launch": None,
    "launch/show.launch": """<launch>
  <param name="robot_description" textfile="$(find acme_arm_description)/urdf/arm.urdf"/>
  <node name="s" pkg="robot_state_publisher" type="robot_state_publisher"/>
</launch>""",
}
ABROAD = "/home/ann/ws/arm/arm.urdf"
DESCRIBES = "Node(package='p', executable='e', parameters=[{'robot_description': %s}]),"
COPIES = {
    "CMakeLists.txt": None,
    "setup.py": """from glob import glob
from setuptools import setup
setup(name="a", data_files=[("share/a", glob("*/*.*"))])
""",
    **dict.fromkeys(("meshes/arm.dae", "meshes/old/arm.dae"), "<COLLADA/>"),
}
LEFTOVER = f"""<link name="tool"/>{TOOL}
<transmission name="t"><type>transmission_interface/SimpleTransmission</type>
  <joint name="j"><hardwareInterface>EffortJointInterface</hardwareInterface></joint>
  <actuator name="m"/>
</transmission>
"""
READ = '<gazebo><plugin name="p" filename="libgazebo_ros_control.so"/></gazebo>'
DRAWN = f"""{TOOL}<link name="tool">
  <visual><geometry><mesh filename="package://acme_arm_description/meshes/a.obj"/></geometry></visual>
</link>
"""
CAMERA = '<gazebo reference="tool"><sensor name="c" type="camera"/></gazebo>'
FINE = {"meshes/a.obj": "v 0 0 0\nv 1 0 0\nv 0 1 0\n" + "f 1 2 3\n" * 201_000}

CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 0.1) for y in (0, 0.1) for z in (0, 0.1))
SIDES = ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4")
BRACKET = """
<inertial><mass>{mass}</mass><inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial>
<collision name="c"><geometry>{shape}</geometry></collision>
"""
HOLDER = f"""
<link name="body">
  <inertial><mass>{{}}</mass><inertia><ixx>90</ixx><iyy>90</iyy><izz>90</izz></inertia></inertial>
  <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
</link>
<link name="holder">{BRACKET.format(mass=10, shape="<sphere><radius>0.05</radius></sphere>")}</link>
<joint name="mount" type="{{}}">
  <parent>body</parent><child>holder</child><axis><xyz>0 0 1</xyz></axis>
</joint>
"""
DRAWN_CUBE = {"meshes/cube.obj": CUBE + "".join(f"f {side}\n" for side in SIDES)}
CUBE_MESH = "<mesh><uri>meshes/cube.obj</uri></mesh>"
CUBE_BOX = "<box><size>0.1 0.1 0.1</size></box>"
SCANNER = """<link name="plate"><visual><geometry><box size="1 1 0.1"/></geometry></visual></link>
<link name="lidar"><visual><geometry><box size="0.1 0.1 0.1"/></geometry></visual></link>
<joint name="foot" type="fixed"><parent link="base_link"/><child link="plate"/></joint>
<joint name="mast" type="{}"><origin xyz="{}"/><parent link="plate"/><child link="lidar"/></joint>
"""
ARM = """
<link name="arm"><gravity>0</gravity></link>
<joint name="j" type="revolute"><parent>base_link</parent><child>arm</child></joint>
"""

COARSE = """<link name="ball"><inertial><mass>1</mass>
<inertia><ixx>0.0001</ixx><iyy>0.0001</iyy><izz>0.0003</izz></inertia></inertial>
<sensor name="s" type="imu"/></link>
"""
"""Moments that rounding to four decimals makes impossible."""
FEW = """<sensor name="vlp16" type="gpu_lidar"><update_rate>10</update_rate><lidar><scan>
<horizontal><samples>440</samples><min_angle>-3.14159</min_angle><max_angle>3.14159</max_angle>
</horizontal><vertical><samples>16</samples></vertical></scan></lidar></sensor>
"""
CONTROLLED = """<robot name="arm" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:arg name="gazebo" default="false"/>
<link name="base_link"/>
<ros2_control name="arm" type="system">
  <hardware><xacro:if value="$(arg gazebo)"><plugin>a/B</plugin></xacro:if></hardware>
</ros2_control>
</robot>
"""
CHOSEN = {"@urdf": True, "urdf/arm.urdf": None, "urdf/arm.urdf.xacro": CONTROLLED}
MESH_WHEEL = """<robot name="rover"><link name="base_link"/>
<link name="left_wheel"><collision><geometry>{}</geometry></collision></link>
<link name="right_wheel"><collision><geometry>
  <mesh filename="package://acme_rover_bringup/meshes/wheel.stl"/>
</geometry></collision></link>
<joint name="left" type="continuous"><origin xyz="0 0.2 0"/><axis xyz="0 1 0"/>
  <parent link="base_link"/><child link="left_wheel"/></joint>
<joint name="right" type="continuous"><origin xyz="0 -0.2 0"/><axis xyz="0 1 0"/>
  <parent link="base_link"/><child link="right_wheel"/></joint>
</robot>
"""
OFF_PATH = '<mesh filename="package://acme_rover_bringup/meshes/wheel.stl"/>'
ROLLING = {"@bridge": True, "urdf/rover.urdf": MESH_WHEEL.format(OFF_PATH)}
ON_A_BALL = {"@bridge": True, "urdf/rover.urdf": MESH_WHEEL.format('<sphere radius="0.1"/>')}
DRAWN_WHEEL = """<link name="wheel">
  <visual name="v">
    <geometry><cylinder><radius>0.1</radius><length>0.05</length></cylinder></geometry>
  </visual>
</link>
<joint name="axle" type="revolute">
  <parent>base_link</parent><child>wheel</child><axis><xyz>0 1 0</xyz></axis>
</joint>
<plugin filename="libp.so" name="ignition::gazebo::systems::DiffDrive">
  <left_joint>axle</left_joint>
</plugin>
"""
TOUCHING_WHEEL = DRAWN_WHEEL.replace("visual", "collision")
FORMER = {"@ros2": "        Node(package='p', node_executable='e'),"}


def left_out(macro: str) -> dict[str, str | bool]:
    """Return a camera that calls a macro, beside a robot that a launch file loads."""
    head = "<robot name='arm' xmlns:xacro='http://ros.org/wiki/xacro'>"
    return {
        "@urdf": True,
        "urdf/parts.xacro": f"{head}<xacro:macro name='lens' params=''/></robot>",
        "urdf/camera.xacro": f"{head}<link name='eye'/><xacro:{macro}/></robot>",
    }


NAMELESS = {
    "@ros2": True,
    "launch/lens.launch.py": """from launch import LaunchDescription
from launch_ros.actions import LifecycleNode


def generate_launch_description():
    return LaunchDescription([LifecycleNode(package='p', executable='e', name='lens')])
""",
}
LEFT = {
    "package.xml": """<package format="3">
  <name>acme_can</name>
  <buildtool_depend>ament_cmake</buildtool_depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
""",
    "CMakeLists.txt": "project(acme_can)\n"
    "install(DIRECTORY urdf worlds thumbnails DESTINATION share/acme_can)\n"
    "install(FILES model.sdf DESTINATION share/acme_can)\n",
    "launch/description.launch": '<launch><node pkg="acme_can" type="can" name="can"/></launch>',
    **dict.fromkeys(("launch/spawner.rb", "launch/example.ign", "launch/vehicle_topics.launch")),
}
DRIVE = '<plugin filename="libp.so" name="ignition::gazebo::systems::{name}">{inside}</plugin>'
LINEAR = "".join(
    f"<{end}_linear_{kind}>{sign}1</{end}_linear_{kind}>"
    for end, sign in (("min", "-"), ("max", ""))
    for kind in ("velocity", "acceleration")
)
COPTER = "".join(
    f"<maximumLinear{kind}>3 3 3</maximumLinear{kind}>" for kind in ("Velocity", "Acceleration")
)
REPLACED = {
    "package.xml": """<package format="3">
  <name>acme_rover_sensor_config_1</name>
  <depend>gazebo_ros_pkgs</depend>
  <export><build_type>ament_cmake</build_type></export>
</package>
"""
}
MOTOR = """<ros2_control name="{name}" type="system">
  <hardware><plugin>{plugin}</plugin></hardware>
  <joint name="lift"><command_interface name="position"/></joint>
</ros2_control>
"""
LIFT = """<link name="fork"/>
<joint name="lift" type="prismatic"><parent link="upper_arm"/><child link="fork"/>
  <limit lower="0" upper="1" effort="5" velocity="0"/></joint>
"""
GZ = MOTOR.format(name="gz", plugin="gz_ros2_control/GazeboSimSystem")
RUNS = """<gazebo><plugin filename="gz_ros2_control-system"
  name="gz_ros2_control::GazeboSimROS2ControlPlugin"/></gazebo>"""
OTHERWISE = "<!-- or gz_ros2_control/GazeboSimSystem -->"
MOCK = MOTOR.format(name="mock", plugin="mock_components/GenericSystem")
HINGE = """
<link name="hinge"/>
<joint name="hinge" type="fixed"><parent>base_link</parent><child>hinge</child></joint>
"""
SUN = '<light name="lamp" type="sun"/>'
UNCOLOURED = """
<visual name="v">
  <geometry><sphere><radius>1</radius></sphere></geometry>
  <material><script><name>Gazebo/Red</name></script></material>
</visual>
"""
CLASSIC_DRIVE = """
<plugin filename="libgazebo_ros_diff_drive.so" name="drive">
  <command_topic>{topic}</command_topic>
  <ros><remapping>cmd_vel:=wheels/cmd</remapping></ros>
</plugin>
"""
FRICTION = """
<collision name="c">
  <surface><friction><ode><mu>0.9</mu></ode><ode>{second}</ode></friction></surface>
</collision>
"""
LOST = '<gazebo reference="caster">{}</gazebo>'
SHIFTED = """<link name="tip"><collision>
  <origin pry="{}"/><geometry><box size="1 1 1"/></geometry>
</collision></link>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>"""
CONFLICT = {
    "@ros2": True,
    "arm/__init__.py": "",
    "arm/tools.py": "<<<<<<< HEAD\nb = 1\n=======\nb = 2\n>>>>>>> other\n",
}
EKF = f"""ekf:
  ros__parameters:
    two_d_mode: true  ?
    imu0_config: [{", ".join(["true"] * 15)}]
"""
SCAN = '<launch><node pkg="acme_tools" exec="{}"/></launch>'
HEAVY_BODY = """
<link name="body">
  <inertial><mass>100</mass><inertia><ixx>4</ixx><iyy>4</iyy><izz>4</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.5</radius></sphere></geometry></collision>
</link>
<link name="eye">
  <inertial><mass>0.1</mass><inertia><ixx>{0}</ixx><iyy>{0}</iyy><izz>{0}</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.05</radius></sphere></geometry></collision>
</link>
<joint name="neck" type="revolute">
  <parent>body</parent><child>eye</child><axis><xyz>0 0 1</xyz></axis>
</joint>
"""
PLANAR = """<link name="eye"/>
<joint name="j" type="fixed"><parent link="base_link"/><child link="eye"/></joint>
<link name="post"><visual><origin xyz="0.3 0 0"/>
  <geometry><box size="0.02 0.02 1"/></geometry></visual></link>
<joint name="k" type="fixed"><parent link="eye"/><child link="post"/></joint>
<gazebo reference="eye"><sensor name="scan" type="gpu_lidar"><ray>
  <scan><horizontal><samples>720</samples><min_angle>-1</min_angle><max_angle>1</max_angle>
  </horizontal></scan><range><min>0.1</min><max>10</max></range></ray></sensor></gazebo>"""
TURNING = """<link name="arm"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><box size="1 1 1"/></geometry></visual>
<collision><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="j" type="continuous"><parent link="base_link"/><child link="arm"/></joint>"""
DISPLAYED = """Node(package='robot_state_publisher', executable='robot_state_publisher',
parameters=[{'robot_description': Command(['xacro ', in_package('urdf', 'arm.urdf.xacro')])}]),"""
UNSHAPED = TURNING.replace('<geometry><box size="1 1 1"/></geometry>', "", 1)
UNREADABLE = TURNING.replace("</joint>", '<limit effort="1 N"/></joint>')
LENS = """<link name="lens"><colision><geometry><box size="1 1 1"/></geometry></colision></link>
<joint name="j" type="{}"><parent link="mast"/><child link="lens"/><axis xyz="1 0 0"/></joint>
<link name="mast"><collision><geometry><box size="1 1 1"/></geometry></collision></link>
<joint name="k" type="fixed"><parent link="upper_arm"/><child link="mast"/></joint>"""
CLASSIC_2 = {
    "@profile": "gazebo-classic",
    "@ros2": True,
    "urdf/arm.urdf.xacro": None,
    "show.py": "image_raw = 'front/image'\n",
}
EYE = """<sensor name="eye" type="camera">
  <plugin filename="libgazebo_ros_camera.so" name="eye"><imageTopicName>{}</imageTopicName></plugin>
</sensor>"""
SHOWN = f"""<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
  <link name="base_link"/>
  <gazebo reference="base_link">{EYE.format("front/image")}</gazebo>
</robot>
"""
SPAWNED = """        Node(package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{'robot_description': ParameterValue(robot, value_type=str)}]),
        Node(package='gazebo_ros', executable='spawn_entity.py',
             arguments=['-entity', 'arm', '-file', '/opt/models/arm.sdf']),"""
PICTURE = '<visual name="v"><geometry><box><size>{}</size></box></geometry></visual>'
POINT = """<collision name="c">
  <geometry><sphere><radius>{}</radius></sphere></geometry></collision>"""
SCENERY = """<sdf version="1.6"><model name="walls">{}<link name="link">
<collision name="c"><geometry><mesh><uri>meshes/a.obj</uri></mesh></geometry></collision>
</link></model></sdf>
"""
PAINTED = """<visual name="v">
  <geometry><mesh><uri>meshes/part.obj</uri></mesh></geometry>{}
</visual>
"""
UNPAINTED = {
    "meshes/part.obj": "mtllib part.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "meshes/part.mtl": "newmtl paint\nmap_Kd a.png\n",
}
GREY = "<material><diffuse>0.5 0.5 0.5 1</diffuse></material>"
TWICE = "".join(
    BRIDGE.format("a", f"nav_msgs/msg/{it}", "Odometry") for it in ("Odometry", "odometry")
)

GRIP = DRAWN_WHEEL.replace("visual", "collision").replace(
    "</geometry>",
    "</geometry><surface><friction><ode><mu>150</mu><mu2>150</mu2></ode></friction></surface>",
)
REAR_GRIP = (
    GRIP.replace('"wheel"', '"rear"').replace(">wheel<", ">rear<").replace('"axle"', '"rear_axle"')
)
SKIDDING = REAR_GRIP.partition("<plugin")[0] + GRIP.replace(
    "</plugin>", "<left_joint>rear_axle</left_joint></plugin>"
)

MAP = "image: no.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.6\n"
MAP += "free_thresh: 0.2\n"
HALL = """<launch><node pkg="nav2_map_server" exec="map_server">
<param name="yaml_filename" value="$(find-pkg-share acme_rover_bringup)/maps/hall.yaml"/>
</node></launch>"""
SERVED = {"@bridge": True, "launch/map.launch.xml": HALL}
GOOD_MAP = {"maps/hall.yaml": MAP.replace("no.pgm", "hall.pgm"), "maps/hall.pgm": "P5 1 1 255\n0"}

OF_ROS_1 = '<plugin filename="libgazebo_ros_{}.so" name="p"/>'

CASES: list[tuple[str, Example, str]] = [
    ("SDF013", FRICTION.format(second=""), "info"),
    ("SDF013", FRICTION.format(second="<mu>1</mu>"), "warning"),
    ("DRV002", DRIVE.format(name="DiffDrive", inside=LINEAR), "warning"),
    ("DRV002", DRIVE.format(name="MulticopterVelocityControl", inside=COPTER), "error"),
    ("R2C003", CHOSEN, "warning"),
    ("R2C005", {"@urdf": LIFT + MOCK + RUNS}, "warning"),
    ("R2C005", spawned(LIFT + MOCK + RUNS), "error"),
    ("R2C005", spawned(LIFT + MOCK + RUNS + OTHERWISE), "warning"),
    ("R2C016", {"@urdf": LIFT + MOCK + GZ}, "error"),
    ("R2C016", {"@urdf": LIFT + GZ + MOCK}, "warning"),
    ("BRG002", {"@bridge": BRIDGE.format("a", "nav_msgs/msg/odometry", "Odometry")}, "error"),
    ("BRG002", {"@bridge": TWICE}, "warning"),
    ("BRG004", {"@bridge": BRIDGE.format("a", "nav_msgs/msg/Odometry", "Odometry")}, "warning"),
    ("BRG004", {"@bridge": JOINTS}, "warning"),
    ("BRG004", {"@bridge": JOINTS, "@launch": PUBLISHES_JOINTS}, "info"),
    ("GEO001", WHEEL, "warning"),
    ("GEO001", WHEEL.replace("wheel", "mast"), "info"),
    ("INE006", BRACKET.format(mass=30, shape=CUBE_BOX), "warning"),
    ("INE006", HOLDER.format(150, "fixed"), "warning"),
    ("INE006", HOLDER.format(300, "fixed"), "info"),
    ("INE006", HOLDER.format(300, "revolute"), "warning"),
    (
        "INE006",
        {"@fragment": BRACKET.format(mass=20, shape=CUBE_MESH), **DRAWN_CUBE},
        "info",
    ),
    (
        "INE006",
        {"@fragment": BRACKET.format(mass=30, shape=CUBE_MESH), **DRAWN_CUBE},
        "warning",
    ),
    ("URD001", left_out("lens"), "info"),
    ("URD001", left_out("lnes"), "error"),
    ("URD006", {"@urdf": LOST.format("<mu1>0.9</mu1><mu2>1.2</mu2><kp>1e6</kp>")}, "warning"),
    ("URD006", {"@urdf": LOST.format("<mu1>0.01</mu1>")}, "warning"),
    ("URD006", {"@urdf": LOST.format("<fdir1>1 0 0</fdir1>")}, "error"),
    ("URD006", {"@urdf": LOST.format("<mu1>1</mu1><slip1>0</slip1>")}, "info"),
    ("PKG024", {**CONFLICT, "arm/run.py": "from arm import shapes\n"}, "warning"),
    ("PKG024", {**CONFLICT, "arm/run.py": "from arm import tools\n"}, "error"),
    ("WIR025", {"@bridge": True, "config/ekf.yaml": EKF.replace("?", "")}, "warning"),
    ("WIR025", {"@bridge": True, "config/ekf.yaml": EKF.replace("?", "\n    # imu0: imu")}, "info"),
    ("INE004", HEAVY_BODY.format(0.001), "info"),
    ("INE004", HEAVY_BODY.format(100), "warning"),
    ("SEN019", spawned(PLANAR.replace("0.02 0.02 1", "0.02 0.3 1")), "info"),
    ("SEN019", spawned(PLANAR.replace("0.02 0.02 1", "0.02 2 1")), "warning"),
    ("WIR014", {"@ros2": DESCRIBES % f"open('{ABROAD}').read()"}, "error"),
    ("WIR014", {"@ros2": DESCRIBES % f"Command(['xacro ', '{ABROAD}'])"}, "error"),
    ("WIR014", {"@ros2": DESCRIBES % f"'{ABROAD}'"}, "warning"),
    (
        "WIR014",
        {"@urdf": True, "launch/a.launch": f"<launch><rosparam file='{ABROAD}'/></launch>"},
        "error",
    ),
    ("SEN029", {**spawned(PLANAR), "launch/scan.launch.xml": SCAN.format("view")}, "warning"),
    ("SEN029", {**spawned(PLANAR), "launch/scan.launch.xml": SCAN.format("scan_filter")}, "info"),
    ("URD007", spawned(TURNING), "error"),
    ("URD007", {**spawned(TURNING), "@ros2": DISPLAYED}, "info"),
    ("URD012", spawned(UNSHAPED), "error"),
    ("URD012", {**spawned(UNSHAPED), "@ros2": DISPLAYED}, "warning"),
    ("URD012", {**spawned(UNREADABLE), "@ros2": DISPLAYED}, "error"),
    ("URD015", {"@urdf": SHIFTED.format("0 0 0")}, "info"),
    ("URD015", {"@urdf": SHIFTED.format("0 0 1")}, "error"),
    ("URD015", {"@urdf": LENS.format("fixed")}, "warning"),
    ("URD015", {"@urdf": LENS.format("continuous")}, "error"),
    ("WIR015", {**SERVED, "maps/hall.yaml": MAP}, "error"),
    ("WIR015", {**SERVED, **GOOD_MAP, "maps/attic/hall.yaml": MAP}, "warning"),
    *(
        ("PLG012", {**CLASSIC_2, "@fragment": OF_ROS_1.format(library)}, severity)
        for library, severity in (("laser", "error"), ("api_plugin", "warning"))
    ),
    ("PLG012", {**CLASSIC_2, "@fragment": EYE.format("image_raw")}, "warning"),
    ("PLG012", {**CLASSIC_2, "@fragment": EYE.format("front/image")}, "error"),
    (
        # RViz shows the topic that ROS 2 publishes.
        "PLG012",
        {
            **CLASSIC_2,
            "@fragment": EYE.format("front/image"),
            "show.rviz": "Topic: /eye/image_raw\n",
        },
        "warning",
    ),
    (
        # Gazebo gets another file.
        "PLG012",
        {
            "@profile": "ros2-classic",
            "@ros2": SPAWNED,
            "urdf/arm.urdf.xacro": SHOWN,
            "show.py": "image = 'front/image'\n",
        },
        "warning",
    ),
    ("URD006", {"@urdf": LOST.format('<sensor name="eye" type="camera"/>')}, "error"),
    ("KIN007", {"@urdf": LIFT + GZ}, "error"),
    ("KIN008", {"@urdf": HUNG}, "error"),
    ("KIN008", {"@urdf": HUNG, **ONLY_SHOWN}, "warning"),
    ("LCH004", {"@ros2": "Node(package='p', node_executable='e', node_name='n'),"}, "error"),
    ("LCH004", NAMELESS, "error"),
    ("LCH004", {**NAMELESS, "README.md": "# Lens\n\nFor ROS 2 Foxy.\n"}, "warning"),
    ("BRG008", {"@bridge": CLOCKLESS}, "warning"),
    ("SDF013", "<static>1</static><static>true</static>", "info"),
    ("KIN002", TWICE_HELD.format("<static>true</static>"), "info"),
    ("KIN016", ARM, "info"),
    ("KIN016", ARM.replace("revolute", "fixed"), "warning"),
    ("GEO003", DRAWN_WHEEL, "warning"),
    ("GEO009", GRIP, "warning"),
    ("GEO012", {"@urdf": SCANNER.format("fixed", "0.2 0 0.2")}, "info"),
    ("GEO012", {"@urdf": SCANNER.format("prismatic", "0.2 0 0.2")}, "warning"),
    ("GEO012", {"@urdf": SCANNER.format("fixed", "0.2 0 0.4")}, "warning"),
    ("GEO012", {"@urdf": SCANNER.format("fixed", "0.6 0 0.2")}, "warning"),
    ("GEO003", TOUCHING_WHEEL, "error"),
    ("LCH012", ROLLING, "error"),
    ("LCH012", ON_A_BALL, "warning"),
    ("LCH004", FORMER, "error"),
    ("LCH004", {**FORMER, "README.md": "A rover with ROS 2 Foxy\n"}, "warning"),
    ("LCH004", {**FORMER, "README.md": "A rover with ROS 2 Humble\n"}, "error"),
    ("PKG003", {"specifications.md": None}, "error"),
    ("PKG003", {**HELD, SHEET: "# Rover\nsensor_config_1 has no lidar\n"}, "warning"),
    ("PKG003", {**HELD, SHEET: "# Rover\nconfiguration 12\n"}, "error"),
    ("PKG003", {"thumbnails/1.png": None}, "info"),
    ("PKG021", {"@ros2": True, "package.xml": ABSENT}, "info"),
    ("PKG021", {"@ros2": True, "package.xml": ABSENT, **BESIDE}, "warning"),
    ("PKG021", {"@ros2": True, "package.xml": ABSENT, **BESIDE, **NAMED_IN_README}, "info"),
    ("PKG008", CONFIGURED, "warning"),
    ("PKG008", {**CONFIGURED, "@ros2": READS_CONFIG}, "error"),
    ("PKG008", LEFT, "info"),
    ("PKG008", {**LEFT, "launch/b.launch.py": "def generate_launch_description(): ..."}, "error"),
    ("SDF001", {"arm.urdf": ""}, "warning"),
    ("SDF001", {"arm.urdf": "", "launch/b.launch": "<launch><!-- arm.urdf --></launch>"}, "error"),
    ("SDF001", EMPTY_COPY, "warning"),
    ("SDF001", EMPTY_PART, "warning"),
    ("SDF001", {**EMPTY_PART, "launch/b.launch": "<launch><!-- arm.xacro --></launch>"}, "error"),
    (
        "PKG008",
        {**LEFT, "launch/description.launch": None, "launch/part.py": "GATES = [Node()]"},
        "info",
    ),
    ("PKG008", MESHES, "error"),
    ("PKG008", {**MESHES, "urdf/a.urdf": "<mesh filename='other.dae'/>"}, "info"),
    ("PKG008", {**MESHES, "urdf/a.urdf": "<mesh filename='${name}.dae'/>"}, "error"),
    ("PKG008", {**COPIES, "urdf/a.urdf": "<mesh filename='meshes/old/arm.dae'/>"}, "error"),
    ("PKG008", {**COPIES, "urdf/a.urdf": "<mesh filename='${folder}/arm.dae'/>"}, "info"),
    ("PKG015", {"third_party/asio/read me.hpp": ""}, "warning"),
    ("PKG015", {"lab/first drive.png": ""}, "info"),
    ("PKG015", {"materials/old paint.png": ""}, "warning"),
    ("PKG015", {"third_party/asio/read me.hpp": "", "third_party/asio/LICENSE": ""}, "info"),
    ("PKG015", {"meshes/old body.dae": "", "meshes/LICENSE": ""}, "warning"),
    ("PKG016", LINKED, "error"),
    ("PKG016", {**LINKED, "package.xml": DEPENDS}, "info"),
    ("REF002", MESH, "error"),
    ("REF002", metal("<albedo_map>a.png</albedo_map>"), "warning"),
    ("REF001", MESH.replace("a.dae", "/home/me/a.dae"), "error"),
    ("REF001", metal("<albedo_map>/home/me/a.png</albedo_map>"), "warning"),
    ("REF003", {"@fragment": LEAVING, OTHER_MESH: "", SIBLING: "<package/>"}, "error"),
    (
        "REF003",
        {"@fragment": LEAVING, OTHER_MESH: "", SIBLING: "<package/>", "package.xml": DEPENDS},
        "info",
    ),
    ("WLD002", STAGE.format("<link name='eye'/>"), "info"),
    ("WLD002", STAGE.format("<link name='box'><collision name='c'/></link>"), "error"),
    ("PKG004", {"model.config": MADE}, "error"),
    ("PKG004", {"model.config": MADE, ".gitignore": "made.sdf\n"}, "warning"),
    ("SDF001", {"worlds/example.sdf": "<sdf><!-- a -- b --></sdf>"}, "info"),
    ("SDF001", {"bt/a.xml": "<root><BehaviorTree/><!-- a -- b --></root>"}, "info"),
    ("SDF001", {"arm.urdf": ""}, "warning"),
    ("SDF001", {"arm.urdf": "", "launch/a.launch": "<launch name='arm.urdf'/>"}, "error"),
    ("SDF001", {"launch/a.launch": "<launch><!-- a -- b --></launch>"}, "error"),
    ("SDF001", {"parts/hand.urdf": "<gazebo/><gazebo/>"}, "warning"),
    ("SDF001", {"config/arm.srdf": "<robot>"}, "warning"),
    ("SDF002", {"model.sdf": sdf("1.7")}, "warning"),
    ("SDF002", {"model.sdf": sdf("1.9")}, "error"),
    ("SDF003", '<sensor name="s" type="imu"><alwaysOn>1</alwaysOn></sensor>', "warning"),
    ("SDF003", '<sensor name="s" type="imu"><updaterate>1</updaterate></sensor>', "error"),
    ("SDF003", metal("<metal_map>a</metal_map>"), "warning"),
    ("SDF008", friction("<kp>1e6</kp>"), "warning"),
    ("SDF008", friction("<radius>1</radius>"), "error"),
    ("SEN002", '<sensor name="s" type="gpu_ray"/>', "info"),
    ("SEN002", '<sensor name="s" type="ray"/>', "error"),
    ("URD008", {"@urdf": LEFTOVER}, "info"),
    ("URD008", {"@urdf": LEFTOVER + READ}, "warning"),
    ("GEO008", PICTURE.format("1 1 0"), "warning"),
    ("GEO008", PICTURE.format("1 0 0"), "error"),
    ("GEO008", PICTURE.format("1 1 0").replace("visual", "collision"), "error"),
    ("GEO008", POINT.format(0), "info"),
    ("GEO008", POINT.format(-1), "error"),
    ("MSH006", {"@fragment": PAINTED.format(""), **UNPAINTED}, "warning"),
    ("MSH006", {"@fragment": PAINTED.format(GREY), **UNPAINTED}, "info"),
    ("MSH004", {"model.sdf": SCENERY.format(""), **FINE}, "warning"),
    ("MSH004", {"model.sdf": SCENERY.format("<static>true</static>"), **FINE}, "info"),
    ("MSH004", {"@urdf": DRAWN, **FINE}, "info"),
    ("MSH004", {"@urdf": DRAWN + CAMERA, **FINE}, "warning"),
]  # fmt: skip


@pytest.mark.parametrize(("rule", "example", "severity"), CASES)
def test_severity_depends_on_the_case(
    rule: str, example: Any, severity: str, tmp_path: Path
) -> None:
    package = write_example(example, tmp_path)
    (report,) = check_package(package, Settings(select=(rule,))).packages
    assert [str(finding.severity) for finding in report.findings] == [severity], [
        finding.message for finding in report.findings
    ]


@pytest.mark.parametrize(
    ("rule", "fragment", "classic", "later"),
    [
        ("SDF009", HINGE, "info", "warning"),
        ("SDF005", UNCOLOURED, "warning", "error"),
        ("SDF006", SUN, "warning", "error"),
        ("INE002", COARSE, "warning", "error"),
        ("KIN002", TWICE_HELD.format(""), "info", "error"),
        ("SDF006", UNMOVED, "warning", "error"),
    ],
)
def test_classic_neither_renames_nor_refuses(
    rule: str, fragment: str, classic: str, later: str, tmp_path: Path
) -> None:
    package = write_example(fragment, tmp_path)
    for profile, severity in (("gazebo-classic", classic), ("gazebo-fortress", later)):
        settings = Settings(profile=profile, profile_chosen=True, select=(rule,))
        (report,) = check_package(package, settings).packages
        assert [found.severity.value for found in report.findings] == [severity]


@pytest.mark.parametrize(
    ("profile", "severity"), [("subt", "warning"), ("gazebo-fortress", "info")]
)
def test_fewer_samples_than_the_lidar_has_save_time(
    profile: str, severity: str, tmp_path: Path
) -> None:
    settings = Settings(profile=profile, profile_chosen=True, select=("SEN004",))
    (report,) = check_package(write_example(FEW, tmp_path), settings).packages
    assert [found.severity.value for found in report.findings] == [severity]


@pytest.mark.parametrize(
    ("topic", "severity"), [("cmd_vel", "warning"), ("wheels/cmd", "info"), ("cmd", "info")]
)
def test_a_topic_that_classic_uses_anyway_is_no_loss(
    topic: str, severity: str, tmp_path: Path
) -> None:
    package = write_example(CLASSIC_DRIVE.format(topic=topic), tmp_path)
    settings = Settings(profile="gazebo-classic", profile_chosen=True, select=("PLG005",))
    (report,) = check_package(package, settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


@pytest.mark.parametrize(("distro", "severity"), [("", "info"), ("jazzy", "warning")])
def test_a_replaced_package_is_missing(distro: str, severity: str, tmp_path: Path) -> None:
    package = write_example(REPLACED, tmp_path)
    settings = Settings(profile="ros2", profile_chosen=True, select=("PKG021",), distro=distro)
    (report,) = check_package(package, settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


@pytest.mark.parametrize(("profile", "severity"), [("ros2", "error"), ("ros2-classic", "warning")])
def test_classic_sets_positions_without_force(profile: str, severity: str, tmp_path: Path) -> None:
    package = write_example({"@urdf": LIFT + GZ}, tmp_path)
    settings = Settings(profile=profile, profile_chosen=True, select=("KIN007",), distro="humble")
    (report,) = check_package(package, settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


def test_a_stray_model_config_loses_no_model(tmp_path: Path) -> None:
    (tmp_path / "model.config").write_text(MADE)
    settings = Settings(profile="gazebo-harmonic", profile_chosen=True, select=("PKG004",))
    (report,) = check_package(tmp_path, settings).packages
    assert [str(finding.severity) for finding in report.findings] == ["warning"]
    (tmp_path / "wood.png").write_bytes(b"")
    (report,) = check_package(tmp_path, settings).packages
    assert [str(finding.severity) for finding in report.findings] == ["error"]


@pytest.mark.parametrize(
    ("searched", "uri", "severity"),
    [
        ("models", "model://grass", "info"),
        ("", "model://wood/meshes/a.stl", "info"),
        ("", "model://wood", "error"),
        ("worlds", "model://grass", "error"),
    ],
)
def test_a_model_config_that_gazebo_does_not_search(
    searched: str, uri: str, severity: str, tmp_path: Path
) -> None:
    export = f'<gazebo_ros gazebo_model_path="${{prefix}}/{searched}"/>' if searched else ""
    files = {
        "package.xml": f"<package><name>park</name><export>{export}</export></package>",
        "launch/park.launch.py": "",
        "worlds/park.world": f"<include><uri>{uri}</uri></include>",
        "worlds/wood/model.config": MADE,
        "worlds/wood/model.sdf": "<sdf version='1.6'><model name='wood'/></sdf>",
    }
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    settings = Settings(profile="gazebo-classic", profile_chosen=True, select=("PKG004",))
    (report,) = check_package(tmp_path / "worlds/wood", settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


def test_bridges_that_reach_nothing_of_the_robot_are_errors(tmp_path: Path) -> None:
    odometry = BRIDGE.format("other", "nav_msgs/msg/Odometry", "Odometry")
    package = write_example({"@bridge": odometry + odometry.replace("other", "none")}, tmp_path)
    (report,) = check_package(package, Settings(select=("BRG004",))).packages
    assert [str(finding.severity) for finding in report.findings] == ["error", "error"]


@pytest.mark.parametrize(("gravity", "severity"), [("0.0 0.0 -9.8", "info"), ("0 0 0", "error")])
def test_a_misplaced_default_changes_nothing(gravity: str, severity: str, tmp_path: Path) -> None:
    world = tmp_path / "lab.sdf"
    physics = f'<physics type="ode"><gravity>{gravity}</gravity></physics>'
    world.write_text(f'<sdf version="1.6"><world name="lab">{physics}</world></sdf>', "utf-8")
    (report,) = check_package(world, Settings(select=("SDF008",))).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


LID = '<joint name="lid" type="revolute"><parent>body</parent><child>top</child></joint>'


@pytest.mark.parametrize(("joint", "severities"), [("", {"info"}), (LID, {"error", "warning"})])
def test_a_prop_needs_less_than_a_robot(joint: str, severities: set[str], tmp_path: Path) -> None:
    box = '<collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>'
    inertia = "<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia>"
    (tmp_path / "barrel.sdf").write_text(
        f"""<sdf version="1.9"><model name="barrel">
<link name="body"><inertial><mass>1</mass>{inertia}</inertial>{box}</link>
<link name="top">{box}</link>{joint}
</model></sdf>
""",
        "utf-8",
    )
    wanted = ("INE001", "INE006")
    settings = Settings(profile="gazebo-harmonic", profile_chosen=True, select=wanted, trial=False)
    (report,) = check_package(tmp_path / "barrel.sdf", settings).packages
    assert {finding.rule for finding in report.findings} == set(wanted)
    assert {str(finding.severity) for finding in report.findings} == severities


@pytest.mark.parametrize(
    ("version", "static", "severity"),
    [("1.6", "true", "warning"), ("1.6", "false", "error"), ("1.7", "true", "error")],
)
def test_a_joint_of_nothing_that_moves_may_be_dropped(
    version: str, static: str, severity: str, tmp_path: Path
) -> None:
    (tmp_path / "sign.sdf").write_text(
        f"""<sdf version="{version}"><model name="sign"><static>{static}</static>
<link name="plate"/>
<joint name="j" type="fixed"><parent>pole</parent><child>plate</child></joint>
</model></sdf>
""",
        "utf-8",
    )
    settings = Settings(profile="sdf", profile_chosen=True, select=("KIN001",))
    (report,) = check_package(tmp_path / "sign.sdf", settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


@pytest.mark.parametrize(
    ("wheels", "severities"),
    [(GRIP, {"info"}), (SKIDDING, {"warning"}), (GRIP.replace("150", "0"), {"warning"})],
)
def test_high_friction_matters_where_wheels_skid(
    wheels: str, severities: set[str], tmp_path: Path
) -> None:
    package = write_example(wheels, tmp_path)
    settings = Settings(profile="gazebo-classic", profile_chosen=True, select=("GEO009",))
    (report,) = check_package(package, settings).packages
    assert {str(finding.severity) for finding in report.findings} == severities


@pytest.mark.parametrize(
    ("more", "severity"),
    [
        ("", "warning"),
        (LID.replace("lid", "mount").replace("body", "rig"), "error"),
        (POINT.format("0.1"), "error"),
    ],
)
def test_a_rig_that_nothing_moves_needs_no_inertia(
    more: str, severity: str, tmp_path: Path
) -> None:
    joint, inside = (more, "") if "joint" in more else ("", more)
    (tmp_path / "rig.sdf").write_text(
        f"""<sdf version="1.9"><model name="rig">
<link name="rig"><sensor name="eye" type="camera"/>{inside}</link>{joint}
<link name="top"><inertial><mass>1</mass>
<inertia><ixx>0.1</ixx><iyy>0.1</iyy><izz>0.1</izz></inertia></inertial></link>
</model></sdf>
""",
        "utf-8",
    )
    settings = Settings(profile="gazebo-harmonic", profile_chosen=True, select=("INE001",))
    (report,) = check_package(tmp_path / "rig.sdf", settings).packages
    assert [str(finding.severity) for finding in report.findings] == [severity]


@pytest.mark.parametrize(
    ("world", "severity"),
    [
        ("worlds/hall.world", "error"),
        ("hall.world", "error"),
        ("worlds/yard.world", "warning"),
        ("yard.world", "warning"),
    ],
)
def test_what_no_launch_file_starts_is_no_error(world: str, severity: str, tmp_path: Path) -> None:
    inertia = "<inertia><ixx>nan</ixx></inertia>"
    text = f"""<sdf version="1.6"><world name="w"><model name="m"><link name="l">
<inertial>{inertia}</inertial></link></model></world></sdf>
"""
    for path, content in {
        "acme_sim/package.xml": "<package><name>acme_sim</name></package>",
        "acme_sim/launch/sim.launch.py": "WORLD = 'worlds/hall.world'\n",
        world: text,
    }.items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(content, "utf-8")

    report = check_package(tmp_path, Settings(select=("SDF006",), trial=False))

    found = [finding for package in report.packages for finding in package.findings]
    assert [str(finding.severity) for finding in found] == [severity]
