"""A frame gets its transform from two publishers of a launch.

TF keeps the last transform that it received. With two publishers of one transform the robot jumps
between two places, many times a second; with two parents for one frame the tree is a different one
each time, and lookups of transforms fail at times. A drive (DiffDrive in Gazebo, a drive plugin of
Gazebo Classic, a drive controller of ros2_control) and a filter that uses its odometry (`ekf_node`)
both publish `odom` to the base unless this is switched off in one of them; `slam_toolbox` and
`amcl` publish `map` to `odom`, which a `static_transform_publisher` must not. The joints of the
robot are transforms as well: a `static_transform_publisher` that repeats one, or odometry that ends
at `base_link` where that is a child of `base_footprint`, is a second transform. One that puts a
link above its own parent closes a loop, in which lookups fail until another node moves a frame.

It is reported where both are started with the defaults of all arguments, and the frames of both
are known from their parameters.

Fix: let one of them publish it. With a filter: remove the bridge of Gazebo's transforms, or state
`enable_odom_tf: false` for the controller, or `<publish_odom_tf>false</publish_odom_tf>` for the
plugin of Gazebo Classic. Without: `publish_tf: false` for the filter. Odometry ends at the root of
the robot. MoveIt's launch files publish each `<virtual_joint>`: remove one that repeats a joint.
Source: tf2, `BufferCore::setTransform`; gazebosim/gz-sim issue 2372; robot_localization,
`publish_tf`; ros2_controllers, `enable_odom_tf`; slam_toolbox, `transform_publish_period`.
"""

from collections.abc import Iterator
from itertools import combinations

from checker.model.components import Joint
from checker.ros.wiring.frames import is_static
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.transforms import Transform
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.rulebook.example_parts import DRIVEN_URDF, tf_bridge

_ByFrame = dict[tuple[str, str], list[Transform]]
"""Transforms by their child and topic."""
_MOST = 8
"""Publishers of one frame that are compared."""


