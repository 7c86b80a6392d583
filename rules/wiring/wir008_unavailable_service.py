"""A node waits for a service or action that nothing in the launch offers.

The startup stops there: a lifecycle manager requests the state of each of its `node_names` and
waits for the answer, so a name without a node blocks all others; `bt_navigator` does not become
active without the servers of its behaviour tree, and a spawner of controllers waits for the
controller manager of its own namespace. A namespace on only one of two nodes, or a `name`
in the launch file, makes the names differ as well.

It is reported where all nodes of the launch file are known, and no other launch file of the package
starts a node that offers it. Custom behaviour trees may need other servers, and are not checked;
nor are launch files with a `LaunchTestService`, which starts the program under test.

Fix: start the node that is missing, or correct its name or namespace.
Source: navigation2, nav2_lifecycle_manager and nav2_bt_navigator; ROS 2 design, "Managed nodes".
"""

from collections.abc import Iterator

from checker.base.words import and_list
from checker.launch.ros2.graph import LaunchGraph, Node, Ros2Launch
from checker.package.package import Package
from checker.ros.wiring.facts import NodeFacts, node_facts, program_of
from checker.ros.wiring.services import Wanted, offered_services, wanted_services
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked
from checker.source.text import SourceText

_TESTS = "LaunchTestService("
"""Part of launch files that start programs of tests besides what they describe."""


@rule("WIR008", "unavailable-service", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring, launch: Ros2Launch, package: Package) -> Findings:
    """Report services and actions that known nodes wait for, and that no node offers."""
    source = package.read(wiring.graph.file)
    if isinstance(source, SourceText) and _TESTS in source.text:
        return
    yield from _lost_spawners(wiring)
    there = {name for node in wiring.every_node for name in offered_services(node)}
    others = [graph for graph in launch.entries if graph is not wiring.graph]
    for node in wiring.nodes:
        for each in wanted_services(node):
            if each.name in there or any(_may_offer(graph, each) for graph in others):
                continue
            if unknown := _unknown_cause(wiring):
                yield unchecked(f"the nodes that offer {each.name} are not all known: {unknown}")
                continue
            what = f"node {each.item!r}" if each.item else each.name
            yield finding(
                each.span,
                f"{node.label} waits for {what}: nothing in this launch offers {each.name}",
                key=f"{node.label} {each.name}",
            )


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
    {**_tree(_WITHOUT), "launch/control.launch.xml": _ELSEWHERE},
]
BAD = [
    _manager_example(f"[map_server, amcl, planner_server]{_MARK}"),
    _manager_example(f"[map_server, amcl]{_MARK}", ' namespace="r1"'),
    _tree(' namespace="r1"', "  <!-- ^ WIR008 -->"),
    _spawner(' args="arm"', "  <!-- ^ WIR008 -->"),
    _spawner(' namespace="left" args="arm -c right/manager"', "  <!-- ^ WIR008 -->"),
]
