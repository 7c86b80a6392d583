"""Breadcrumbs that ROS nodes cannot drop or count.

A team drops a relay with `breadcrumb/deploy` and reads from `breadcrumb/remaining` how many are
left. Launch files bridge both only when the spawner passes `breadcrumbs:=1`; without the bridges no
relay is ever dropped. If only the count is missing, this is a warning; on a robot without
breadcrumbs it is an info, since another configuration may start the same launch file.

Fix: bridge the plugin's topic and its `/remaining` in vehicle_topics.launch, or include
`breadcrumbs.launch` of `subt_ros`, and pass `breadcrumbs:=1` in the spawner.
Source: SubT reviews of breadcrumbs; topics of Gazebo's Breadcrumbs plugin.
"""

from collections.abc import Iterable, Iterator

from checker.launch.ros1.bridge import Bridge
from checker.launch.ros1.graph import LaunchGraph
from checker.model.breadcrumbs import Breadcrumbs, breadcrumbs
from checker.model.robot import Robot
from checker.ros.added_bridges import bridging
from checker.ros.topics import plugin_channels
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

DEPLOY = "/deploy"
REMAINING = "/deploy/remaining"
WITHOUT_BRIDGES = "description.launch "
"""A launch file that only loads the robot's description."""
_WORD = "breadcrumb"


@rule("BRD003", "breadcrumbs-not-bridged", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot, launch: LaunchGraph) -> Findings:
    """Look for bridges of each plugin's topics, and for a count next to each bridge that drops."""
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    bridged = any(_drops(bridge) for bridge in launch.bridges) or _is_included(launch)
    plugins = () if bridged else breadcrumbs(robot)
    unread = [reason for reason in launch.unread if not reason.startswith(WITHOUT_BRIDGES)]
    for plugin in plugins:
        if unread:
            yield unchecked(unread[0])
        else:
            yield from _missing_bridges(plugin, launch)
    carried = bool(robot.unread_plugins or breadcrumbs(robot))
    yield from _missing_counts((*launch.bridges, *launch.dormant_bridges), carried=carried)


def _is_included(launch: LaunchGraph) -> bool:
    """Return whether a launch file of the challenge is included that bridges breadcrumbs."""
    files = (include.file.rpartition("/")[2].lower() for include in launch.unresolved_includes)
    return any(_WORD in file for file in files)


def _missing_bridges(plugin: Breadcrumbs, launch: LaunchGraph) -> Iterator[Finding]:
    """Report why no bridge commands a plugin; a bridge that is switched off does not count."""
    off = next((bridge for bridge in launch.dormant_bridges if _drops(bridge)), None)
    if off is None:
        yield finding(
            plugin,
            "the topics of Breadcrumbs are not bridged: expected bridges for deploy and "
            "deploy/remaining",
            fix=bridging(launch, [*plugin_channels(plugin.plugin)]),
        )
    else:
        yield finding(
            plugin,
            "the bridges of Breadcrumbs are switched off: pass breadcrumbs:=1 in the command that "
            "starts them",
            related=[(off, "the bridge that is switched off")],
        )


def _missing_counts(bridges: Iterable[Bridge], *, carried: bool) -> Iterator[Finding]:
    """Report launch files that drop breadcrumbs without a bridge for the number that remains.

    Where the robot carries none, only another configuration can miss the number.
    """
    known = list(bridges)
    counting = {bridge.ign_topic.removesuffix(REMAINING) for bridge in known if _counts(bridge)}
    for bridge in known:
        if _drops(bridge) and bridge.ign_topic.removesuffix(DEPLOY) not in counting:
            yield finding(
                bridge,
                "breadcrumb/deploy is bridged, but breadcrumb/deploy/remaining is not: bridge "
                "both, so that teams can read how many are left",
                severity=Severity.WARNING if carried else Severity.INFO,
                key="remaining is not bridged",
            )


def _drops(bridge: Bridge) -> bool:
    return bridge.ign_topic.endswith(DEPLOY) and _WORD in bridge.ign_topic


def _counts(bridge: Bridge) -> bool:
    return bridge.ign_topic.endswith(REMAINING) and _WORD in bridge.ign_topic


_TOPICS = "launch/vehicle_topics.launch"
_MARK = " <!-- ^ BRD003 -->"


def _plugin(mark: str = "") -> str:
    return f"""
<plugin filename="libignition-gazebo-breadcrumbs-system.so" name="ignition::Breadcrumbs">{mark}
  <topic>/model/r/breadcrumb/deploy</topic>
</plugin>
"""


def _launch(condition: str, mark: str = "", remaining: bool = True) -> str:
    topic = "/model/r/breadcrumb/deploy"
    counted = f"""
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="left" {condition}
        args="{topic}/remaining@std_msgs/Int32[ignition.msgs.Int32"/>"""
    return f"""<launch>
  <arg name="name"/>
  <arg name="world_name"/>
  <arg name="breadcrumbs" default="0"/>
  <node pkg="ros_ign_bridge" type="parameter_bridge" name="drop" {condition}
        args="{topic}@std_msgs/Empty]ignition.msgs.Empty"/>{mark}{counted if remaining else ""}
</launch>
"""


_IF = 'if="$(arg breadcrumbs)"'
_INCLUDE = """<launch>
  <include file="$(find subt_ros)/launch/models_common/breadcrumbs.launch"/>
</launch>
"""

GOOD = [
    {"@fragment": _plugin(), _TOPICS: _launch("")},
    {"@fragment": _plugin(), _TOPICS: _INCLUDE},
    {_TOPICS: _launch(_IF)},
]
BAD = [
    {"@fragment": _plugin(_MARK)},
    {"@fragment": _plugin(_MARK), _TOPICS: _launch(_IF)},
    {"@fragment": _plugin(), _TOPICS: _launch("", _MARK, remaining=False)},
    {_TOPICS: _launch(_IF, _MARK, remaining=False)},
]
