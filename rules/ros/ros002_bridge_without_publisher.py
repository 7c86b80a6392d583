"""A bridge for a sensor or topic that does not exist.

Gazebo builds a sensor's topic from world, model, link and sensor. If a bridge names the wrong link,
its ROS topic exists but never carries a message. A bridge that a condition switches off is only
left over from another robot's launch file, and is an info. A plugin of the author's own may publish
such a topic itself: where the sensor, its link or the model has one, the bridge is not checked.

Topics differ between releases. A thermal camera of Dome publishes its picture under its own name
without `/image` (`sensor/thermal`), and camera_info next to it (`sensor/camera_info`); since
Fortress it publishes both as every camera does (`gazebo_topics.json`).

Fix: write the exact names of the link and its sensor, and a topic that this type of sensor
publishes.
Source: topics that gz-sensors publishes by default; SubT review findings about IMUs that were
bridged from `base_link` but had their own link. Bridges of the launch files of subt_ros are
assumed (`models_common.json`).
"""

from collections.abc import Callable

from checker.base.words import Suggestions
from checker.finding import Fix, Safety
from checker.formats.sdf.links import read_plugin
from checker.launch.ros1.bridge import Bridge, SensorTopic
from checker.launch.ros1.graph import LaunchGraph
from checker.model.components import Link, Plugin, Sensor
from checker.model.plugin_library import gazebo_libraries, library_stem, plugin_libraries
from checker.model.robot import Robot
from checker.package.dependencies import available_packages
from checker.package.package import Package
from checker.ros.topics import comparable, sensor_channels
from checker.rule import Concern, Context, Findings, Severity, finding, rule, unchecked
from checker.source.xml import Element

_Own = Callable[[Plugin], bool]


@rule("ROS002", "bridge-without-publisher", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph, package: Package, context: Context) -> Findings:
    """Report bridges of sensor topics that no sensor of the robot publishes."""
    if robot.missing_parts:
        yield unchecked(robot.missing_parts)
        return
    for reason in launch.unread:
        yield unchecked(reason)
    own = _own_libraries(package, context.release)
    names = Suggestions([*robot.links_by_name, *(sensor.name.value for sensor in robot.sensors)])
    published = _Published(robot, context.release)
    named = _topics_of_plugins(robot)
    for bridge in launch.bridges:
        fault = _fault(robot, bridge, names, published)
        if comparable(bridge.ign_topic) in named:
            continue
        if fault and (plugin := _publisher(robot, bridge, own, context.release)):
            yield unchecked(f"plugin {plugin.filename.value} may publish {bridge.ign_topic} itself")
        elif fault:
            message = _message(bridge, "listens", fault)
            yield finding(bridge, message, key=bridge.ign_topic, fix=_on_its_link(robot, bridge))
    for bridge in launch.dormant_bridges:
        # A template that is switched off serves other configurations.
        if bridge.node.assumed_from:
            continue
        if fault := _fault(robot, bridge, names, published):
            message = _message(bridge, "is switched off, and if switched on listens", fault)
            yield finding(bridge, message, severity=Severity.INFO, key="switched off")


def _on_its_link(robot: Robot, bridge: Bridge) -> Fix | None:
    """Return the fix that names the link of the only sensor of a name, throughout the node."""
    topic, node = bridge.sensor, bridge.node.span.holder
    links = [each.link for each in robot.sensors if topic and each.name.value == topic.sensor]
    if topic is None or len(links) != 1 or links[0] == topic.link or not isinstance(node, Element):
        return None
    before = f"/link/{topic.link}/sensor/{topic.sensor}/"
    after = f"/link/{links[0]}/sensor/{topic.sensor}/"
    named = (node.attribute("args"), *(remap.attribute("from") for remap in node.all("remap")))
    spans = [each.span for each in named if each is not None and before in each.span.text]
    edits = tuple(span.replacement(span.text.replace(before, after)) for span in spans)
    return Fix(Safety.UNSAFE, edits) if edits else None


def _message(bridge: Bridge, listens: str, fault: str) -> str:
    node = bridge.node
    if node.assumed_from:
        return f"{node.assumed_from} (content assumed) {listens} to {fault}"
    return f"bridge {node.name!r} {listens} to {fault}"


class _Published:
    """Topics that sensors publish by default, computed once for each link."""

    def __init__(self, robot: Robot, release: str) -> None:
        self._robot, self._release = robot, release
        self._of_links: dict[str, set[str]] = {}

    def topics_of_sensor(self, sensor: Sensor) -> list[str]:
        """Return the topics of a sensor."""
        channels = sensor_channels(sensor, self._release)
        return [topic for channel in channels for topic in channel.topics]

    def topics_of_link(self, link: Link) -> set[str]:
        """Return the topics of all sensors of a link."""
        name = link.name.value
        if name not in self._of_links:
            self._of_links[name] = {
                topic for sensor in link.sensors for topic in self.topics_of_sensor(sensor)
            }
        return self._of_links[name]


def _fault(robot: Robot, bridge: Bridge, names: Suggestions, published: _Published) -> str | None:
    """Return what a bridge listens to that nothing publishes."""
    topic = bridge.sensor
    if topic is None or bridge.node.usual or "$(" in bridge.ign_topic:
        return None
    link = robot.links_by_name.get(topic.link)
    if link is None:
        return f"link {topic.link!r}, which the model does not have{names.hint(topic.link)}"
    if comparable(bridge.ign_topic) in published.topics_of_link(link):
        return None
    sensor = next((s for s in link.sensors if s.name.value == topic.sensor), None)
    if sensor is None:
        return (
            f"sensor {topic.sensor!r} of link {topic.link!r}, {_whereabouts(robot, topic, names)}"
        )
    topics = published.topics_of_sensor(sensor)
    if not topics or sensor.topic.stated:
        return None
    expected = ", ".join(sorted(_below(sensor, each) for each in topics))
    return (
        f"{topic.suffix or 'no topic'!r} of {sensor.type.value} {topic.sensor!r}, "
        f"which publishes {expected}"
    )


