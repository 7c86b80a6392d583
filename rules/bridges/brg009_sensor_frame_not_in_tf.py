"""Messages of a sensor are in a frame that nothing publishes.

Unless the sensor states the frame of its messages, Gazebo calls it `<model>::<link>::<sensor>`, and
the bridge makes `<model>/<link>/<sensor>` of it. robot_state_publisher publishes the links under
their own names: RViz shows nothing, and mapping and navigation drop the messages. It is reported
for lidars, cameras, IMUs, magnetometers and receivers of satellite navigation that the launch file
bridges, of a robot whose transforms come from the same description, unless a launch file of the
workspace names the frame. A stated frame is also compared with the links where the launch file
starts no robot_state_publisher. From Garden on, `<optical_frame_id>` of a `<camera>` names it too.

Fix: write `<gz_frame_id>` (in Fortress `<ignition_frame_id>`, from Ionic on `<frame_id>`) with the
name of the link into the sensor; of a camera, that of its optical link.
Source: gz-sensors, frame of messages and CameraSensor::OpticalFrameId;
ros_gz_project_template issue 23, gz-sensors issue 306.
"""

from checker.finding import Fix
from checker.launch.ros1.bridge import Direction
from checker.launch.ros2.graph import Node, is_known
from checker.model.components import Sensor
from checker.model.robot import Robot
from checker.model.sensing.kind import SensorType, frame_elements, frame_of, stated_frame
from checker.package.package import Package
from checker.robots.urdf_files import UrdfFiles
from checker.ros.broadcast_frames import is_broadcast
from checker.ros.simulation import Simulation, Simulations
from checker.ros.spawned import SpawnedRobot, is_state_publisher
from checker.ros.wiring.wiring import Wirings
from checker.rule import Concern, Context, Findings, Safety, Severity, finding, rule
from checker.source.xml_insertion import append_to

_STATIC = ("static_transform_publisher", "tf2_ros::StaticTransformBroadcasterNode")
_PUBLISHES_POSES = "PosePublisher"
_WITH_FRAME = (SensorType.IMU, SensorType.MAGNETOMETER, SensorType.NAVSAT)


@rule("BRG009", "sensor-frame-not-in-tf", Severity.WARNING, Concern.INTERFACE)
def check(
    simulations: Simulations,
    package: Package,
    context: Context,
    files: UrdfFiles | None,
    wirings: Wirings | None,
) -> Findings:
    """Report the sensors whose frame is no link."""
    for simulation in simulations.launched:
        for spawned in simulation.robots:
            if _may_publish_more(simulation, spawned):
                continue
            for sensor in spawned.robot.sensors:
                if not _counts(sensor) or not _is_bridged(simulation, sensor):
                    continue
                stated = stated_frame(sensor.element, context.release)
                if stated is None:
                    yield from _unstated(sensor, spawned, package, context)
                elif _is_unknown(stated.value.strip(), spawned, package):
                    others = _other_frames(simulation, spawned, files, wirings)
                    if others is not None and stated.value.strip() not in others:
                        yield finding(
                            stated,
                            f"messages of the {sensor.type.value} sensor {sensor.name.value!r} "
                            f"are in the frame {stated.value!r}, which is not a link of the robot",
                        )


def _unstated(
    sensor: Sensor, spawned: SpawnedRobot, package: Package, context: Context
) -> Findings:
    """Report a sensor without a frame whose robot's links are published."""
    texts = package.workspace.launch_texts.values()
    if spawned.publisher is None or any(f"/{sensor.name.value}" in text for text in texts):
        return
    tag, frame = frame_elements(context.release)[0], _frame(sensor, spawned.robot)
    yield finding(
        sensor,
        f"messages of the {sensor.type.value} sensor {sensor.name.value!r} are in "
        f"a frame that ends in /{sensor.name.value}, which no transform names; expected "
        f"<{tag}>{frame}",
        fix=_stated(sensor, f"<{tag}>{frame}</{tag}>", frame),
    )


