"""No bridge connects a sensor or drive to ROS.

Gazebo's topics are separate from those of ROS: without a bridge no ROS node receives a camera's
images, and the robot never receives `cmd_vel`. Topics that a condition of the launch file switches
off for this configuration count as not bridged. The launch files of the package subt_ros are not
part of a submission. The rule assumes which topics those of `models_common` bridge, from how
accepted packages use them (`models_common.json`).

Contact sensors, logical cameras, altimeters and plugins that are not Gazebo's own need no bridge
here. A lidar needs a bridge for its scan or for its points. The topics
are those of the release: a thermal camera of Dome publishes its picture at `sensor/<name>`, and
camera_info at `sensor/camera_info`, without its name (`gazebo_topics.json`).

Fix: add a bridge to `vehicle_topics.launch`: a `parameter_bridge` of ros_ign_bridge, or for images
an `image_bridge` of ros_ign_image, with a remap to the name in ROS.
Source: SubT review findings of missing bridges; topics of gz-sensors and Gazebo's systems.
"""

from collections import Counter, defaultdict
from collections.abc import Collection, Iterable, Iterator
from itertools import chain

from checker.finding import Place
from checker.launch.ros1.graph import LaunchGraph
from checker.model.components import Plugin, Sensor
from checker.model.robot import Robot
from checker.ros.added_bridges import bridging
from checker.ros.topics import (
    Channel,
    Need,
    by_topic,
    channels,
    comparable,
    standard_topics,
)
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked

_CHALLENGE = "subt"
_GROUPS = {"depth": "depth image and points", "ranges": "scan and points"}
_USUAL = "vehicle_topics.launch"
_LISTENS = ("LinearBatteryPlugin",)
"""Plugins that only listen to commands for other plugins."""


@rule("ROS001", "topic-not-bridged", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, context: Context) -> Findings:
    """Report topics of sensors and plugins that no node bridges between Gazebo and ROS."""
    if not robot.conventions.read_by_gazebo:
        # Described for Gazebo Classic, whose sensors publish to ROS themselves.
        return
    for reason in dict.fromkeys((robot.missing_parts, robot.unread_plugins, *launch.unread)):
        if reason:
            yield unchecked(reason)
    bridged = set(by_topic(launch.bridges))
    if launch.unread:
        # The command that cannot be read may switch on what is off without it.
        bridged |= set(by_topic(launch.dormant_bridges))
        if not bridged or launch.dormant_includes:
            return
    missing = list(_unbridged_channels(robot, bridged, context.release))
    standard = _missing_standard(robot, context, bridged)
    if (missing or standard) and launch.unseen_bridges:
        yield unchecked(launch.unseen_bridges[0])
        return
    place = Place(_launch_file(robot, launch))
    if missing and not bridged:
        owners = dict.fromkeys(channel.owner_name for channel in missing)
        yield finding(place, f"no topic of the robot is bridged, for example {next(iter(owners))}")
        return
    assuming = _assumption_phrase(launch)
    yield from _findings(missing, place, assuming, launch)
    for topic in standard:
        shown = topic.replace("*", "<name>")
        message = f"no bridge for {shown}, which every robot of the challenge has"
        yield finding(place, message + assuming)


def _unbridged_channels(robot: Robot, bridged: Collection[str], release: str) -> Iterator[Channel]:
    """Yield one channel of each group in which none is bridged: of several rows the points."""
    groups: dict[tuple[Sensor | Plugin, str], list[Channel]] = defaultdict(list)
    for channel in channels(robot, release):
        groups[channel.owner, channel.group].append(channel)
    commanded = _commanded_inside(robot, {owner for owner, _ in groups})
    for group in groups.values():
        topics = [topic for channel in group for topic in channel.topics]
        if group[0].need is not Need.OPTIONAL and not any(
            topic in bridged or topic in commanded for topic in topics
        ):
            yield group[-1] if _has_rows(group[0]) else group[0]


def _has_rows(channel: Channel) -> bool:
    """Return whether a scan has only one of a lidar's rows."""
    lidar = channel.owner.lidar if isinstance(channel.owner, Sensor) else None
    return channel.what == "scan" and lidar is not None and lidar.rows > 1


def _commanded_inside(robot: Robot, known: Collection[Sensor | Plugin]) -> frozenset[str]:
    """Return the topics that unknown plugins name: they may be the other end."""
    others = (plugin for plugin in robot.plugins if plugin not in known)
    parameters = chain.from_iterable(
        other.element.descendants() for other in others if other.class_name not in _LISTENS
    )
    texts = (element.text.value.strip() for element in parameters)
    return frozenset(comparable(text) for text in texts if "/" in text)


