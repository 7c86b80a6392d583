"""Odometry in a frame that is not in the TF tree.

A node that uses the odometry looks up the frame to place the robot, and gets an error instead of a
transform. The TF tree contains the robot as `<name>`, its links as `<name>/<link>`, and what
static_transform_publisher adds. No accepted package that we checked shows this: they keep the
default frames.

Fix: remove `<frame_id>` and `<child_frame_id>`, or write `#{_name}/odom` and `#{_name}/base_link`.
Source: parameters of Gazebo's drive systems and OdometryPublisher; frames of pose_tf_broadcaster.
"""

from collections.abc import Iterable, Iterator

from checker.launch.ros1.graph import LaunchGraph, Node
from checker.launch.spawner.reader import SAMPLE_NAME, SAMPLE_WORLD
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked
from checker.source.text import Located

_DRIVES = ("AckermannSteering", "DiffDrive", "MecanumDrive", "TrackedVehicle")
_FRAMES = dict.fromkeys(_DRIVES, ("frame_id", "child_frame_id"))
_FRAMES["OdometryPublisher"] = ("odom_frame", "robot_base_frame")

_BROADCASTER = "pose_tf_broadcaster"
_STATIC = "static_transform_publisher"
_PUBLISH_NO_FRAMES = (
    *("ros_ign_bridge", "ros_ign_image", "ros_ign_point_cloud", "ros1_ign_bridge"),
    *("ros_gz_bridge", "ros_gz_image", "ros_gz_point_cloud", "subt_ros", "topic_tools"),
)
"""Packages whose programs add no frames of other names to the tree."""

_TRANSFORMS = ("TFMessage", "tfMessage")


@rule("DRV011", "unknown-odometry-frame", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph) -> Findings:
    """Report stated frames that nothing publishes, unless other programs may publish them."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    stated = list(_stated_frames(robot))
    if not stated:
        return
    reason = robot.missing_parts or next(iter(launch.unread), "") or _unknown_cause(launch)
    if reason:
        yield unchecked(reason)
        return
    if not _tree_is_known(launch):
        return
    known = {*_own_frames(robot), *_static_frames(launch.nodes)}
    for parameter, frame in stated:
        if frame.value.strip("/") not in known and "$(" not in frame.value:
            yield finding(
                frame,
                f"{parameter} is {_label(frame.value)!r}, which is not in the TF tree of the robot",
            )


def _stated_frames(robot: Robot) -> Iterator[tuple[str, Located[str]]]:
    for plugin in robot.plugins:
        for parameter in _FRAMES.get(plugin.class_name, ()):
            for frame in plugin.at(parameter):
                yield f"{parameter} of {plugin.class_name}", frame


def _unknown_cause(launch: LaunchGraph) -> str:
    missing = launch.unresolved_includes
    return f"{missing[0].package} {missing[0].file} {missing[0].reason}" if missing else ""


def _tree_is_known(launch: LaunchGraph) -> bool:
    """Return whether only the broadcaster and static publishers make the tree."""
    if launch.undecided or not any(node.type == _BROADCASTER for node in launch.nodes):
        return False
    bridged = any(bridge.ros_type.endswith(_TRANSFORMS) for bridge in launch.bridges)
    return not bridged and all(
        node.type == _STATIC or node.package in _PUBLISH_NO_FRAMES for node in launch.nodes
    )


def _own_frames(robot: Robot) -> Iterator[str]:
    """Yield the frames of robot, links and sensors, and the default frames of odometry."""
    yield from (SAMPLE_NAME, f"{SAMPLE_NAME}/odom", SAMPLE_WORLD)
    for link in robot.links:
        frame = f"{SAMPLE_NAME}/{link.scoped_name.replace('::', '/')}"
        yield frame
        for sensor in link.sensors:
            yield f"{frame}/{sensor.name.value}"


def _static_frames(nodes: Iterable[Node]) -> Iterator[str]:
    """Yield the frames at the end of the arguments: six or seven numbers, parent, child, period."""
    for node in nodes:
        if node.type == _STATIC:
            yield from (word.strip("/") for word in node.args.split()[6:])


def _label(frame: str) -> str:
    return frame.replace(SAMPLE_NAME, "<name>")


_SPAWNER = """def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
  <spawn name="#{_name}">
    <sdf version="1.6">
      <include>
        <uri>#{_modelURI}</uri>
        <plugin filename="libd.so" name="ignition::gazebo::systems::DiffDrive">
          FRAMES
        </plugin>
      </include>
    </sdf>
  </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  <<-HEREDOC
  <executable name="topics">
    <command>roslaunch acme_rover_sensor_config_1 vehicle_topics.launch name:=#{_name}</command>
  </executable>
  HEREDOC
end
"""


def _robot(frames: str, *nodes: str) -> dict[str, str]:
    return {
        "launch/spawner.rb": _SPAWNER.replace("FRAMES", frames),
        "launch/vehicle_topics.launch": "\n".join(
            ('<launch><arg name="name"/>', _TF_NODE, *nodes, "</launch>")
        ),
    }


_TF_NODE = '<node pkg="subt_ros" type="pose_tf_broadcaster" name="tf"/>'
_STATIC_NODE = (
    '<node pkg="tf" type="static_transform_publisher" name="foot" '
    'args="0 0 0 0 0 0 $(arg name)/base_link $(arg name)/base_footprint 100"/>'
)
_CHILD = "<child_frame_id>#{_name}/base_link</child_frame_id>"
_FOOT = "<child_frame_id>#{_name}/base_footprint</child_frame_id>"
_MARK = "  <!-- ^ DRV011 -->"

GOOD = [
    _robot(""),
    _robot(f"<frame_id>#{{_name}}/odom</frame_id>{_CHILD}"),
    _robot(_FOOT, _STATIC_NODE),
    _robot(_FOOT, '<node pkg="robot_localization" type="ekf_node" name="ekf"/>'),
]
BAD = [
    _robot(f"{_FOOT}{_MARK}"),
    _robot(f"<frame_id>odom</frame_id>{_MARK}"),
]