def _other_frames(
    simulation: Simulation,
    spawned: SpawnedRobot,
    files: UrdfFiles | None,
    wirings: Wirings | None,
) -> set[str] | None:
    """Return the frames beside the robot's own links; None if they are not known.

    Where the launch file does not publish this description, another one may, and so may the user's
    other descriptions be published.
    """
    if spawned.publisher is not None:
        return set()
    nodes: tuple[Node, ...] = simulation.graph.nodes if simulation.graph is not None else ()
    if spawned.robot.format != "urdf" or any(map(is_state_publisher, nodes)):
        return None
    robots = [it.robot for it in files.descriptions] if files is not None else []
    links = {frame_of(link) for robot in robots for link in robot.links_by_name}
    wired = wirings.all if wirings is not None else ()
    return links.union(*((it.parent, it.child) for each in wired for it in each.transforms))


def _frame(sensor: Sensor, robot: Robot) -> str:
    """Return the link that is the frame of a sensor: of a camera, its optical link if any."""
    below = (tie for tie in robot.tree.ties if tie.parent == sensor.link)
    fixed = [tie.child for tie in below if tie.joint.type.value == "fixed"]
    optical = [name for name in fixed if "optical" in name.lower()]
    shows = len(optical) == 1 and sensor.kind.takes_pictures
    return frame_of(optical[0] if shows else sensor.link)


def _stated(sensor: Sensor, line: str, frame: str) -> Fix | None:
    """Return the fix that adds a line; None where the file puts the name of the frame together."""
    if frame not in sensor.element.written.source.text:
        return None
    return Fix(Safety.UNSAFE, (append_to(sensor.element, [line]),))


def _may_publish_more(simulation: Simulation, spawned: SpawnedRobot) -> bool:
    """Return whether transforms of other frames may exist, or frames be renamed."""
    nodes: tuple[Node, ...] = simulation.graph.nodes if simulation.graph is not None else ()
    plugins = {plugin.class_name for plugin in spawned.robot.plugins}
    prefix = spawned.publisher.parameter("frame_prefix") if spawned.publisher is not None else None
    return (
        _PUBLISHES_POSES in plugins
        or (prefix is not None and prefix.value not in ("", "/"))
        or any(map(_is_unknown_static, nodes))
        or any(entry.passed.overrides_frame for entry in simulation.entries)
        or any(node.parameter("override_frame_id") is not None for node in nodes)
    )


def _is_unknown_static(node: Node) -> bool:
    """Return whether a node publishes static transforms of frames that are not known."""
    words = [word.value for word in node.arguments]
    return node.executable.value in _STATIC and not (words and all(map(is_known, words)))


def _counts(sensor: Sensor) -> bool:
    return sensor.kind.is_lidar or sensor.kind.takes_pictures or sensor.kind in _WITH_FRAME


def _is_bridged(simulation: Simulation, sensor: Sensor) -> bool:
    return any(
        topic.owner is sensor
        for entry in simulation.entries
        if entry.direction is not Direction.TO_IGN
        for topic in simulation.topics_of(entry)
    )


def _is_unknown(frame: str, spawned: SpawnedRobot, package: Package) -> bool:
    """Return whether a frame is no link of the robot, and nothing of the user's broadcasts it."""
    links = map(frame_of, spawned.robot.links_by_name)
    known = not is_known(frame) or "/" in frame or frame in links
    return not known and not is_broadcast(package, frame)


_FRAME = "<gz_frame_id>lidar_link</gz_frame_id>"
_SENSOR = '<sensor name="lidar" type="gpu_lidar">'


def _rover(frame: str, mark: str = "") -> dict[str, object]:
    text = _ROVER.replace(_FRAME, frame)
    return {"@bridge": True, "urdf/rover.urdf": text.replace(_SENSOR, _SENSOR + mark)}


