"""A controller manager beside that of Gazebo.

The plugin of gz_ros2_control, ign_ros2_control or gazebo_ros2_control runs a controller manager in
Gazebo. A `ros2_control_node` of the same launch is a second node of that name: it cannot load the
hardware of Gazebo, which exists in Gazebo alone, and which of both answers a spawner is chance.

A plugin that the started Gazebo cannot load runs none: one of Gazebo Classic in Gazebo Sim, or the
other way round (PLG001, PLG002). It is reported where both start with the defaults of all
arguments, or with another value of one argument that has `true` or `false` as its default, or a
list of choices.

Fix: remove `ros2_control_node`, or start it under the condition that Gazebo is not started.
Source: gz_ros2_control, issue 83; ros2_control, issue 1143.
"""

from collections.abc import Iterator
from itertools import islice

from msgspec.structs import replace

from checker.launch.ros1.graph import resolve_name
from checker.launch.ros2.graph import LaunchGraph, Node, is_known
from checker.launch.ros2.reader import read_launch
from checker.model.ros_parameters import MANAGER
from checker.package.package import Package
from checker.ros.ros2_control.launched import MANAGER_NODE, LaunchedControl
from checker.ros.ros2_control.robot_control import GazeboManager
from checker.ros.spawned import CLASSIC_SPAWNS, EVERY_SPAWN
from checker.rule import Concern, Findings, Severity, finding, rule

_MOST = 8
"""Launches with another value of an argument that are tried."""
_SWITCH = {"true": "false", "false": "true"}
_OF_CLASSIC = ("gazebo_ros2_control",)
_OF_LATER = ("gz_ros2_control", "ign_ros2_control")
_MOVES = "-robot_namespace"
"""An option of spawn_entity.py that gives the plugins another namespace."""


@rule("WIR022", "second-controller-manager", Severity.WARNING, Concern.INTERFACE)
def check(launched: LaunchedControl, package: Package) -> Findings:
    """Report each ros2_control_node with the full name of a controller manager in Gazebo."""
    found = {it.program for it in launched.graph.nodes_and_spawns}
    if (MANAGER, MANAGER_NODE) not in found or found.isdisjoint(EVERY_SPAWN):
        return
    for given, graph in _launches(launched.graph, package):
        pairs = [*_pairs(replace(launched, graph=graph))]
        for node, manager, spawn in pairs:
            yield finding(
                node.executable,
                f"remove the ros2_control_node: Gazebo starts the controller manager "
                f"{_full_name(manager)} {given}".rstrip(),
                key=_full_name(manager),
                related=[
                    (manager.span, "this plugin runs a controller manager"),
                    (spawn.executable, "this puts the robot with the plugin into Gazebo"),
                ],
            )
        if pairs:
            return


def _launches(graph: LaunchGraph, package: Package) -> Iterator[tuple[str, LaunchGraph]]:
    """Yield the launch with its defaults, then those with another value of one argument."""
    yield "", graph
    for name, value in islice(_other_values(graph), _MOST):
        given = f"{name}:={value}"
        yield f"with {given}", read_launch(package, graph.file, {name: value})


def _other_values(graph: LaunchGraph) -> Iterator[tuple[str, str]]:
    for argument in graph.arguments:
        default = argument.default.value if argument.default is not None else ""
        switched = _SWITCH.get(default.lower())
        choices = argument.choices or ([switched] if switched else [])
        yield from ((argument.name, value) for value in choices if value.lower() != default.lower())


def _pairs(launched: LaunchedControl) -> Iterator[tuple[Node, GazeboManager, Node]]:
    """Yield nodes and plugins that run a controller manager of one name, and what spawns these."""
    robots, _ = launched.spawned.robots(launched.graph, EVERY_SPAWN)
    for spawned in robots:
        moved = any(word.value == _MOVES for word in spawned.node.arguments)
        if not spawned.node.starts or moved:
            continue
        managers = launched.reader.plugin_files(spawned.robot).managers
        for manager in (it for it in managers if _loads(spawned.node, it)):
            for node in launched.managers:
                own = node.name.value if node.name is not None else MANAGER
                name = resolve_name(own, node.namespace)
                if is_known(name) and name == _full_name(manager):
                    yield node, manager, spawned.node


def _loads(spawn: Node, manager: GazeboManager) -> bool:
    """Return whether the Gazebo in which a node spawns loads a plugin: Classic only its own."""
    in_classic = (spawn.package.value, spawn.executable.value) in CLASSIC_SPAWNS
    return not manager.library.startswith(_OF_LATER if in_classic else _OF_CLASSIC)


def _full_name(manager: GazeboManager) -> str:
    return resolve_name(manager.node, manager.namespace.value)


_PLUGIN = """<gazebo>
  <plugin filename="{}" name="control"><ros><namespace>{}</namespace></ros></plugin>
</gazebo>
"""
_LAUNCH = """<launch>
  <arg name="sim" default="%"/>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf
        sim:=$(var sim)')"/>
  </node>
  <node pkg="{}" exec="{}" args="-topic robot_description" if="$(var sim)"/>
  <node pkg="controller_manager" exec="ros2_control_node"@
</launch>
"""


def _rover(
    spawn: str = "ros_gz_sim create",
    more: str = "/>",
    library: str = "gz_ros2_control-system",
    namespace: str = "",
    sim: str = "true",
) -> dict[str, object]:
    launch = _LAUNCH.format(*spawn.split()).replace("@", more).replace("%", sim)
    plugin = _PLUGIN.format(library, namespace)
    return {
        "@bridge": True,
        "launch/rover.launch.py": None,
        "launch/rover.launch.xml": launch,
        "urdf/rover.urdf": f"""<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:arg name="sim" default="false"/>
<link name="base_link"/>
<xacro:if value="$(arg sim)">{plugin}</xacro:if>
</robot>
""",
    }


_MARK = "/>  <!-- ^ WIR022 -->"
_SPAWN_OF_CLASSIC, _OF_CONTROL = "gazebo_ros spawn_entity.py", "libgazebo_ros2_control.so"
GOOD = [
    _rover(more=' unless="$(var sim)"/>'),
    _rover(namespace="rover"),
    _rover(library="gz-sim-diff-drive-system"),
    _rover(library=_OF_CONTROL),
    _rover(spawn=_SPAWN_OF_CLASSIC),
]
BAD = [
    _rover(more=_MARK),
    _rover(more=_MARK, sim="false"),
    _rover(more=f' namespace="rover"{_MARK}', namespace="rover"),
    _rover(more=_MARK, spawn=_SPAWN_OF_CLASSIC, library=_OF_CONTROL),
]