def _missing_standard(robot: Robot, context: Context, bridged: Collection[str]) -> list[str]:
    """Return what must be bridged although the plugins that publish it cannot be read."""
    if not robot.unread_plugins or context.profile != _CHALLENGE:
        return []
    return [topic for topic in standard_topics() if topic not in bridged]


def _assumption_phrase(launch: LaunchGraph) -> str:
    """Return the end of a message that depends on assumptions about templates of subt_ros."""
    files = dict.fromkeys(bridge.node.assumed_from for bridge in launch.bridges)
    named = ", ".join(file for file in files if file)
    return f", assuming that {named} of subt_ros has none" if named else ""


def _findings(
    missing: Iterable[Channel], place: Place, assuming: str, launch: LaunchGraph
) -> Iterator[Finding]:
    """Yield one finding for all missing bridges of an owner."""
    by_owner: dict[tuple[Sensor | Plugin, Need], list[Channel]] = defaultdict(list)
    seen: set[tuple[str, ...]] = set()
    for channel in missing:
        # Several plugins may listen to one topic.
        if channel.topics not in seen:
            by_owner[channel.owner, channel.need].append(channel)
        seen.add(channel.topics)
    for (owner, need), lacking in by_owner.items():
        names = ", ".join(_GROUPS.get(topic.group, topic.what) for topic in lacking)
        yield finding(
            place,
            f"no bridge for {names} of {lacking[0].owner_name}{assuming}",
            severity=Severity.WARNING if need is Need.WANTED else None,
            related=[(owner, "not bridged")],
            fix=bridging(launch, lacking),
        )


def _launch_file(robot: Robot, launch: LaunchGraph) -> str:
    """Return the file in which a missing bridge belongs: the one with most other bridges."""
    read = [node for node in launch.nodes if not node.assumed_from]
    counted = Counter(bridge.node.file for bridge in launch.bridges)
    counted.update(node.file for node in (*read, *launch.nodes) if not counted)
    for argument in launch.arguments.values():
        counted.setdefault(argument.span.source.file, 0)
    usual = {file for file in counted if file.endswith(_USUAL)}
    return max(
        counted, key=lambda file: (counted[file], file in usual), default=robot.span.source.file
    )


_TOPICS = "launch/vehicle_topics.launch"


def _launch(*bridges: str, extra: str = "") -> str:
    nodes = "\n".join(
        f'<node pkg="ros_ign_bridge" type="parameter_bridge" name="bridge_{number}" '
        f'args="{bridge}"/>'
        for number, bridge in enumerate(bridges)
    )
    return (
        '<launch>  <!-- MARK -->\n<arg name="world_name"/><arg name="name"/>'
        '<arg name="prefix" value="/world/$(arg world_name)/model/$(arg name)/link"/>\n'
        f'<arg name="uav" default="0"/>\n{nodes}\n{extra}\n</launch>\n'
    )


def _marked(text: str) -> str:
    return text.replace("MARK", "^ ROS001")