_ROVER = f"""<robot name="rover">
  <link name="base_link"/>
  <link name="lidar_link"/>
  <joint name="lidar_joint" type="fixed">
    <parent link="base_link"/><child link="lidar_link"/>
  </joint>
  <gazebo reference="lidar_link">
    {_SENSOR}
      <topic>scan</topic>
      {_FRAME}
    </sensor>
  </gazebo>
</robot>
"""
_MAGNETOMETER = '<sensor name="compass" type="magnetometer">'
_PASSED = """- topic_name: /{}
  ros_type_name: sensor_msgs/msg/{}
  gz_type_name: gz.msgs.{}
  direction: GZ_TO_ROS
"""


def _other(sensor: str, inside: str, *passed: str, mark: str = "") -> dict[str, object]:
    """Return a rover with a sensor that a bridge passes: its topic and both messages."""
    text = _ROVER.replace(_FRAME, inside).replace(_SENSOR, sensor + mark)
    return {"@bridge": _PASSED.format(*passed), "urdf/rover.urdf": text}


_CAMERA = '<sensor name="camera" type="camera">'
_IMAGE = ("scan", "Image", "Image")
_OPTICAL = "<camera><optical_frame_id>{}</optical_frame_id></camera>".format
_PUBLISHED = """Node(package="tf2_ros", executable="static_transform_publisher",
  arguments=["0", "0", "0", "0", "0", "0", "lidar_link", "rover/base_link/lidar"]),
"""
_OTHER = {"LaunchDescription([\n": f"LaunchDescription([{_PUBLISHED.replace('/lidar', '/imu')}"}
_ELSEWHERE = """<launch><node pkg="tf2_ros" exec="static_transform_publisher"
  args="0 0 0 0 0 0 lidar_link rover/base_link/lidar"/></launch>
"""
GOOD = [
    {"@bridge": True},
    _rover(_FRAME),
    {**_rover(""), "@launch": {"LaunchDescription([\n": f"LaunchDescription([{_PUBLISHED}"}},
    {**_rover(""), "@launch": {'executable="robot_state_publisher"': 'executable="other"'}},
    {**_rover(""), "@bridge": "[]\n"},
    {**_rover(""), "launch/slam.launch.xml": _ELSEWHERE},
    _other(_CAMERA, _OPTICAL("lidar_link"), *_IMAGE),
    _other(_MAGNETOMETER, _FRAME, "scan", "MagneticField", "Magnetometer"),
    {"@bridge": True, "urdf/rover.urdf": _ROVER.replace('"lidar_link"', '"/lidar_link"')},
]
_ALONE = {'executable="robot_state_publisher"': 'executable="other"'}
_LASER = "<gz_frame_id>laser</gz_frame_id>"
GOOD += [
    {
        **_rover(_LASER),
        "launch/slam.launch.xml": _ELSEWHERE.replace("rover/base_link/lidar", "laser"),
    },
    {
        **_rover(_LASER),
        "@launch": _ALONE,
        "urdf/real.urdf": '<robot name="rover"><link name="laser"/></robot>',
    },
]
BAD = [
    {**_rover(f"{_LASER} <!-- ^ BRG009 -->"), "@launch": _ALONE},
    _rover("", " <!-- ^ BRG009 -->"),
    _rover("<gz_frame_id>laser</gz_frame_id> <!-- ^ BRG009 -->"),
    {**_rover("", " <!-- ^ BRG009 -->"), "@launch": _OTHER},
    _other(_CAMERA, _OPTICAL("lens") + " <!-- ^ BRG009 -->", *_IMAGE),
    _other(_MAGNETOMETER, "", "scan", "MagneticField", "Magnetometer", mark=" <!-- ^ BRG009 -->"),
    _other(
        '<sensor name="gnss" type="navsat">',
        "",
        "scan",
        "NavSatFix",
        "NavSat",
        mark=" <!-- ^ BRG009 -->",
    ),
]
