"""Robots for examples of rules: rovers on four wheels, and `<ros2_control>` of an arm.

Texts alone: examples are built whenever a rule is loaded.
"""

from __future__ import annotations

MOCK = "<plugin>mock_components/GenericSystem</plugin>"
GAZEBO = "<plugin>gz_ros2_control/GazeboSimSystem</plugin>"
SHOULDER = '<joint name="shoulder"><command_interface name="position"/></joint>'
ARM = """<robot name="arm">
  <link name="base_link"/>
  <link name="upper_arm"/>
  <joint name="shoulder" type="continuous">
    <parent link="base_link"/>
    <child link="upper_arm"/>
    <axis xyz="0 0 1"/>
  </joint>
</robot>
"""
MOVEIT_LAUNCH = """from moveit_configs_utils import MoveItConfigsBuilder

MoveItConfigsBuilder("arm")
"""
_WHEEL = """
<link name="{name}_wheel">
  <pose>{x} {y} 0.1 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>4e-3</ixx><iyy>4e-3</iyy><izz>4e-3</izz></inertia></inertial>
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_joint" type="revolute">{mark}
  <parent>base_link</parent><child>{name}_wheel</child>
  <axis><xyz>0 1 0</xyz>{limit}</axis>
</joint>
"""
_PLACES = {"fl": (1, 1), "rl": (-1, 1), "fr": (1, -1), "rr": (-1, -1)}


def rover(
    length: float = 0.2,
    width: float = 0.2,
    *,
    centre: str = "0 0 0",
    limit: str = "",
    speed: float = 1,
    drive_mark: str = "",
    wheel_mark: str = "",
) -> str:
    """Return model.sdf of a rover with skid steering: wheels `fl`, `rl`, `fr` and `rr`.

    Args:
        length: The distance of the wheels' centres before and behind the middle, metres.
        width: The distance of the wheels' centres left and right of it, metres.
        centre: The centre of the body's mass: x, y, z.
        limit: `<limit>` of each wheel's axis.
        speed: The speed of the drive, m/s.
        drive_mark: Comment behind the plugin's start tag.
        wheel_mark: Comment behind the start tag of each wheel's joint.
    """
    wheels = "".join(
        _WHEEL.format(name=name, x=x * length, y=y * width, limit=limit, mark=wheel_mark)
        for name, (x, y) in _PLACES.items()
    )
    return f"""
<sdf version="1.6">
<model name="acme_rover_sensor_config_1">
<link name="base_link">
  <pose>0 0 0.15 0 0 0</pose>
  <inertial>
    <pose>{centre} 0 0 0</pose>
    <mass>10</mass><inertia><ixx>0.2</ixx><iyy>0.2</iyy><izz>0.2</izz></inertia>
  </inertial>
  <collision name="c"><geometry><box><size>0.4 0.3 0.1</size></box></geometry></collision>
</link>
{wheels}
<plugin filename="libdiff-drive.so" name="ignition::gazebo::systems::DiffDrive">{drive_mark}
  <left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>
  <right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>
  <wheel_separation>{2 * width}</wheel_separation>
  <wheel_radius>0.1</wheel_radius>
  <max_velocity>{speed}</max_velocity><min_velocity>-{speed}</min_velocity>
  <max_acceleration>2</max_acceleration><min_acceleration>-2</min_acceleration>
</plugin>
</model>
</sdf>
"""


def ball_wheel(name: str, x: float, y: float, mark: str = "") -> str:
    """Return a wheel without mass whose collision is a ball, on the joint `NAME_axle`.

    Args:
        name: The name of its link.
        x: Where it is ahead of base_link, metres.
        y: Where it is to the left of base_link, metres.
        mark: Comment behind its pose.
    """
    return f"""
<link name="{name}">
  <pose>{x} {y} 0 0 0 0</pose>{mark}
  <collision name="c"><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>
</link>
<joint name="{name}_axle" type="revolute">
  <parent>base_link</parent>
  <child>{name}</child>
  <axis><xyz>0 1 0</xyz></axis>
</joint>
"""


def rover_with(parts: str, mark: str) -> dict[str, object]:
    """Return an example: the rover of `@robot` with further parts, marked at its `<model>`."""
    marked = {'sensor_config_1">': f'sensor_config_1">{mark}'}
    return {"@robot": "rover", "@change": {**marked, "</model>": f"{parts}</model>"}}


def rover_with_spring(stiffness: float, reference: float, mark: str = "") -> dict[str, object]:
    """Return an example: the rover of `@robot` with a mast on a spring (N/m, metres)."""
    added = f"""
<link name="mast">
  <pose>0 0 0.4 0 0 0</pose>
  <inertial><mass>1</mass><inertia><ixx>0.01</ixx><iyy>0.01</iyy><izz>0.01</izz></inertia></inertial>
</link>
<joint name="spring" type="prismatic">
  <parent>base_link</parent><child>mast</child>
  <axis>
    <xyz>0 0 1</xyz>
    <dynamics>
      <spring_stiffness>{stiffness}</spring_stiffness>
      <spring_reference>{reference}</spring_reference>
    </dynamics>
  </axis>
</joint>
"""
    return rover_with(added, mark)


def ros2_control(joint: str = SHOULDER, hardware: str = MOCK) -> str:
    """Return `<ros2_control>` of the arm, with its joint and its `<hardware>`."""
    return f"""
<ros2_control name="arm" type="system">
  <hardware>
    {hardware}
  </hardware>
  {joint}
</ros2_control>
"""


def gazebo_control(inside: str) -> str:
    """Return the `<gazebo>` tag with the plugin gz_ros2_control."""
    return f"""
<gazebo>
  <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
    {inside}
  </plugin>
</gazebo>
"""


def model_beside(joint: str, plugin: str = gazebo_control("")) -> dict[str, str]:
    """Return a package beside the arm's whose SDF model has a joint and plugins."""
    plugins = plugin.replace("<gazebo>", "").replace("</gazebo>", "")
    return {
        "../acme_arm_model/package.xml": "<package><name>acme_arm_model</name></package>",
        "../acme_arm_model/model.sdf": f"""<sdf version="1.9"><model name="arm">
<link name="base_link"/><link name="upper_arm"/>
<joint name="{joint}" type="revolute"><parent>base_link</parent><child>upper_arm</child></joint>
{plugins}</model></sdf>
""",
    }


DRIVEN_URDF = """<robot name="rover">
  <link name="base_link"/>
  <gazebo>
    <plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive">
      <frame_id>odom</frame_id><child_frame_id>base_link</child_frame_id>
    </plugin>
  </gazebo>
</robot>
"""
"""A rover whose drive in Gazebo publishes the transform from `odom` to `base_link`."""


def tf_bridge(mark: str = "") -> str:
    """Return the entry of a bridge that brings these transforms to `/tf`."""
    return f"""- ros_topic_name: /tf
  gz_topic_name: /model/rover/tf{mark}
  ros_type_name: tf2_msgs/msg/TFMessage
  gz_type_name: gz.msgs.Pose_V
  direction: GZ_TO_ROS
"""
