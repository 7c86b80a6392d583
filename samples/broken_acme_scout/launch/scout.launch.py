"""Start Gazebo with the robot in a yard, its controllers, and the bridge to ROS."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, IncludeLaunchDescription
from launch.launch_description_sources import PythonLaunchDescriptionSource
from launch.substitutions import Command, LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description():
    share = FindPackageShare("broken_acme_scout")
    description = Command(
        ["xacro ", PathJoinSubstitution([share, "urdf", "scout.xacro"]), " use_sim:=true"]
    )
    world = LaunchConfiguration("world")

    gazebo = IncludeLaunchDescription(
        PythonLaunchDescriptionSource(
            PathJoinSubstitution([FindPackageShare("ros_gz_sim"), "launch", "gz_sim.launch.py"])
        ),
        launch_arguments={"gz_args": ["-r ", world]}.items(),
    )
    state_publisher = Node(
        package="robot_state_publisher",
        executable="robot_state_publisher",
        parameters=[
            {
                "robot_description": ParameterValue(description, value_type=str),
                "use_sim_time": True,
            }
        ],
    )
    robot = Node(
        package="ros_gz_sim",
        node_executable="create",
        arguments=["-name", "scout", "-topic", "robot_description", "-z", "0.05"],
    )
    spawners = [
        Node(package="controller_manager", executable="spawner", arguments=[name])
        for name in ("joint_state_broadcaster", "diff_drive_base")
    ]
    bridge = Node(
        package="ros_gz_bridge",
        executable="parameter_bridge",
        parameters=[{"config_file": PathJoinSubstitution([share, "config", "bridge.yaml"])}],
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument(
                "world",
                default_value=PathJoinSubstitution([share, "worlds", "yard.sdf"]),
                description="World file to start",
            ),
            gazebo,
            state_publisher,
            robot,
            *spawners,
            bridge,
        ]
    )
