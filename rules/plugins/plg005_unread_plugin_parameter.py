"""A plugin parameter that its plugin never reads.

The parameter has no effect, and Gazebo prints no message. For example, `<odometry_topic>` leaves a
differential drive at its default topic, because the drive reads `<odom_topic>`. The plugin for the
slip of wheels reads elements below `<wheel>`, of its attributes `link_name` alone.

Fix: write the parameter as the plugin reads it, or remove it.
Source: parameters that the source code of each system reads (`gazebo_plugins.json`);
`static_pose_publisher` for `static_publisher` in SubT packages. Harmless parameters that come from
templates are infos, and so is the name of a topic in Gazebo Classic that the plugin uses anyway.
"""

from collections.abc import Collection, Iterator

from checker.base.resources import table
from checker.base.words import Suggestions, and_list
from checker.model.components import Plugin
from checker.model.plugin_library import PluginLibrary, library_stem, plugin_libraries
from checker.model.robot import Robot
from checker.ros.wiring.classic import classic_endpoints
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.xml import Element

_FREE = ("include", "sdf")
"""Elements that contain SDF, not parameters."""

_HARMLESS = (
    "name",
    "start_on_motion",
    "tracks_height",
    "motorSpeedPubTopic",
    "motorControlPubTopic",
    "robot_sim_type",
)

_MEANT = {
    "max_linear_acceleration": "max_acceleration",
    "max_linear_jerk": "max_jerk",
    "max_linear_velocity": "max_velocity",
    "min_linear_acceleration": "min_acceleration",
    "min_linear_jerk": "min_jerk",
    "min_linear_velocity": "min_velocity",
    "odometry_rate": "publish_rate",
    "odometry_topic": "odom_topic",
    "remap": "remapping",
    "static_pose_publisher": "static_publisher",
    "static_pose_update_frequency": "static_update_frequency",
}
"""Names in real packages that differ too much from the right one to be found by spelling, or are
nearer to another one."""


@rule("PLG005", "unread-plugin-parameter", Severity.WARNING, Concern.INTERFACE)
def check(robot: Robot, context: Context, *, harmless: tuple[str, ...] = _HARMLESS) -> Findings:
    """Report elements in plugins of the release that the plugin's source never reads.

    Options:
        harmless: Names of elements that are infos instead of a warning if a plugin does not read
            them.
    """
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    libraries = plugin_libraries(context.release)
    for plugin in robot.all_plugins:
        stem = library_stem(plugin.filename.value)
        library = libraries.get(stem)
        if library is None or library.parameters is None:
            continue
        if _SLIPS in library.parameters:
            yield from _attributes_of_wheels(plugin)
        suggestions = Suggestions(sorted(library.parameters))
        of_ros_1 = _of_ros_1(stem) if context.is_classic else frozenset()
        # PLG012 reports those of ROS 1.
        unread = [it for it in _unread(plugin.element, library) if it.tag not in of_ros_1]
        used = _used_topics(robot, plugin) if unread and context.is_classic else ()
        for of_no_harm in (False, True):
            elements = [
                it for it in unread if (it.tag in harmless or _names(it, used)) is of_no_harm
            ]
            names = dict.fromkeys(it.tag for it in elements)
            hinted = [_hinted(name, library.parameters, suggestions) for name in names]
            message = f"{plugin.label} does not read {and_list(hinted)}"
            severity = Severity.INFO if of_no_harm else None
            yield from (finding(element, message, severity=severity) for element in elements)


_SLIPS = "slip_compliance_lateral"
_OF_WHEEL = {"lateral": _SLIPS, "longitudinal": "slip_compliance_longitudinal"}


def _attributes_of_wheels(plugin: Plugin) -> Iterator[Finding]:
    """Yield values that are written as attributes of a wheel, where elements are read."""
    for wheel in plugin.element.all("wheel"):
        for name in wheel.attributes:
            tag = next((tag for way, tag in _OF_WHEEL.items() if way in name), "")
            text = wheel.attribute(name)
            if tag and text is not None:
                yield finding(
                    text,
                    f"{plugin.label} does not read the attribute {name} of <wheel>, so the wheel "
                    f"does not slip: write <{tag}>{text.value}</{tag}> below <wheel>",
                    key=f"{plugin.label} {name}",
                )


