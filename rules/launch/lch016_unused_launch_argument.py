"""A launch argument that is declared, but never used.

`ros2 launch --show-args` lists it, but its value has no effect. Often the value was meant for a
node, or for an included file that uses another name. Files that are not read, and files that
include such files, are not checked, because they may use it. The arguments of the usual launch
files of nav2_bringup, slam_toolbox, ros_gz_sim and ros_gz_bridge are known.

Fix: use it with `LaunchConfiguration`, in XML `$(var …)`; or remove the declaration.
Source: launch, `DeclareLaunchArgument`: it sets a launch configuration and nothing else.
"""

from checker.base.words import Suggestions
from checker.launch.ros2.graph import Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH016", "unused-launch-argument", Severity.INFO, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report arguments that no file of a launch uses; a near name that is used is a warning."""
    for graph in launch.entries:
        unread = graph.unread or any(include.is_unknown for include in graph.includes)
        if unread or graph.faults:
            continue
        declared = {argument.name for argument in graph.arguments}
        others = Suggestions(sorted(graph.used - declared))
        for argument in graph.arguments:
            if argument.name not in graph.used:
                near = others.closest(argument.name)
                yield finding(
                    argument,
                    f"argument {argument.name!r} is declared, but never used in this launch"
                    f"{others.hint(argument.name)}",
                    severity=Severity.WARNING if near else None,
                    key=argument.name,
                )


_USE = """        Node(package='rviz2', executable='rviz2',
             arguments=['-d', LaunchConfiguration('view')]),"""
_DECLARED = "        DeclareLaunchArgument('view', default_value='a.rviz'),"
_PREFIX = """        Node(package='rviz2', executable='rviz2',
             prefix=[LaunchConfiguration('view'), ' ']),"""
_ON_EXIT = """        Node(package='rviz2', executable='rviz2',
             on_exit=[ExecuteProcess(cmd=['echo'], cwd=LaunchConfiguration('view'))]),"""
_INCLUDE = """        IncludeLaunchDescription(PythonLaunchDescriptionSource(
            [FindPackageShare('acme_cells'), '/launch/x.launch.py'])),"""

_NAV2 = """<launch>
  <arg name="@" default="hall.yaml"/>%
  <include file="$(find-pkg-share nav2_bringup)/launch/localization_launch.py"/>
</launch>
"""

GOOD = [
    {
        "@ros2": True,
        "launch/world.launch.xml": '<launch><arg name="own" default="False"/>'
        '<gz_server world_sdf_file="empty.sdf" create_own_container="$(var own)"/></launch>',
    },
    {"@ros2": True, "launch/nav.launch.xml": _NAV2.replace("@", "map").replace("%", "")},
    {"@ros2": f"{_DECLARED}\n{_USE}"},
    {"@ros2": f"{_DECLARED}\n{_PREFIX}"},
    {"@ros2": f"{_DECLARED}\n{_ON_EXIT}"},
    {"@ros2": f"{_DECLARED}\n{_INCLUDE}"},
    {
        "@ros2": True,
        "launch/view.launch.xml": '<launch><arg name="to" default="screen"/>'
        '<node pkg="rviz2" exec="rviz2" output="$(var to)"/></launch>',
    },
    {
        "@ros2": True,
        "launch/view.launch.xml": '<launch><arg name="gui"/>'
        '<node pkg="rviz2" exec="rviz2" if="$(var gui)"/></launch>',
        "launch/all.launch.xml": '<launch><arg name="gui" default="1"/>'
        '<include file="$(find-pkg-share acme_arm_bringup)/launch/view.launch.xml"/></launch>',
    },
]
BAD = [
    {
        "@ros2": True,
        "launch/nav.launch.xml": _NAV2.replace("@", "world").replace("%", "  <!-- ^ LCH016 -->"),
    },
    {"@ros2": f"{_DECLARED}  # ^ LCH016"},
    {
        "@ros2": True,
        "launch/all.launch.xml": '<launch><arg name="rviz" default="1"/>  <!-- ^ LCH016 -->\n'
        '<node pkg="rviz2" exec="rviz2"/></launch>',
    },
]
