"""A camera image that is not published in an optical frame.

Gazebo's cameras look along x, but ROS programs for images expect z: without an
optical_frame_publisher, the direction to every detected object is off by 90 degrees. The image
itself is published, so this is a warning. The rule assumes the nodes that the launch files of
subt_ros start (`models_common.json`).

Fix: start an optical_frame_publisher of subt_ros next to the bridge, with remaps for `input/image`,
`output/image`, `input/camera_info` and `output/camera_info`; for a depth image with `args="depth"`.
Source: SubT review findings about cameras without it; REP 103, suffix frames of cameras.
"""

from collections.abc import Iterator

from checker.launch.ros1.bridge import Bridge, Direction
from checker.launch.ros1.graph import LaunchGraph
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.ros.topics import Channel, channels, comparable
from checker.ros.transforms import optical_frames
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked

_COLOUR, _DEPTH = "image", "depth image"


@rule("ROS006", "no-optical-frame", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, context: Context) -> Findings:
    """Report bridged colour and depth images that no optical_frame_publisher reads."""
    for reason in dict.fromkeys((robot.missing_parts, *launch.unread)):
        if reason:
            yield unchecked(reason)
    # The command that cannot be read may switch on what is off without it.
    nodes = (*launch.nodes, *(launch.dormant_nodes if launch.unread else ()))
    taken = {frame.input_image for frame in optical_frames(nodes)}
    pictures = _pictures(robot, launch, context.release)
    lacking = [pair for pair in pictures if pair[0].ros_topic not in taken]
    if lacking and launch.unseen_bridges:
        yield unchecked(launch.unseen_bridges[0])
        return
    if launch.unread and launch.dormant_includes:
        return
    for bridge, channel in lacking:
        depth = channel.what == _DEPTH
        yield finding(
            bridge,
            f"no optical_frame_publisher reads the {'depth' if depth else 'colour'} image of "
            f"{channel.owner_name}: expected one node for each image",
            key=channel.what,
        )


def _pictures(robot: Robot, launch: LaunchGraph, release: str) -> Iterator[tuple[Bridge, Channel]]:
    """Yield the bridges of colour and depth images."""
    pictures = {
        topic: channel
        for channel in channels(robot, release)
        if _is_picture(channel)
        for topic in channel.topics
    }
    for bridge in launch.bridges:
        channel = pictures.get(comparable(bridge.ign_topic))
        if channel is not None and bridge.direction is Direction.TO_ROS:
            yield bridge, channel


def _is_picture(channel: Channel) -> bool:
    if channel.what == _DEPTH:
        return True
    sensor = channel.owner
    return channel.what == _COLOUR and isinstance(sensor, Sensor) and sensor.kind.sees_colours


_TOPICS = "launch/vehicle_topics.launch"
_PREFIX = "/world/w/model/m/link/base_link/sensor/front"
_BRIDGE = f"""<node pkg="ros_ign_image" type="image_bridge" name="bridge"
  args="{_PREFIX}/image">MARK
  <remap from="{_PREFIX}/image" to="front/image_raw"/>
</node>"""
_OPTICAL = """<node pkg="subt_ros" type="optical_frame_publisher" name="optical">
  <remap from="input/image" to="FROM"/>
  <remap from="output/image" to="front/optical/image_raw"/>
  <remap from="input/camera_info" to="front/camera_info"/>
  <remap from="output/camera_info" to="front/optical/camera_info"/>
</node>"""
_TEMPLATE = f"""<include file="$(find subt_ros)/launch/models_common/rgb_camera.launch">
  <arg name="gazebo_topic" value="{_PREFIX}"/>
</include>"""


def _robot(kind: str, *nodes: str, marked: bool = False) -> dict[str, str]:
    mark = "  <!-- ^ ROS006 -->" if marked else ""
    lines = "\n".join(("<launch>", *nodes, "</launch>"))
    return {
        "@fragment": f'<sensor name="front" type="{kind}"/>',
        _TOPICS: lines.replace("MARK", mark),
    }


GOOD = [
    _robot("camera", _BRIDGE, _OPTICAL.replace("FROM", "front/image_raw")),
    _robot("camera", _TEMPLATE),
    _robot("thermal_camera", _BRIDGE),
]
BAD = [
    _robot("camera", _BRIDGE, marked=True),
    _robot("camera", _BRIDGE, _OPTICAL.replace("FROM", "rear/image_raw"), marked=True),
    _robot("rgbd_camera", _BRIDGE.replace("/image", "/depth_image"), marked=True),
]
