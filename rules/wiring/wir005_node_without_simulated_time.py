"""A node uses the system clock in a launch with simulated time.

Its time is decades ahead of the time stamps of Gazebo's messages: a filter drops the measurements
as too old, lookups of transforms fail ("extrapolation into the past"), and navigation waits. With
`use_sim_time` a node takes its time from /clock. A block of a parameter file sets it for one node
only.

It is reported for nodes of localisation, mapping and navigation where all parameters of the node
were read, and the launch file starts Gazebo whose /clock comes to ROS; or where it starts another
such node or a robot_state_publisher with `use_sim_time`: the stamps of one are then decades away
from the other's. So it is where the argument `use_sim_time` of a launch file, false by default, is
given to one of them and not to another, if a README starts the launch file with that argument true.
A parameter that `SetParameter` sets for all nodes comes first on their command lines. rcl then
reads the parameters of the launch file into the same block, and a block of a parameter file that
names the node counts more: where it says true against the launch file's false, it is reported.

Fix: state `use_sim_time: true` for the node, or `SetParameter` for all that follow it.
Source: ROS 2 design, "Clock and Time"; robot_localization, slam_toolbox and navigation2.
"""

import posixpath
from itertools import chain

from checker.launch.ros2.graph import NodeKind, Parameter
from checker.package.files_above import README, files_around
from checker.package.package import Package
from checker.ros.transforms import STATE_PUBLISHER
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_PARAMETER = "use_sim_time"
_COMMAND = "use_sim_time:=true"
_CLOCK = "rosgraph_msgs/msg/Clock"
_PACKAGES = (
    *("robot_localization", "slam_toolbox", "nav2_amcl", "nav2_controller", "nav2_planner"),
    *("nav2_behaviors", "nav2_bt_navigator", "nav2_collision_monitor"),
)
"""Their nodes compare their own time with the stamps of messages and transforms."""


@rule("WIR005", "node-without-simulated-time", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, package: Package) -> Findings:
    """Report nodes that do not take their time from Gazebo, though it is there."""
    nodes = (it for it in wiring.nodes if it.node.kind is not NodeKind.INCLUDED)
    timed = [it for it in nodes if it.knows_parameters and _compares_time(it)]
    simulated = [node for node in timed if _text(node) == "true"]
    reason = "this launch starts Gazebo, whose messages have the time of /clock"
    if not _has_clock(wiring):
        against = [node for node in simulated if _is_overruled(node)]
        yield from map(_against_launch, against)
        simulated = [node for node in simulated if node not in against]
        elsewhere = simulated and (wiring.simulation is None or not wiring.simulation.servers)
        reason = f"{simulated[0].label} of this launch uses /clock" if elsewhere else ""
    given, expected = [node for node in timed if _is_given(node)], "true"
    if given and not simulated and not reason and _is_started_with_it(package, wiring):
        reason = f"use_sim_time:=true reaches {given[0].label} and not this node"
        expected = "the value of the argument"
        timed = [it for it in timed if it not in given and not it.node.conditions]
    for node in timed if reason else ():
        setting = node.settings.get(_PARAMETER)
        is_affected = node.node.package.value != STATE_PUBLISHER
        if is_affected and _text(node) == "false":
            stated = "no use_sim_time" if setting is None else "use_sim_time: false"
            yield finding(
                node.node.span if setting is None else setting.span,
                f"{node.label} has {stated}, expected {expected}: {reason}",
                key=node.full_name,
                related=[
                    (it.settings[_PARAMETER].span, it.label) for it in (simulated or given)[:1]
                ],
            )


def _is_overruled(node: WiredNode) -> bool:
    """Return whether the launch file gives a node `false`, which a parameter file replaces."""
    given, setting = node.node.parameter(_PARAMETER), node.settings.get(_PARAMETER)
    if given is None or setting is None or setting.span is given.span:
        return False
    return str(given.value).lower() == "false"


def _against_launch(node: WiredNode) -> Finding:
    """Return a finding of a node that gets `true` of its file, against the launch file."""
    setting, given = node.settings[_PARAMETER], node.node.parameter(_PARAMETER)
    first = next(it for it in node.node.parameters if isinstance(it, Parameter))
    places = [(given.span, "the launch file gives it false")] if given is not None else []
    return finding(
        setting.span,
        f"{node.label} has use_sim_time: true, though the launch file gives it false: "
        f"{first.name}, a parameter of all nodes, stands before this file and lets the file count: "
        "remove the line",
        key=node.full_name,
        related=[*places, (first.span, f"{first.name} is set for all nodes")],
    )


def _compares_time(node: WiredNode) -> bool:
    """Return whether a node compares its time with that of messages, or stamps transforms."""
    return node.node.package.value in (*_PACKAGES, STATE_PUBLISHER)


def _is_started_with_it(package: Package, wiring: Wiring) -> bool:
    """Return whether a README of the package, or above it, gives the argument the value true."""
    name = posixpath.basename(wiring.graph.file)
    texts = (source.text for source in files_around(package, README))
    lines = chain.from_iterable(map(str.splitlines, texts))
    return any(name in line and _COMMAND in line.lower() for line in lines)


