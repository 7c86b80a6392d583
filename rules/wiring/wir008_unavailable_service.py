"""A node waits for a service or action that nothing in the launch offers.

The startup stops there: a lifecycle manager requests the state of each of its `node_names` and
waits for the answer, so a name without a node blocks all others; `bt_navigator` does not become
active without the servers of its behaviour tree, and a spawner of controllers waits for the
controller manager of its own namespace. slam_toolbox has a lifecycle node only since Jazzy, and a
node of the list that a condition leaves out by default blocks the others too. A namespace on only
one of two nodes, or a `name` in the launch file, makes the names differ as well.

It is reported where all nodes of the launch file are known, and no other launch file of the package
starts a node that offers it. Custom behaviour trees may need other servers, and are not checked;
nor are launch files with a `LaunchTestService`, which starts the program under test.

Fix: start the node that is missing, or correct its name or namespace.
Source: navigation2, nav2_lifecycle_manager and nav2_bt_navigator; slam_toolbox, branches humble and
ros2; ROS 2 design, "Managed nodes".
"""

from collections.abc import Iterator

from checker.base.words import and_list
from checker.launch.ros2.graph import LaunchGraph, Node, Ros2Launch
from checker.package.package import Package
from checker.ros.ros2_control.distributions import ORDER, is_from, named_distribution
from checker.ros.wiring.facts import NodeFacts, node_facts, program_of
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.services import STATE, Wanted, offered_services, wanted_services
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText

_TESTS = "LaunchTestService("
"""Part of launch files that start programs of tests besides what they describe."""
_NO_STATES = (
    "it is no lifecycle node in this distribution, and has no get_state; remove it from the list"
)
_LEFT_OUT = "a condition leaves it out by default; give both the same condition"


@rule("WIR008", "unavailable-service", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, launch: Ros2Launch, package: Package, context: Context) -> Findings:
    """Report services and actions that known nodes wait for, and that no node offers."""
    source = package.read(wiring.graph.file)
    if isinstance(source, SourceText) and _TESTS in source.text:
        return
    yield from _lost_spawners(wiring)
    there = {name for node in wiring.every_node for name in offered_services(node)}
    lacking = {**_left_out(wiring), **_without_states(wiring, _distribution(package, context))}
    others = [graph for graph in launch.entries if graph is not wiring.graph]
    for node in wiring.nodes:
        for each in wanted_services(node):
            cause = lacking.get(each.name) if each.item else None
            if cause is None and each.name in there:
                continue
            is_plain = cause is not None and cause.node.starts is not False
            if not is_plain and any(_may_offer(graph, each) for graph in others):
                continue
            if not is_plain and (unknown := _unknown_cause(wiring)):
                yield unchecked(f"the nodes that offer {each.name} are not all known: {unknown}")
                continue
            what = f"node {each.item!r}" if each.item else each.name
            why = f"nothing in this launch offers {each.name}"
            if cause is not None:
                why = _NO_STATES if is_plain else _LEFT_OUT
            yield finding(
                each.span,
                f"{node.label} waits for {what}: {why}",
                key=f"{node.label} {each.name}",
                related=[(cause.node.executable, "this node")] if cause is not None else [],
            )


def _distribution(package: Package, context: Context) -> str:
    """Return the distribution that the user or the package names; empty if that is not known."""
    named = named_distribution(package, context)
    return named if named in ORDER else ""


def _left_out(wiring: Wiring) -> dict[str, WiredNode]:
    """Return services of lifecycle nodes that conditions leave out by default."""
    started = {node.full_name for node in wiring.every_node if node.node.starts is not False}
    return {
        f"{node.full_name}/{STATE}": node
        for node in wiring.every_node
        if node.full_name and node.full_name not in started
    }


def _without_states(wiring: Wiring, distribution: str) -> dict[str, WiredNode]:
    """Return the services that nodes offer only in later distributions, with the nodes."""
    return {
        f"{node.full_name}/{STATE}": node
        for node in wiring.nodes
        if distribution and node.full_name and node.facts is not None
        if (first := node.facts.lifecycle_from) and not is_from(distribution, first)
    }


def _lost_spawners(wiring: Wiring) -> Iterator[Finding]:
    """Yield spawners that ask a controller manager in a namespace in which none runs."""
    managers = wiring.managers
    for spawner in filter(None, (node.spawner for node in wiring.nodes)):
        if managers and spawner.manager and spawner.manager not in managers:
            yield finding(
                spawner.node,
                f"spawner waits for {spawner.manager}, which nothing in this launch starts: the "
                f"controller manager is {and_list([*managers])}; give both the same namespace",
                key=spawner.manager,
                related=[(span, f"this runs {name}") for name, span in managers.items()],
            )


def _may_offer(graph: LaunchGraph, each: Wanted) -> bool:
    """Return whether another launch file, in any namespace, starts the service."""
    short = each.item or each.name.rpartition("/")[2]
    included = (node for include in graph.includes for node in include.nodes)
    return any(short in _names(node) for node in (*graph.nodes, *included))


