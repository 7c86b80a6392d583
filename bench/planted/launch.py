"""Faults in launch files and in the xacro that ROS expands."""

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
    with_child,
    with_tag,
    xml,
)

TOPICS = "launch/vehicle_topics.launch"
DESCRIPTION = "launch/description.launch"
BRIDGE = "//node[@type='parameter_bridge']"
IMU = f"{BRIDGE}[contains(@args,'/imu@')]"
IMAGES = "//node[@type='image_bridge']"
XACRO = "urdf/model.xacro|urdf/rocky.xacro"
OPTICAL = "//node[@type='optical_frame_publisher']"


def topics(path: str, *changes: Change) -> Edit:
    """Return an edit of an element of vehicle_topics.launch."""
    return xml(TOPICS, path, *changes)


BRIDGES = (
    kind("an IMU that is not bridged", "ROS001", topics(IMU, removed)),
    kind(
        "a camera that is not bridged",
        "ROS001 ROS007",
        topics(f"{IMAGES}[contains(@args,'/image')]", removed),
    ),
    kind(
        "points that are not bridged",
        "ROS001",
        topics(f"{BRIDGE}[contains(@args,'/points@')]", removed),
    ),
    kind(
        "a drive that ROS cannot command",
        "ROS001",
        topics(f"{BRIDGE}[contains(@args,'Twist')]", removed),
    ),
    kind(
        "poses that are not bridged",
        "ROS001 ROS015",
        topics(f"{BRIDGE}[contains(@args,')/pose@')]", removed),
    ),
    kind(
        "a gas detector that is not bridged",
        "ROS001",
        topics(f"{BRIDGE}[contains(@args,'gas_detected')]", removed),
    ),
    kind(
        "a bridge of a sensor that is not there",
        "ROS001 ROS002",
        text(
            TOPICS, r"args=\"\$\(arg sensor_prefix\)/imu_sensor", 'args="$(arg sensor_prefix)/imu'
        ),
    ),
    kind(
        "a bridge of a topic that nothing publishes",
        "ROS001 ROS002",
        text(TOPICS, "/points@", "/point_cloud@"),
    ),
    kind(
        "a bridge of an image that nothing publishes",
        "ROS001 ROS002 ROS007",
        text(TOPICS, r"args=\"(.*)/image\"", r'args="\1/img"'),
    ),
    kind(
        "a message of another type", "ROS003", text(TOPICS, "sensor_msgs/Imu", "sensor_msgs/Image")
    ),
    kind(
        "a message of another kind in Gazebo",
        "ROS003",
        text(TOPICS, r"ignition.msgs.IMU", "ignition.msgs.Image"),
    ),
    kind(
        "a message that does not exist",
        "ROS003 ROS007",
        text(TOPICS, "sensor_msgs/CameraInfo", "sensor_msgs/CamInfo"),
    ),
    kind(
        "a command bridged the wrong way",
        "ROS003 ROS001",
        text(TOPICS, r"Twist\]ignition", "Twist[ignition"),
    ),
    kind(
        "a sensor bridged the wrong way",
        "ROS003 ROS001",
        text(TOPICS, r"Imu\[ignition", "Imu]ignition"),
    ),
    kind(
        "a message of a later release",
        "ROS003 ROS011",
        text(TOPICS, "ignition.msgs.IMU", "gz.msgs.IMU"),
    ),
    kind("a bridge twice", "ROS004 ROS008", topics(IMU, repeated)),
    kind(
        "a bridge twice under two names",
        "ROS004",
        text(
            TOPICS,
            r"(<node[^>]*name=\")(ros_ign_bridge_imu)(\"[^>]*>(?:\s*<remap[^>]*>)?\s*</node>)",
            r"\1\2\3\1\2_b\3",
        ),
    ),
    kind("an IMU under another name", "ROS005", text(TOPICS, r'to="imu/data"', 'to="inertial"')),
    kind(
        "commands under another name", "ROS005", text(TOPICS, r'to="cmd_vel"', 'to="drive_command"')
    ),
    kind("points under another name", "ROS005", text(TOPICS, r'to="points"', 'to="cloud"')),
    kind("no optical frame", "ROS006", topics(OPTICAL, removed)),
    kind(
        "an optical frame of no image",
        "ROS007 ROS006",
        text(TOPICS, r"(from=\"input/image\" to=\")", r"\1rear/"),
    ),
    kind(
        "an optical frame without remaps",
        "ROS007 ROS006",
        topics(f"{OPTICAL}/remap[@from='input/camera_info']", removed),
    ),
    kind(
        "a node name twice",
        "ROS008 ROS004",
        topics(
            f"{BRIDGE}[not(ancestor::group[2])][2]", with_attribute("name", "ros_ign_bridge_imu")
        ),
    ),
    kind("a tag that roslaunch does not know", "ROS009 ROS001", topics(BRIDGE, with_tag("nod"))),
    kind(
        "an attribute that roslaunch does not know",
        "ROS009 ROS010",
        topics(BRIDGE, with_attribute("packge", "x")),
    ),
    kind(
        "a node without a type",
        "ROS009 ROS010 ROS001",
        topics(BRIDGE, with_attribute("type", None)),
    ),
    kind(
        "an argument that nothing defines",
        "ROS010",
        text(TOPICS, r"\$\(arg sensor_prefix\)", "$(arg prefix)"),
    ),
    kind("a launch file that is not well-formed", "ROS010 SDF001", text(TOPICS, "</node>", "")),
    kind(
        "an include that is not there",
        "ROS010 REF002",
        topics("/launch", with_child("<include file='$(dirname)/more.launch'/>")),
    ),
    kind(
        "a bridge of a later release",
        "ROS011 PKG007",
        text(TOPICS, 'ros_ign_bridge"', 'ros_gz_bridge"'),
    ),
    kind(
        "an image bridge of a later release",
        "ROS011 PKG007",
        text(TOPICS, 'pkg="ros_ign_image"', 'pkg="ros_gz_image"'),
    ),
    kind(
        "a substitution that is not closed",
        "ROS010 ROS001",
        text(TOPICS, r"\(arg name\)/pose@", "(arg name/pose@"),
    ),
)

DESCRIPTIONS = (
    kind(
        "a description under another name",
        "ROS014",
        text(DESCRIPTION, "robot_description", "description"),
    ),
    kind(
        "a description outside the namespace",
        "ROS014",
        text(DESCRIPTION, r"\$\(arg name\)/robot_description", "robot_description"),
    ),
    kind(
        "a description of no file",
        "ROS014 REF002 ROS010",
        text(DESCRIPTION, r"urdf/\w+\.xacro", "urdf/body.xacro"),
    ),
    kind(
        "a description of another robot",
        "PKG012 ROS014 REF002 PKG007",
        text(DESCRIPTION, r"\(find \w+_config_\d\)", "(find x1_sensor_config_6)"),
    ),
    kind("a xacro file that is not there", "ROS014 REF002 ROS010", delete("urdf/*model.xacro")),
    kind(
        "a xacro that is not well-formed",
        "URD009 URD006 SDF001 URD001",
        text(XACRO, "</robot>", ""),
    ),
    kind(
        "a xacro macro that nothing defines",
        "URD009 URD006 URD001 URD008",
        xml(
            XACRO,
            "/robot",
            with_child("<xacro:wheel_of_nothing xmlns:xacro='http://ros.org/wiki/xacro'/>"),
        ),
    ),
)

KINDS: tuple[Kind, ...] = (*BRIDGES, *DESCRIPTIONS)