def _spawner(plugin: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
  <spawn name="#{{_name}}">
    <sdf version="1.6">
      <include>
        <uri>#{{_modelURI}}</uri>
{plugin}
      </include>
    </sdf>
  </spawn>
  HEREDOC
end

def rosExecutables(_name, _worldName)
  <<-HEREDOC
  <executable name="topics">
    <command>roslaunch acme_rover_sensor_config_1 vehicle_topics.launch name:=#{{_name}}</command>
  </executable>
  HEREDOC
end
"""


_CAMERA = '<sensor name="front" type="camera"/>'
_IMAGE = "$(arg prefix)/base_link/sensor/front/image@sensor_msgs/Image[ignition.msgs.Image"
_INFO = (
    "$(arg prefix)/base_link/sensor/front/camera_info"
    "@sensor_msgs/CameraInfo[ignition.msgs.CameraInfo"
)
_THERMAL = '<sensor name="thermal" type="thermal"/>'
_HEAT = "$(arg prefix)/base_link/sensor/thermal@sensor_msgs/Image[ignition.msgs.Image"
_HEAT_INFO = _INFO.replace("front/camera_info", "camera_info")
_POINTS = (
    "$(arg prefix)/base_link/sensor/lidar/scan/points"
    "@sensor_msgs/PointCloud2[ignition.msgs.PointCloudPacked"
)
_TEMPLATE = """<include file="$(find subt_ros)/launch/models_common/FILE">
  <arg name="gazebo_topic" value="$(arg prefix)/base_link/sensor/front"/>
</include>"""
_IMU = "$(arg prefix)/base_link/sensor/imu/imu@sensor_msgs/Imu[ignition.msgs.IMU"
_IMU_NODE = (
    '<node if="$(arg uav)" pkg="ros_ign_bridge" type="parameter_bridge" name="imu_bridge" '
    f'args="{_IMU}"/>'
)
_DRIVE = '<plugin filename="d.so" name="ignition::gazebo::systems::DiffDrive">{}</plugin>'
_CMD_VEL = "/model/$(arg name)/cmd_vel@geometry_msgs/Twist]ignition.msgs.Twist"
_ODOMETRY = "/model/$(arg name)/odometry@nav_msgs/Odometry[ignition.msgs.Odometry"
_MIXER = '<plugin filename="m.so" name="acme::Mixer"><out>/model/#{_name}/mixed</out></plugin>'

_LIDAR = """<sensor name="lidar" type="gpu_lidar"><lidar><scan>
  <vertical><samples>16</samples></vertical>
</scan></lidar></sensor>"""
_GROUP = """<group ns="$(arg name)">
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="bridge_imu"
        args="$(arg prefix)/base_link/sensor/imu/imu@sensor_msgs/Imu[ignition.msgs.IMU">
    <remap from="$(arg prefix)/base_link/sensor/imu/imu" to="imu/data"/>
  </node>
</group>"""

GOOD = [
    {"@fragment": _CAMERA, _TOPICS: _launch(_IMAGE, _INFO)},
    {"@fragment": _THERMAL, _TOPICS: _launch(_HEAT, _HEAT_INFO)},
    {"@fragment": '<sensor name="lidar" type="gpu_ray"/>', _TOPICS: _launch(_POINTS)},
    {"@fragment": '<sensor name="bumper" type="contact"/>', _TOPICS: _launch()},
    {
        "@fragment": '<sensor name="front" type="camera"><topic>eyes/picture</topic></sensor>',
        _TOPICS: _launch(
            "/eyes/picture@sensor_msgs/Image[ignition.msgs.Image",
            "/eyes/camera_info@sensor_msgs/CameraInfo[ignition.msgs.CameraInfo",
        ),
    },
    {
        "@fragment": _CAMERA,
        _TOPICS: _launch(extra=_TEMPLATE.replace("FILE", "rgb_camera.launch")),
    },
    {"launch/spawner.rb": _spawner(_DRIVE.format("")), _TOPICS: _launch(_CMD_VEL, _ODOMETRY)},
    {
        "launch/spawner.rb": _spawner(
            _DRIVE.format("<topic>/model/#{_name}/mixed</topic>") + _MIXER
        ),
        _TOPICS: _launch(_ODOMETRY),
    },
]
BAD = [
    {"@fragment": _CAMERA, _TOPICS: _marked(_launch())},
    {"@fragment": _CAMERA, _TOPICS: _marked(_launch(_IMAGE))},
    {
        "@fragment": f'{_LIDAR}<sensor name="imu" type="imu"/>',
        _TOPICS: _marked(_launch(extra=_GROUP)),
    },
    {
        "@fragment": _THERMAL,
        _TOPICS: _marked(_launch(_HEAT, _INFO.replace("/front/", "/thermal/"))),
    },
    {
        "@fragment": _THERMAL,
        _TOPICS: _marked(_launch(_HEAT.replace("/thermal@", "/thermal/image@"), _HEAT_INFO)),
    },
    {
        "@fragment": f'{_CAMERA}<sensor name="imu" type="imu"/>',
        _TOPICS: _marked(_launch(_IMU, extra=_TEMPLATE.replace("FILE", "lidar_3d.launch"))),
    },
    {
        "@fragment": f'{_CAMERA}<sensor name="imu" type="imu"/>',
        _TOPICS: _marked(_launch(_IMAGE, _INFO, extra=_IMU_NODE)),
    },
    {"launch/spawner.rb": _spawner(_DRIVE.format("")), _TOPICS: _marked(_launch(_ODOMETRY))},
    {
        "launch/spawner.rb": _spawner(_DRIVE.format("<topic>/model/#{_name}/go</topic>")),
        _TOPICS: _marked(_launch(_CMD_VEL, _ODOMETRY)),
    },
    {
        "@fragment": '<sensor name="front" type="rgbd_camera"/>',
        _TOPICS: _marked(
            _launch(
                _IMAGE,
                _IMAGE.replace("front/image", "front/depth_image"),
                _POINTS.replace("lidar/scan/points", "front/points"),
            )
        ),
    },
]