def _names(node: Node) -> tuple[str, ...]:
    facts = node_facts().get(program_of(node), NodeFacts())
    name = node.name.value if node.name is not None else facts.name
    return (name, node.executable.value, *facts.offers)


def _unknown_cause(wiring: Wiring) -> str:
    """Return the reason why there may be more nodes and services than those known; else nothing."""
    strange = (node for node in wiring.every_node if node.facts is None or not node.full_name)
    reasons = (f"what {node.program} offers is not known" for node in strange)
    return next(iter((*wiring.unread, *reasons)), "")


_LAUNCH = """<launch>
  <node pkg="nav2_map_server" exec="map_server" name="map_server"/>
  <node pkg="nav2_amcl" exec="amcl" name="amcl"@/>
  <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
    <param from="$(find-pkg-share acme_rover_bringup)/config/nav2.yaml"/>
  </node>
</launch>
"""
_TREE = """<launch>
  <node pkg="nav2_planner" exec="planner_server"/>
  <node pkg="nav2_controller" exec="controller_server"@/>
  <node pkg="nav2_bt_navigator" exec="bt_navigator">%
    <param name="odom_topic" value="/odom"/>
  </node>
</launch>
"""
_MARK = "  # ^ WIR008"
_ELSEWHERE = '<launch><node pkg="nav2_controller" exec="controller_server"/></launch>'


def _manager_example(names: str, more: str = "") -> dict[str, object]:
    """Return a lifecycle manager of two nodes."""
    return {
        "@bridge": True,
        "launch/nav.launch.xml": _LAUNCH.replace("@", more),
        "config/nav2.yaml": f"manager:\n  ros__parameters:\n    node_names: {names}\n",
    }


def _tree(controller: str, mark: str = "") -> dict[str, object]:
    """Return a navigator with the servers of its behaviour tree."""
    launch = _TREE.replace("@", controller).replace("%", mark)
    return {"@bridge": True, "launch/nav.launch.xml": launch}


_CONTROL = """<launch>
  <node pkg="controller_manager" exec="ros2_control_node" namespace="left"/>
  <node pkg="controller_manager" exec="spawner"@/>%
</launch>
"""


def _spawner(more: str, mark: str = "") -> dict[str, object]:
    """Return a spawner, and a controller manager in a namespace."""
    launch = _CONTROL.replace("@", more).replace("%", mark)
    return {"@bridge": True, "launch/control.launch.xml": launch}


_WITHOUT = ' if="false"'
_SLAM = """<launch>
  <arg name="saves" default="false"/>
  <node pkg="slam_toolbox" exec="async_slam_toolbox_node" name="slam_toolbox"/>
  <node pkg="nav2_map_server" exec="map_saver_server" name="map_saver" if="$(var saves)"/>
  <node pkg="nav2_lifecycle_manager" exec="lifecycle_manager" name="manager">
    <param from="$(find-pkg-share acme_rover_bringup)/config/nav2.yaml"/>
  </node>
</launch>
"""


def _slam(distribution: str, names: str) -> dict[str, object]:
    """Return a lifecycle manager beside slam_toolbox, and a node that is off by default."""
    return {
        **_manager_example(names),
        "README.md": f"A rover for ROS 2 {distribution}.\n",
        "launch/nav.launch.xml": _SLAM,
    }


_TEST = """from launch import LaunchDescription, LaunchService
from launch.actions import ExecuteProcess
from launch_ros.actions import Node
from launch_testing.legacy import LaunchTestService


def generate_launch_description():
    return LaunchDescription([
        Node(package="nav2_lifecycle_manager", executable="lifecycle_manager", name="manager",
             parameters=[{"node_names": ["fake_server"]}]),
    ])


if __name__ == "__main__":
    service, test = LaunchService(), LaunchTestService()
    description = generate_launch_description()
    test.add_test_action(description, ExecuteProcess(cmd=["fake_server"]))
    service.include_launch_description(description)
    test.run(service)
"""
GOOD = [
    {"@bridge": True, "test/manager_launch.py": _TEST},
    _manager_example("[map_server, amcl]"),
    _manager_example("[map_server]", ' namespace="r1"'),
    _tree(""),
    _spawner(' namespace="left" args="arm"'),
    _spawner(' args="arm -c /left/controller_manager"'),
    _spawner(' args="arm -c $(env MANAGER)"'),
    _slam("Jazzy", "[slam_toolbox]"),
    {**_tree(_WITHOUT), "launch/control.launch.xml": _ELSEWHERE},
]
BAD = [
    _manager_example(f"[map_server, amcl, planner_server]{_MARK}"),
    _manager_example(f"[map_server, amcl]{_MARK}", ' namespace="r1"'),
    _slam("Humble", f"[slam_toolbox]{_MARK}"),
    _slam("Jazzy", f"[slam_toolbox, map_saver]{_MARK}"),
    _tree(' namespace="r1"', "  <!-- ^ WIR008 -->"),
    _spawner(' args="arm"', "  <!-- ^ WIR008 -->"),
    _spawner(' namespace="left" args="arm -c right/manager"', "  <!-- ^ WIR008 -->"),
]
