"""A drive of Gazebo Classic that publishes no odometry, while the package uses it.

In ROS 2 the drives publish odometry only where they are told to: `<publish_odom>` and
`<publish_odom_tf>` are false by default, in ROS 1 odometry was always published. The topic and the
transform are missing without a message, and navigation waits for them.

It is reported for a drive that does not state `<publish_odom>`, where a `<remapping>` of the plugin
names the topic, or a node that a launch file starts reads it and nothing else publishes it.

Fix: write `<publish_odom>true</publish_odom>`, and `<publish_odom_tf>true</publish_odom_tf>` unless
another node publishes the transform, such as a filter of robot_localization.
Source: gazebo_plugins for ROS 2, gazebo_ros_diff_drive.cpp, gazebo_ros_ackermann_drive.cpp and
gazebo_ros_tricycle_drive.cpp (`gazebo_classic_ros2.json`).
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.package.package import Package
from checker.package.target import ros_2_package
from checker.ros.spawned_files import SpawnedFiles
from checker.ros.wiring.classic import unsent_topics
from checker.ros.wiring.endpoints import Endpoint, remap_rule, remap_texts
from checker.ros.wiring.wiring import Wirings
from checker.rule import Concern, Context, Finding, Findings, Safety, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml_insertion import append_to

_ODOMETRY, _PARAMETER = "nav_msgs/msg/Odometry", "publish_odom"


@rule("PLG014", "odometry-not-published", Severity.WARNING, Concern.INTERFACE)
def check(
    host: PluginHost,
    package: Package,
    wirings: Wirings | None,
    spawned: SpawnedFiles | None,
    context: Context,
) -> Findings:
    """Report drives that do not publish the odometry that they remap or that a node reads."""
    if not context.is_classic or ros_2_package(package) is None:
        return
    if host.robot is not None and spawned is not None and spawned.without(host.robot):
        return
    for plugin in host.plugins:
        for topic in unsent_topics(plugin):
            if topic.types != (_ODOMETRY,):
                continue
            if remapping := next(_remappings(plugin), None):
                yield _unsent(plugin, remapping, f"the odometry that it remaps to {topic.topic}")
            elif reader := _reader(wirings, topic.topic):
                message = f"odometry, and {reader.by} reads {topic.topic}"
                yield _unsent(plugin, plugin, message)


def _remappings(plugin: Plugin) -> Iterator[Located[str]]:
    for text in remap_texts(plugin):
        if remap_rule(text.value)[0].strip("/") == "odom":
            yield text


def _reader(wirings: Wirings | None, topic: str) -> Endpoint | None:
    """Return what reads odometry from a topic that is certainly not published."""
    if wirings is None or any(each.more_publishers(_ODOMETRY) for each in wirings.all):
        return None
    ends = [end for each in wirings.all for end in each.endpoints if end.topic == topic]
    if any(end.publishes for end in ends):
        return None
    return next((end for end in ends if _ODOMETRY in end.types), None)


def _unsent(plugin: Plugin, place: Located[str] | Plugin, what: str) -> Finding:
    line = f"<{_PARAMETER}>true</{_PARAMETER}>"
    return finding(
        place,
        f"{plugin.label} does not publish {what}: write {line}, which is false by default",
        fix=Fix(Safety.UNSAFE, (append_to(plugin.element, [line]),)),
    )


def _drive(parameters: str, launch: str = "") -> dict[str, object]:
    plugin = f'<plugin filename="libgazebo_ros_diff_drive.so" name="drive">{parameters}</plugin>'
    return {
        "@profile": "gazebo-classic",
        "@ros2": True,
        "urdf/arm.urdf.xacro": None,
        "@fragment": plugin,
        **({"launch/drive.launch.xml": launch} if launch else {}),
    }


_READER = """<launch>
  <node pkg="robot_localization" exec="ekf_node"><param name="odom0" value="/odom"/></node>
</launch>
"""
_REMAPPING = "<ros><remapping>odom:=wheel_odom</remapping>{}</ros>"
_ON = "<publish_odom>{}</publish_odom>"
_MARK = "  <!-- ^ PLG014 -->"
GOOD = [
    _drive(_REMAPPING.format("") + _ON.format("true")),
    _drive(_ON.format("false"), _READER),
    _drive("<left_joint>left</left_joint>"),
    _drive(_ON.format("true"), _READER),
]
BAD = [
    _drive(_REMAPPING.format(_MARK)),
    _drive(_MARK, _READER),
]