def _is_given(node: WiredNode) -> bool:
    """Return whether an argument of the launch file gives a node its value, false by default."""
    parameter = node.node.parameter(_PARAMETER)
    return parameter is not None and parameter.substituted and _text(node) == "false"


def _text(node: WiredNode) -> str | None:
    setting = node.settings.get(_PARAMETER)
    text = "false" if setting is None else setting.text
    return text and text.lower()


def _has_clock(wiring: Wiring) -> bool:
    """Return whether the launch certainly starts Gazebo, and its time reaches ROS."""
    if wiring.in_classic:
        return True
    simulation = wiring.simulation
    return (
        simulation is not None
        and simulation.starts_gazebo
        and any(
            entry.counts and entry.ros_topic == "/clock" and entry.passed.ros_type.value == _CLOCK
            for entry in simulation.entries
        )
    )


_HEAD = "LaunchDescription([\n"
_EKF = """LaunchDescription([
        Node(package="{}", executable="ekf_node",{}
             parameters=[os.path.join(HERE, "config", "ekf.yaml"){}]),
"""
_MARK = "  # ^ WIR005"


def _filter(
    key: str, more: str = "", mark: str = "", package: str = "robot_localization"
) -> dict[str, object]:
    launch = _EKF.format(package, mark, more)
    return {
        "@bridge": True,
        "@launch": {_HEAD: launch},
        "config/ekf.yaml": f"{key}:\n  ros__parameters: {{use_sim_time: true}}\n",
    }


_PAIR = """<launch>
  <arg name="sim" default="false"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" value="" type="str"/>
    <param name="use_sim_time" value="@"/>
  </node>
  <node pkg="robot_localization" exec="ekf_node"/>%
</launch>
"""


def _pair(simulated: str, mark: str = "") -> dict[str, object]:
    """Return a launch file without Gazebo: of the state and a filter."""
    launch = _PAIR.replace("@", simulated).replace("%", mark)
    return {"@bridge": True, "launch/rover.launch.py": None, "launch/state.launch.xml": launch}


_IMPORTS = "from launch_ros.actions import Node\n"
_MORE = """from launch_ros.actions import LoadComposableNodes, Node, SetParameter
from launch_ros.descriptions import ComposableNode
"""
_GLOBAL = """LaunchDescription([
        SetParameter("some_level", 1),
        Node(package="robot_localization", executable="ekf_node", name="ekf_filter_node",
             parameters=[os.path.join(HERE, "config", "ekf.yaml"), {"use_sim_time": False}]),
        Node(package="nav2_amcl", executable="amcl", parameters=[{"use_sim_time": False}]),
"""


def _overruled(*replaced: tuple[str, str]) -> dict[str, object]:
    """Return a launch without a clock whose file says other than the launch file."""
    launch = {_HEAD: _GLOBAL, _IMPORTS: _MORE}
    yaml = "ekf_filter_node:\n  ros__parameters:\n    use_sim_time: true  # ^ WIR005\n"
    for old, new in replaced:
        launch, yaml = {k: v.replace(old, new) for k, v in launch.items()}, yaml.replace(old, new)
    return {"@bridge": "[]\n", "@launch": launch, "config/ekf.yaml": yaml}


_README = "ros2 launch acme_rover_bringup state.launch.xml sim:=true use_sim_time:=true\n"


_CONTAINER = """LaunchDescription([
        SetParameter("use_sim_time", @),%
        LoadComposableNodes(target_container="nav", composable_node_descriptions=[
            ComposableNode(package="nav2_amcl", plugin="nav2_amcl::AmclNode", name="amcl")]),
"""


def _component(simulated: str, mark: str = "") -> dict[str, object]:
    launch = _CONTAINER.replace("@", simulated).replace("%", mark)
    return {"@bridge": True, "@launch": {_HEAD: launch, _IMPORTS: _MORE}}


GOOD = [
    # The parameters of the launch file come after the file, and count.
    _overruled(('        SetParameter("some_level", 1),\n', ""), ("  # ^ WIR005", "")),
    _component('"True"'),
    _component("True"),
    _pair("false"),
    _pair("$(var sim)"),
    _filter("ekf_filter_node"),
    _filter("/**"),
    _filter("other", ', {"use_sim_time": True}'),
    _filter("other", package="acme_filter"),
    {**_filter("other"), "@bridge": "[]\n"},
]
BAD = [
    _overruled(),
    _component('"False"', _MARK),
    _component("False", _MARK),
    {
        **_filter("other"),
        "@launch": {
            _HEAD: _EKF.format("robot_localization", _MARK, ""),
            '[("gz_args", "-r empty.sdf")]),': '[("gz_args", "-g")]),',
        },
    },
    _pair("true", "  <!-- ^ WIR005 -->"),
    {**_pair("$(var sim)", "  <!-- ^ WIR005 -->"), "README.md": _README},
    _filter("other", mark=_MARK),
    _filter("ekf_filter_node", ', {"use_sim_time": False}]),  # ^ WIR005\n#'),
]