def _used_topics(robot: Robot, plugin: Plugin) -> Collection[str]:
    """Return the topics that a plugin of Classic uses, by default or by its `<remapping>`."""
    return [each.topic for each in classic_endpoints(robot) if each.owner is plugin]


def _names(element: Element, topics: Collection[str]) -> bool:
    """Return whether an element names one of these topics, in full or by the end of its name."""
    name = element.text.value.strip()
    is_topic = "topic" in element.tag.lower() and name != ""
    return is_topic and any(it == name or it.endswith(f"/{name}") for it in topics)


def _hinted(name: str, known: Collection[str], suggestions: Suggestions) -> str:
    """Return an element, with the parameter that is meant."""
    meant = _MEANT.get(name) or suggestions.closest(name)
    return f"<{name}> (did you mean <{meant}>?)" if meant in known else f"<{name}>"


def _of_ros_1(stem: str) -> frozenset[str]:
    names = table("gazebo_classic_ros2")["ros_1"]
    return frozenset({*names["common"], *names["libraries"].get(stem, {}).get("params", ())})


def _unread(plugin: Element, library: PluginLibrary) -> Iterator[Element]:
    """Yield the elements of a plugin that are not parameters, without their content."""
    waiting = list(reversed(plugin.children))
    while waiting:
        element = waiting.pop()
        if element.tag in _FREE or ":" in element.tag:
            continue
        if library.reads(element.tag):
            waiting.extend(reversed(element.children))
        else:
            yield element


def _drive(parameter: str) -> str:
    return f"""
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive">
  {parameter}
</plugin>
"""


def _classic(parameters: str) -> dict[str, str]:
    text = f'<plugin filename="libgazebo_ros_diff_drive.so" name="drive">{parameters}</plugin>'
    return {"@profile": "gazebo-classic", "@fragment": text}


def _slip(wheel: str) -> dict[str, str]:
    text = f'<plugin filename="libgazebo_ros_wheel_slip.so" name="slip">\n{wheel}\n</plugin>'
    return {"@fragment": text, "@profile": "gazebo-classic"}


GOOD = [
    _slip(
        '<wheel link_name="left"><slip_compliance_lateral>0.01</slip_compliance_lateral></wheel>'
    ),
    _classic("<ros><remapping>odom:=wheel/odom</remapping></ros><left_joint>l</left_joint>"),
    _drive("<odom_topic>odometry</odom_topic>"),
    """
<plugin filename="libignition-gazebo-breadcrumbs-system.so"
        name="ignition::gazebo::systems::Breadcrumbs">
  <breadcrumb><sdf version="1.6"><model name="crumb"/></sdf></breadcrumb>
</plugin>
""",
    {
        "@fragment": """
<plugin filename="gz-sim-hydrodynamics-system" name="gz::sim::systems::Hydrodynamics">
  <link_name>base_link</link_name><xDotU>-4.9</xDotU><yVabsV>-1100</yVabsV><zW>0</zW>
</plugin>
""",
        "@profile": "gazebo-harmonic",
    },
    '<plugin filename="libOfSomebody.so" name="somebody::Else"><any>1</any></plugin>',
]
BAD = [
    _slip('<wheel link_name="left" lateral_slip_compliance="0.01"/>  <!-- ^ PLG005 -->'),
    _drive("<odometry_topic>odometry</odometry_topic>  <!-- ^ PLG005 -->"),
    """
<plugin filename="ignition-gazebo-tracked-vehicle-system"
        name="ignition::gazebo::systems::TrackedVehicle">
  <left_track>
    <link>left</link>
    <lnk>left_2</lnk>  <!-- ^ PLG005 -->
  </left_track>
  <tracks_height>0.2</tracks_height>  <!-- ^ PLG005 -->
</plugin>
""",
    _classic("<wheel_radius>0.1</wheel_radius>  <!-- ^ PLG005 -->"),
    # Info: the plugin uses this topic anyway.
    _classic("<command_topic>cmd_vel</command_topic>  <!-- ^ PLG005 -->"),
    # The remapping counts.
    _classic(
        "<ros><remapping>cmd_vel:=wheel/cmd</remapping></ros>"
        "<command_topic>cmd_vel</command_topic>  <!-- ^ PLG005 -->"
    ),
]