def _below(sensor: Sensor, topic: str) -> str:
    """Return a topic as seen from a sensor's own: `image`; `sensor/front` for one not below it."""
    _, below, suffix = topic.partition(f"/sensor/{sensor.name.value}/")
    return suffix if below else "sensor/" + topic.rpartition("/")[2]


def _own_libraries(package: Package, release: str) -> _Own:
    """Return what states whether a plugin is one that the package, or a dependency, holds itself.

    A plugin that neither contains publishes nothing: PLG002 reports it.
    """
    lenders, known = available_packages(package), plugin_libraries(release)
    held, anywhere = lenders.libraries(), bool(lenders.unknown)

    def is_own(plugin: Plugin) -> bool:
        stem = library_stem(plugin.filename.value)
        return bool(stem) and stem not in known and (anywhere or stem in held)

    return is_own


def _publisher(robot: Robot, bridge: Bridge, own: _Own, release: str) -> Plugin | None:
    """Return a plugin of unknown behaviour that may publish what is bridged.

    The plugins of the challenge publish what their parameters say, those in sensors excepted.
    """
    topic = bridge.sensor
    link = robot.links_by_name.get(topic.link) if topic else None
    around = robot.plugins if link is None else (*robot.plugins, *_plugins_in(link))
    sensors = link.sensors if link else ()
    named = topic.sensor if topic else ""
    inside = [plugin for s in sensors if s.name.value == named for plugin in s.plugins]
    of_challenge = plugin_libraries(release).keys() - gazebo_libraries(release).keys()
    special = (p for p in inside if library_stem(p.filename.value) in of_challenge)
    return next((plugin for plugin in (*around, *inside) if own(plugin)), next(special, None))


def _plugins_in(link: Link) -> list[Plugin]:
    return [read_plugin(element) for element in link.element.all("plugin")]


def _topics_of_plugins(robot: Robot) -> set[str]:
    """Return what parameters of plugins name with a slash, made comparable as topics."""
    elements = (inner for plugin in robot.plugins for inner in plugin.element.descendants())
    texts = (element.text.value.strip() for element in elements)
    return {comparable(text) for text in texts if "/" in text}


def _whereabouts(robot: Robot, topic: SensorTopic, names: Suggestions) -> str:
    elsewhere = [s.link for s in robot.sensors if s.name.value == topic.sensor]
    if elsewhere:
        return f"which is on link {elsewhere[0]!r}"
    return f"which does not exist{names.hint(topic.sensor)}"


def _launch(topic: str, mark: str = "") -> str:
    return f"""<launch>
  <arg name="world_name"/>
  <arg name="name"/>
  <arg name="prefix" value="/world/$(arg world_name)/model/$(arg name)/link"/>
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="imu_bridge"
        args="$(arg prefix)/{topic}@sensor_msgs/Imu[ignition.msgs.IMU"/>{mark}
</launch>
"""


_THERMAL = '<link name="top"><sensor name="thermal" type="thermal"/></link>'
_FRAGMENT = '<link name="imu_link"><sensor name="imu_sensor" type="imu"/></link>'
_TOPICS = "launch/vehicle_topics.launch"
_MARK = "  <!-- ^ ROS002 -->"

GOOD = [
    {"@fragment": _FRAGMENT, _TOPICS: _launch("imu_link/sensor/imu_sensor/imu")},
    {
        "@fragment": """
<plugin filename="libignition-gazebo-odometry-publisher-system.so"
        name="ignition::gazebo::systems::OdometryPublisher">
  <odom_topic>/world/w/model/m/link/base_link/sensor/odom/odometry</odom_topic>
</plugin>
""",
        _TOPICS: _launch("base_link/sensor/odom/odometry"),
    },
    {"@fragment": _THERMAL, _TOPICS: _launch("top/sensor/thermal")},
    {"@fragment": _THERMAL, _TOPICS: _launch("top/sensor/camera_info")},
]
BAD = [
    {"@fragment": _FRAGMENT, _TOPICS: _launch("base_link/sensor/imu_sensor/imu", _MARK)},
    {"@fragment": _FRAGMENT, _TOPICS: _launch("imu_lnk/sensor/imu_sensor/imu", _MARK)},
    {"@fragment": _FRAGMENT, _TOPICS: _launch("imu_link/sensor/imu_sensor/scan", _MARK)},
    {"@fragment": _THERMAL, _TOPICS: _launch("top/sensor/thermal/image", _MARK)},
    {"@fragment": _THERMAL, _TOPICS: _launch("top/sensor/thermal/camera_info", _MARK)},
    {"@fragment": _FRAGMENT, _TOPICS: _launch("imu_link/sensor/camera_info", _MARK)},
    {
        _TOPICS: """<launch>
  <arg name="lidar" default="0"/>
  <node if="$(arg lidar)" pkg="ros_ign_bridge" type="parameter_bridge" name="lidar_bridge"
        args="/world/w/model/m/link/mast/sensor/lidar/scan@a/B[c.D"/>  <!-- ^ ROS002 -->
</launch>
"""
    },
]
