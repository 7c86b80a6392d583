"""Faults in ROS 2 packages: ros2_control and its controllers, launch files, bridges."""

from __future__ import annotations

from bench.planted.edits import (
    Change,
    Edit,
    Kind,
    delete,
    kind,
    removed,
    repeated,
    text,
    with_attribute,
    with_tag,
    with_text,
    xml,
)

URDF = "urdf/test_diff_drive.xacro.urdf"
SYSTEM = "/robot/ros2_control"
PLUGIN = "/robot/gazebo/plugin"
CONTROLLERS = "config/diff_drive_controller_velocity.yaml"
START = "launch/diff_drive_example.launch.py"
BRIDGE = "configs/turtlebot3_waffle_bridge.yaml"
BRINGUP = "launch/turtlebot3_world.launch.py"
SPAWN = "launch/spawn_tb3.launch.py"


def robot(path: str, *changes: Change) -> Edit:
    """Return an edit of an element of the URDF."""
    return xml(URDF, path, *changes)


def controllers(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the file of controllers."""
    return text(CONTROLLERS, pattern, replacement)


def started(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the launch file of the robot."""
    return text(START, pattern, replacement)


def bridge(pattern: str, replacement: str = "") -> Edit:
    """Return an edit of the bridge's YAML file."""
    return text(BRIDGE, pattern, replacement)


HARDWARE = (
    kind(
        "ros2_control: a joint that the URDF has not",
        "R2C001",
        robot(f"{SYSTEM}/joint", with_attribute("name", "wheel_left_joint")),
    ),
    kind(
        "ros2_control: a fixed joint",
        "R2C001",
        robot(f"{SYSTEM}/joint", with_attribute("name", "caster_joint")),
    ),
    kind(
        "ros2_control: a wheel that is fixed",
        "R2C001",
        robot("/robot/joint[@name='left_wheel_joint']", with_attribute("type", "fixed")),
    ),
    kind("ros2_control: a joint twice", "R2C003", robot(f"{SYSTEM}/joint", repeated)),
    kind("ros2_control: no hardware", "R2C003", robot(f"{SYSTEM}/hardware", removed)),
    kind(
        "ros2_control: an unknown type",
        "R2C003",
        robot(SYSTEM, with_attribute("type", "robot")),
    ),
    kind(
        "ros2_control: no name",
        "R2C003",
        robot(SYSTEM, with_attribute("name", None)),
    ),
    kind(
        "ros2_control: an interface without name",
        "R2C003",
        robot(f"{SYSTEM}/joint/command_interface", with_attribute("name", None)),
    ),
    kind(
        "ros2_control: hardware that does not exist",
        "R2C004",
        robot(f"{SYSTEM}/hardware/plugin", with_text("gz_ros2_control/GazeboSystem")),
    ),
    kind(
        "ros2_control: hardware of another simulator",
        "R2C004 R2C005",
        robot(f"{SYSTEM}/hardware/plugin", with_text("gazebo_ros2_control/GazeboSystem")),
    ),
    kind(
        "ros2_control: hardware of Gazebo without its plugin",
        "R2C005",
        robot("/robot/gazebo[plugin]", removed),
    ),
    kind(
        "ros2_control: Gazebo's plugin with mock hardware",
        "R2C005",
        robot(f"{SYSTEM}/hardware/plugin", with_text("mock_components/GenericSystem")),
    ),
    kind(
        "ros2_control: another class in the library",
        "R2C005 PLG002",
        robot(PLUGIN, with_attribute("name", "gz_ros2_control::GazeboROS2ControlPlugin")),
    ),
    kind(
        "ros2_control: parameters of a missing file",
        "R2C006",
        robot(
            f"{PLUGIN}/parameters",
            with_text("$(find gz_ros2_control_demos)/config/diff_drive.yaml"),
        ),
    ),
    kind(
        "ros2_control: no parameters",
        "R2C006",
        robot(f"{PLUGIN}/parameters", removed),
    ),
    kind(
        "ros2_control: limits the wrong way round",
        "R2C007",
        robot(f"{SYSTEM}/joint/command_interface/param[@name='min']", with_text("2")),
    ),
    kind(
        "ros2_control: an interface that is none",
        "R2C007 R2C009",
        robot(f"{SYSTEM}/joint/command_interface", with_attribute("name", "speed")),
    ),
    kind(
        "ros2_control: a wheel without command",
        "R2C009",
        robot(f"{SYSTEM}/joint/command_interface", removed),
    ),
    kind(
        "ros2_control: a tag of another name",
        "R2C003 R2C005 URD002",
        robot(SYSTEM, with_tag("ros2control")),
    ),
    kind(
        "ros2_control: a number that is none",
        "R2C003 R2C007",
        robot(f"{SYSTEM}/joint/command_interface/param[@name='max']", with_text("fast")),
    ),
)

CONTROL = (
    kind(
        "controllers: a type that does not exist",
        "R2C008",
        controllers("diff_drive_controller/DiffDriveController", "diff_drive/DiffDriveController"),
    ),
    kind(
        "controllers: a broadcaster that does not exist",
        "R2C008",
        controllers(
            "joint_state_broadcaster/JointStateBroadcaster",
            "joint_state_controller/JointStateController",
        ),
    ),
    kind(
        "controllers: an unknown wheel",
        "R2C009",
        controllers(r'(left_wheel_names: \[")left_wheel_joint', r"\1front_left_wheel_joint"),
    ),
    kind(
        "controllers: one wheel for both sides",
        "GEO013 R2C010",
        controllers(r'(right_wheel_names: \[")right_wheel_joint', r"\1left_wheel_joint"),
    ),
    kind("controllers: no wheels", "R2C010", controllers(r"left_wheel_names: .*$")),
    kind("controllers: no radius", "R2C010", controllers(r"^    wheel_radius: .*$")),
    kind(
        "controllers: a text for a number",
        "R2C010",
        controllers(r"wheel_separation: 1.25", 'wheel_separation: "1.25 m"'),
    ),
    kind(
        "controllers: a rate that is no whole number",
        "R2C010",
        controllers(r"update_rate: 100 ", "update_rate: 99.5 "),
    ),
    kind(
        "controllers: an unknown parameter",
        "R2C011 R2C014",
        controllers("base_frame_id", "base_frame"),
    ),
    kind(
        "controllers: wheels too far apart",
        "GEO005",
        controllers("wheel_separation: 1.25", "wheel_separation: 0.625"),
    ),
    kind(
        "controllers: wheels too large",
        "GEO004",
        controllers("wheel_radius: 0.3", "wheel_radius: 0.6"),
    ),
    kind(
        "controllers: left and right swapped",
        "GEO013",
        controllers(
            r'left_wheel_names: \["left_wheel_joint', 'left_wheel_names: ["right_wheel_joint'
        ),
        controllers(
            r'right_wheel_names: \["right_wheel_joint', 'right_wheel_names: ["left_wheel_joint'
        ),
    ),
    kind(
        "controllers: an unknown frame",
        "R2C014",
        controllers("base_frame_id: chassis", "base_frame_id: base_footprint"),
    ),
    kind(
        "controllers: parameters of another node",
        "R2C010 R2C012 R2C013",
        controllers("^diff_drive_base_controller:", "diff_drive_controller:"),
    ),
    kind(
        "controllers: no ros__parameters",
        "R2C006 R2C010 R2C012 R2C013",
        controllers(
            r"^controller_manager:\n  ros__parameters:", "controller_manager:\n  parameters:"
        ),
    ),
    kind(
        "controllers: YAML with a tab",
        "CTL001 R2C006",
        controllers(r"^    wheel_radius", "\t wheel_radius"),
    ),
    kind("controllers: the file is gone", "R2C006", delete(CONTROLLERS)),
)

LAUNCH = (
    kind(
        "launch.py: a controller that is not configured",
        "R2C013",
        started("'diff_drive_base_controller'", "'diff_drive_controller'"),
    ),
    kind(
        "launch.py: a broadcaster that is not configured",
        "R2C013",
        started(r"\['joint_state_broadcaster'\]", "['joint_broadcaster']"),
    ),
    kind(
        "launch.py: a description that is not there",
        "LCH001",
        started("test_diff_drive.xacro.urdf", "diff_drive.urdf.xacro"),
    ),
    kind(
        "launch.py: parameters that are not there",
        "LCH001",
        started("'config', 'diff_drive_controller_velocity", "'config', 'diff_drive_controller"),
    ),
    kind(
        "launch.py: a file that is not installed",
        "LCH002 PKG008",
        text("CMakeLists.txt", "launch config urdf", "launch config"),
    ),
    kind("launch.py: another spawner's option", "LCH009", started("'-name',", "'-entity',")),
    kind(
        "launch.py: Classic's spawner",
        "LCH008",
        started(
            "package='ros_gz_sim', executable='create'",
            "package='gazebo_ros', executable='spawn_entity.py'",
        ),
    ),
    kind(
        "launch.py: a keyword of an old release",
        "LCH004",
        started(
            "executable='robot_state_publisher', output",
            "node_executable='robot_state_publisher', output",
        ),
    ),
    kind(
        "launch.py: no executable",
        "LCH004",
        started(r"package='ros_gz_sim', executable='create', ", "package='ros_gz_sim', "),
    ),
    kind(
        "launch.py: a bracket is missing",
        "LCH011",
        started(r"create, clock\]\)$", "create, clock)"),
    ),
    kind(
        "launch.py: a name that does not exist",
        "LCH011",
        started(r"return LaunchDescription\(\[gazebo", "return LaunchDescription([simulator"),
    ),
    kind(
        "launch.py: an argument that nothing declares",
        "LCH007",
        started(
            r"\[' -r -v 4 empty.sdf'\]", "[' -r ', substitutions.LaunchConfiguration('world')]"
        ),
    ),
    kind(
        "launch.py: an included file that is not there",
        "LCH001",
        text(BRINGUP, r"'spawn_turtlebot3.launch.py'", "'spawn.launch.py'"),
    ),
    kind(
        "launch.py: an argument that the included file has not",
        "LCH006",
        text(BRINGUP, r"x_pose=Config\('x_pose'", "pose_x=Config('x_pose'"),
    ),
    kind(
        "launch.py: a world that is not there",
        "LCH001",
        text(BRINGUP, r"'turtlebot3_world.world'", "'turtlebot3.world'"),
    ),
)

BRIDGES = (
    kind(
        "bridge: a message that does not exist",
        "BRG002",
        bridge("sensor_msgs/msg/Imu", "sensor_msgs/msg/IMU"),
    ),
    kind("bridge: a type without msg", "BRG002", bridge("sensor_msgs/msg/LaserScan", "LaserScan")),
    kind(
        "bridge: two messages that do not fit",
        "BRG002 BRG003",
        bridge("gz.msgs.IMU", "gz.msgs.Magnetometer"),
    ),
    kind(
        "bridge: a message of another kind",
        "BRG003",
        bridge(r"sensor_msgs/msg/LaserScan", "sensor_msgs/msg/PointCloud2"),
        bridge(r"gz.msgs.LaserScan", "gz.msgs.PointCloudPacked"),
    ),
    kind(
        "bridge: a topic that nothing has",
        "BRG004",
        bridge('topic_name: "scan"', 'topic_name: "lidar/scan"'),
    ),
    kind(
        "bridge: commands to nobody",
        "BRG004",
        bridge('topic_name: "cmd_vel"', 'topic_name: "model/cmd_vel"'),
    ),
    kind(
        "bridge: the wrong way for commands",
        "BRG005",
        bridge("ROS_TO_GZ", "GZ_TO_ROS"),
    ),
    kind(
        "bridge: the wrong way for a sensor",
        "BRG005",
        bridge('(gz_type_name: "gz.msgs.IMU"\n  direction: )GZ_TO_ROS', r"\1ROS_TO_GZ"),
    ),
    kind("bridge: an unknown key", "BRG006", bridge("ros_type_name", "ros_type")),
    kind("bridge: an unknown direction", "BRG006", bridge("ROS_TO_GZ", "ROS2GZ")),
    kind("bridge: no type", "BRG006", bridge(r"^  ros_type_name: .*$")),
    kind(
        "bridge: a name that ROS refuses",
        "BRG004 BRG007",
        bridge('topic_name: "joint_states"', 'topic_name: "joint-states"'),
    ),
    kind("bridge: YAML that is none", "BRG006 CTL001", bridge('"scan"$', '"scan')),
    kind(
        "bridge: no clock",
        "BRG008",
        started(r"('robot_description': text)\}", r"\1, 'use_sim_time': True}"),
    ),
    kind(
        "bridge: its file is not there",
        "LCH001",
        text(SPAWN, "'turtlebot3_waffle_bridge.yaml'", "'waffle_bridge.yaml'"),
    ),
    kind(
        "bridge: a frame that nothing publishes",
        "BRG009",
        text("urdf/gz_waffle.sdf.xacro", "<gz_frame_id>base_scan", "<gz_frame_id>lidar"),
    ),
)

PACKAGE = (kind("ROS 2: xacro that is not well-formed", "SDF001 URD001", text(URDF, "</robot>")),)

KINDS: tuple[Kind, ...] = (*HARDWARE, *CONTROL, *LAUNCH, *BRIDGES, *PACKAGE)