@rule("WIR001", "conflicting-transforms", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report each two publishers of a transform, or of two parents of one frame."""
    by_frame: _ByFrame = {}
    for transform in wiring.transforms:
        by_frame.setdefault((transform.child, transform.topic), []).append(transform)
    for same in by_frame.values():
        for first, second in combinations(same[:_MOST], 2):
            if first.source is not second.source and not isinstance(first.source, Joint):
                yield finding(
                    first.span,
                    f"{_fault(first, second)}: {_cure(first, second, by_frame)}",
                    key=f"{first.child} {first.by} {second.by}",
                    related=[(second.span, f"{second.by} publishes {second}")],
                )
    yield from _loops(by_frame)


def _loops(by_frame: _ByFrame) -> Iterator[Finding]:
    """Report static transforms that put a link below one that the robot has below it."""
    joints = {
        (child, topic): transform
        for (child, topic), same in by_frame.items()
        for transform in same
        if isinstance(transform.source, Joint)
    }
    statics = (it for same in by_frame.values() for it in same if is_static(it))
    for static in statics:
        frame, passed = static.parent, set[str]()
        while (joint := joints.get((frame, static.topic))) and frame not in passed:
            passed.add(frame)
            frame = joint.parent
            if frame == static.child:
                yield finding(
                    static.span,
                    f"transform {static} of {static.by} closes a loop, in which lookups fail: the "
                    f"robot has {static.parent!r} below {frame!r}; {static.cure}",
                    key=f"loop {static}",
                    related=[(joint.span, f"{joint.by} publishes {joint}")],
                )


def _cure(first: Transform, second: Transform, by_frame: _ByFrame) -> str:
    """Return what to do; a joint is never at fault, and its robot starts at its root.

    A filter is there to publish, so what it filters stops, and a constant transform beside it.
    """
    if isinstance(second.source, Joint):
        is_same = first.parent == second.parent
        return first.cure if is_same else _to_root(first, second, by_frame) or first.cure
    return second.cure if is_static(second) else first.cure


def _to_root(first: Transform, joint: Transform, by_frame: _ByFrame) -> str:
    """Return how odometry ends at the root of the robot, where another publisher may be, too."""
    if not first.names_child or not joint.root:
        return joint.cure
    there = by_frame.get((joint.root, first.topic), ())
    others = [it for it in there if it.parent == first.parent and it.source is not first.source]
    if others and not isinstance(first.source, WiredNode):
        return first.cure
    line = f"write `{first.names_child.replace('{}', joint.root)}`, the root of the robot"
    return f"{line}, and {others[0].cure}" if others else line


def _fault(first: Transform, second: Transform) -> str:
    if first.parent == second.parent:
        return f"transform {first} has two publishers, {first.by} and {second.by}"
    return (
        f"frame {first.child!r} has two parents, {first.parent!r} from {first.by} and "
        f"{second.parent!r} from {second.by}"
    )


_EKF = """LaunchDescription([
        Node(package="robot_localization", executable="ekf_node",{} parameters=[
            os.path.join(HERE, "config", "ekf.yaml"){}]),
"""
_LAUNCHED = "LaunchDescription([\n"
_MARK = "  # ^ WIR001"


def _filter(settings: str, mark: str = "", more: str = "", name: str = "") -> dict[str, object]:
    return {
        "@bridge": tf_bridge(mark),
        "@launch": {_LAUNCHED: _EKF.format(name, more)},
        "urdf/rover.urdf": DRIVEN_URDF,
        "config/ekf.yaml": f"ekf_filter_node:\n  ros__parameters: {{{settings}}}\n",
    }


_CONTROL = """
  <ros2_control name="base" type="system">
    <hardware><plugin>gz_ros2_control/GazeboSimSystem</plugin></hardware>
  </ros2_control>
  <gazebo>
    <plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">
      <parameters>$(find acme_rover_bringup)/config/base.yaml</parameters>
    </plugin>
  </gazebo>
</robot>
"""
_YAML = """controller_manager:
  ros__parameters:
    base_controller: {type: diff_drive_controller/DiffDriveController}
base_controller:%
  ros__parameters: {enable_odom_tf: @}
"""
_SPAWNER = """LaunchDescription([
        Node(package="controller_manager", executable="spawner", arguments=["base_controller"]),
"""


def _controlled_example(odom_tf: str, mark: str = "", yaml: str = "") -> dict[str, object]:
    return {
        "@bridge": tf_bridge(mark),
        "@launch": {_LAUNCHED: _SPAWNER},
        "urdf/rover.urdf": DRIVEN_URDF.replace("</robot>\n", _CONTROL),
        "config/base.yaml": _YAML.replace("@", odom_tf).replace("%", yaml),
    }


_MANAGER = """        Node(package="controller_manager", executable="ros2_control_node",{}
             parameters=[os.path.join(HERE, "config", "base.yaml")]),
"""


def _on_hardware(settings: str, mark: str = "", manager: str = "") -> dict[str, object]:
    """Return a rover whose drive is run by ros2_control_node, in addition to a filter."""
    nodes = _EKF.format("", "").partition("\n")[2]
    return {
        "@bridge": True,
        "@launch": {_LAUNCHED: _SPAWNER + nodes + _MANAGER.format(manager)},
        "config/base.yaml": _YAML.replace("@", "true").replace("%", mark),
        "config/ekf.yaml": f"ekf_filter_node:\n  ros__parameters: {{{settings}}}\n",
    }


_CLASSIC = """<launch>
  <include file="$(find-pkg-share gazebo_ros)/launch/gazebo.launch.py"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="gazebo_ros" exec="spawn_entity.py" args="-topic robot_description -entity rover"/>
  <node pkg="robot_localization" exec="ekf_node">
    <param name="base_link_frame" value="base_footprint"/>
  </node>
</launch>
"""


def _classic(plugin: str) -> dict[str, object]:
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/classic.launch.xml": _CLASSIC,
        "urdf/rover.urdf": f"""<robot name="rover">
  <link name="base_footprint"/>
  <gazebo><plugin name="drive" {plugin}</plugin></gazebo>
</robot>
""",
    }


_PUBLISHED = """  <node pkg="robot_state_publisher" exec="robot_state_publisher"{}>
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf {}')"/>
  </node>
"""
_PUBLISHED_TWICE = f"""<launch>
  <include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py"/>
{_PUBLISHED.format("", "")}{_PUBLISHED.format(' namespace="r2"', "in_sim:=1")}
  <node pkg="ros_gz_sim" exec="create" args="-topic robot_description -name rover"/>
  <node pkg="controller_manager" exec="spawner" args="base_controller"/>
</launch>
"""
_WITH_ARGUMENT = (
    '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">\n'
    '  <xacro:arg name="in_sim" default="0"/>'
)
_TF = "<publish_odom_tf>{}</publish_odom_tf>"
_XML_MARK = "  <!-- ^ WIR001 -->"

_STATIC = """LaunchDescription([
        Node(package="tf2_ros", executable="static_transform_publisher", arguments=[@]),%
"""


_EKF_AND_STATIC = """LaunchDescription([
        Node(package="robot_localization", executable="ekf_node",%
             parameters=[os.path.join(HERE, "config", "ekf.yaml")]),
        Node(package="tf2_ros", executable="static_transform_publisher",
             arguments=["--frame-id", "odom", "--child-frame-id", "base_link"]),
"""


def _static(words: str, mark: str = "") -> dict[str, object]:
    """Return a rover, whose lidar has a joint, with a static transform."""
    return {"@bridge": True, "@launch": {_LAUNCHED: _STATIC.replace("@", words).replace("%", mark)}}


_SLAM = """<launch>
  <include file="$(find-pkg-share slam_toolbox)/launch/online_async_launch.py">
    <arg name="slam_params_file" value="$(find-pkg-share acme_rover_bringup)/config/slam.yaml"/>
  </include>
  <node pkg="tf2_ros" exec="static_transform_publisher"
    args="--frame-id map --child-frame-id odom"/>
</launch>
"""
_SLOW = """slam_toolbox:
  ros__parameters:
    transform_publish_period: 0.2  # ^ WIR001
"""


def _mapping(settings: str, mark: str = "") -> dict[str, object]:
    """Return a launch file that makes a map, and has a static transform of it."""
    return {
        "@bridge": True,
        "launch/slam.launch.xml": _SLAM.replace('_launch.py">', f'_launch.py">{mark}'),
        "config/slam.yaml": f"slam_toolbox:\n  ros__parameters: {{{settings}}}\n",
    }


_FILE_OF_WORDS = """        Node(package="robot_localization", executable="ekf_node", arguments=[%
            "--ros-args", "--params-file", os.path.join(HERE, "config", "ekf.yaml")]),
"""


def _on_footprint(settings: str, mark: str = "") -> dict[str, object]:
    """Return a rover whose base is a child of its footprint, with a filter."""
    urdf = """<robot name="rover">
  <link name="base_footprint"/>
  <link name="base_link"/>
  <joint name="base_joint" type="fixed">
    <parent link="base_footprint"/>
    <child link="base_link"/>
  </joint>
</robot>
"""
    return {
        "@bridge": True,
        "@launch": {_LAUNCHED: _EKF.format("", "")},
        "urdf/rover.urdf": urdf,
        "config/ekf.yaml": f"ekf_filter_node:\n  ros__parameters: {{{settings}}}{mark}\n",
    }


_CONTAINER = """<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="nav" namespace="">
    <composable_node pkg="nav2_amcl" plugin="nav2_amcl::AmclNode" name="amcl">
      <param name="tf_broadcast" value="@"/>%
    </composable_node>
  </node_container>
  <node pkg="robot_localization" exec="ekf_node">
    <param name="world_frame" value="map"/>
  </node>
</launch>
"""


def _component(tf_broadcast: str, mark: str = "") -> dict[str, object]:
    """Return a launch file with a component that localises in addition to a filter."""
    launch = _CONTAINER.replace("@", tf_broadcast).replace("%", mark)
    return {"@bridge": True, "launch/nav.launch.xml": launch}


_INCLUDED = """<launch>
  <node pkg="robot_localization" exec="ekf_node">%
    <param name="world_frame" value="map"/>
  </node>
  <include file="$(find-pkg-share nav2_bringup)/launch/bringup_launch.py">
    <arg name="params_file" value="$(find-pkg-share acme_rover_bringup)/config/nav2.yaml"/>
    <arg name="slam" value="@"/>
  </include>
</launch>
"""


def _included_example(slam: str, yaml: str, mark: str = "") -> dict[str, object]:
    """Return a filter for the map in addition to the navigation of another package."""
    return {
        "@bridge": True,
        "launch/nav.launch.xml": _INCLUDED.replace("@", slam).replace("%", mark),
        "config/nav2.yaml": yaml,
    }


_VIRTUAL = """import os

from launch import LaunchDescription
from launch_ros.actions import Node
from moveit_configs_utils import MoveItConfigsBuilder
from moveit_configs_utils.launches import generate_static_virtual_joint_tfs_launch

CONFIG = MoveItConfigsBuilder("rover", package_name="acme_rover_bringup").to_moveit_configs()


def generate_launch_description():
    with open(os.path.join(os.path.dirname(__file__), "../urdf/rover.urdf")) as file:
        text = file.read()
    node = Node(package="robot_state_publisher", executable="robot_state_publisher",
                parameters=[{"robot_description": text}])
    return LaunchDescription([node, generate_static_virtual_joint_tfs_launch(CONFIG)])
"""


def _virtual(parent: str, mark: str = "") -> dict[str, object]:
    """Return a rover whose SRDF has a virtual joint, which MoveIt's launch file publishes."""
    joint = (
        f'<virtual_joint name="v" type="fixed" parent_frame="{parent}" child_link="lidar_link"/>'
    )
    return {
        "@bridge": True,
        "launch/moveit.launch.py": _VIRTUAL,
        "config/rover.srdf": f'<robot name="rover">\n{joint}{mark}\n</robot>\n',
    }


GOOD = [
    {"@bridge": True},
    _mapping("transform_publish_period: 0.0"),
    _mapping("odom_frame: odometry"),
    _included_example("True", "amcl: {ros__parameters: {}}"),
    _included_example("False", "amcl: {ros__parameters: {tf_broadcast: false}}"),
    _component("false"),
    _static('"--frame-id", "lidar_link", "--child-frame-id", "lidar_optical"'),
    _static('"0", "0", "0", "0", "0", "0", "map", "base_link"'),
    _static(
        '"0", "0", "0.1", "0", "0", "0", "base_link", "lidar_link"], namespace="r1", '
        'remappings=[("/tf_static", "tf_static")'
    ),
    _on_footprint("base_link_frame: base_footprint"),
    {
        **_on_footprint("base_link_frame: base_footprint"),
        "@launch": {_LAUNCHED: _LAUNCHED + _FILE_OF_WORDS.replace("%", "")},
    },
    _filter("publish_tf: false"),
    _filter("world_frame: map"),
    _filter("base_link_frame: base_footprint"),
    _filter("publish_tf: true", more=", {'publish_tf': False}"),
    {**_filter("publish_tf: true"), "@launch": {}},
    {**_filter("publish_tf: true"), "@bridge": True},
    {
        **_filter("publish_tf: true"),
        "@bridge": tf_bridge().replace("ros_topic_name: /tf", "ros_topic_name: /gz/tf"),
    },
    _filter("publish_tf: false", name=' name="ekf_filter_node",'),
    _controlled_example("false"),
    {
        **_controlled_example("true"),
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/rover.launch.xml": _PUBLISHED_TWICE,
        "urdf/rover.urdf": DRIVEN_URDF.replace("</robot>\n", _CONTROL).replace(
            '<robot name="rover">', _WITH_ARGUMENT
        ),
    },
    _on_hardware("publish_tf: false"),
    _on_hardware("publish_tf: true", manager=' namespace="r1",'),
    _classic('filename="libgazebo_ros_diff_drive.so">'),
    _classic(f'filename="libgazebo_ros_diff_drive.so">{_TF.format("false")}'),
]
BAD = [
    _mapping("mode: mapping", _XML_MARK),
    {**_mapping(""), "config/slam.yaml": _SLOW},
    _virtual("base_link", _XML_MARK),
    _included_example("False", "amcl: {ros__parameters: {}}", _XML_MARK),
    _component("true", _XML_MARK),
    _static('"--frame-id", "base_link", "--child-frame-id", "lidar_link"', _MARK),
    _static('"0", "0", "0.1", "0", "0", "0", "base_link", "lidar_link"', _MARK),
    _static('"0", "0", "0.1", "0", "0", "0", "lidar_link", "base_link"', _MARK),
    _static('"0", "0", "0", "0", "0", "0", "1", "base_footprint", "lidar_link"', _MARK),
    _on_footprint("publish_tf: true", _MARK),
    {
        **_on_footprint("world_frame: odom"),
        "@launch": {_LAUNCHED: _LAUNCHED + _FILE_OF_WORDS.replace("%", _MARK)},
    },
    {
        **_filter("world_frame: odom"),
        "@bridge": True,
        "@launch": {_LAUNCHED: _EKF_AND_STATIC.replace("%", _MARK)},
    },
    _filter("publish_tf: true", _MARK),
    _filter("odom_frame: map, world_frame: map", _MARK),
    _filter("publish_tf: false", _MARK, name=' name="ekf",'),
    _controlled_example("true", _MARK),
    _on_hardware("publish_tf: true", _MARK),
    _classic(f'filename="libgazebo_ros_diff_drive.so">{_TF.format("true")}{_XML_MARK}'),
    _classic(f'filename="libgazebo_ros_planar_move.so">{_XML_MARK}'),
    {
        **_controlled_example("true", yaml=_MARK),
        "@bridge": True,
        "@launch": {_LAUNCHED: _SPAWNER + _EKF.format("", "").partition("\n")[2]},
        "config/ekf.yaml": "/**:\n  ros__parameters: {publish_tf: true}\n",
    },
]
