"""A parameter file without a block for the node that loads it.

The node starts with its defaults and prints no message: it reads only blocks whose key matches its
full name. A `name` or a namespace in the launch file changes the full name: the block
`controller_server:` applies neither to `/follower` nor to `/robot/controller_server`.

The rule reports a file if a block has the usual name of the program, or the node's name in another
namespace, and no node of the launch reads it; or if no node of the launch reads any of its blocks.
Nodes that an argument switches off by default are read too.

Fix: write the same name in both files. `/**` before a name matches any namespace, and the key `/**`
matches every node, as in the examples.
Source: rcl_yaml_param_parser; rclcpp, `parameter_map_from`; ROS 2 design, "Parameters".
"""

from collections.abc import Iterator

from checker.launch.ros2.graph import NodeKind, is_known
from checker.model.ros_parameters import MANAGER, NodeBlock
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.parameters import LoadedFile
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_COSTMAPS = ("local_costmap", "global_costmap")
"""Nodes that servers of Nav2 make themselves."""


@rule("WIR003", "unused-parameter-file", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report nodes that get nothing of a file, where the file was meant for them."""
    for node in wiring.every_node:
        for file in node.files if _is_alone(node) else ():
            orphans = _orphans(wiring, node, file)
            meant = next((block for block in orphans if _is_meant(block, node)), None)
            whole = wiring.knows_nodes and len(orphans) == len(file.blocks)
            if meant is None and not (orphans and whole):
                continue
            block = meant or orphans[0]
            keys = ", ".join(name.removeprefix("/") for name in file.names[:4])
            more = " …" if len(file.names) > 4 else ""
            yield finding(
                node.node.name or file.given.span,
                f"{node.label} gets no parameter from {file.path}, whose keys are {keys}{more}: "
                f"expected the key {node.full_name.removeprefix('/')}, or a node of that name",
                key=f"{node.full_name} {file.path}",
                related=[(block.span, "no node of this launch has this name")],
            )


def _is_alone(node: WiredNode) -> bool:
    """Return whether a process has no other nodes, as far as known."""
    kinds = (NodeKind.CONTAINER, NodeKind.INCLUDED)
    hosts = node.node.kind in kinds or node.node.package.value == MANAGER
    return bool(node.full_name) and not hosts and not node.node.unread


def _orphans(wiring: Wiring, node: WiredNode, file: LoadedFile) -> list[NodeBlock]:
    """Return the blocks of a file that no node reads; none if the node reads one."""
    if any(node.reads(block) for block in file.blocks):
        return []
    if not all(is_known(block.name) and "<" not in block.name for block in file.blocks):
        return []
    others = [other for other in wiring.every_node if other.full_name]
    return [block for block in file.blocks if not any(other.reads(block) for other in others)]


def _is_meant(block: NodeBlock, node: WiredNode) -> bool:
    """Return whether a block has a node's name without namespace, or its program's usual name."""
    return block.node in _names(node) and block.node not in _COSTMAPS


def _names(node: WiredNode) -> Iterator[str]:
    yield node.name
    yield node.node.executable.value
    if node.facts is not None and node.facts.name:
        yield node.facts.name


_NODE = """LaunchDescription([
        Node(package="{}", executable="{}",{}
             parameters=[os.path.join(HERE, "config", "a.yaml")]),
"""
_IN_NAMESPACE = _NODE.format("nav2_controller", "controller_server", ' namespace="rover",')
_HEAD = "LaunchDescription([\n"
_MARK = "  # ^ WIR003"


def _example(
    key: str, name: str, package: str = "nav2_controller", program: str = "controller_server"
) -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {_HEAD: _NODE.format(package, program, name)},
        "config/a.yaml": f"{key}:\n  ros__parameters: {{rate: 10}}\n",
    }


_CONTAINER = """LaunchDescription([
        ComposableNodeContainer(package="rclcpp_components", executable="component_container",
             name="box", namespace="", composable_node_descriptions=[ComposableNode(
             package="nav2_amcl", plugin="nav2_amcl::AmclNode",{}
             parameters=[os.path.join(HERE, "config", "a.yaml")])]),
"""
_IMPORTS = "from launch_ros.actions import Node\n"
_MORE = """from launch_ros.actions import ComposableNodeContainer, Node
from launch_ros.descriptions import ComposableNode
"""


def _component(name: str) -> dict[str, object]:
    """Return a container with a component, and parameters for `amcl`."""
    launch = {_HEAD: _CONTAINER.format(name), _IMPORTS: _MORE}
    return {**_example("amcl", ""), "@launch": launch}


_REWRITTEN = """
             parameters=[RewrittenYaml(os.path.join(HERE, "config", "a.yaml"), {}, "rover")]),
"""
_IN_ROVER = _IN_NAMESPACE.partition("\n             parameters")[0] + _REWRITTEN
_LIDAR = ("acme_lidar", "lidar_node")
_SWITCHED_OFF = {
    _HEAD: _NODE.format(*_LIDAR, f' name="lidar",{_MARK}\n condition=IfCondition("false"),'),
    _IMPORTS: f"from launch.conditions import IfCondition\n{_IMPORTS}",
}
GOOD = [
    _component(' name="amcl",'),
    _component(""),
    _example("controller_server", ""),
    _example("follower", ' name="follower",'),
    _example("/**", ' name="follower",'),
    _example("/**/controller_server", ' namespace="rover",'),
    _example("rover/controller_server", ' namespace="rover",'),
    {
        **_example("controller_server", ""),
        "@launch": {
            _HEAD: _IN_ROVER,
            _IMPORTS: f"{_IMPORTS}from nav2_common.launch import RewrittenYaml\n",
        },
    },
    _example("lidar", "", *_LIDAR),
    _example("lidar", ' name="lidar",', *_LIDAR),
    _example("wheel_controller", ' name="manager",', "controller_manager", "ros2_control_node"),
    {
        **_example("lidar", ' name="follower",'),
        "@launch": {
            _HEAD: _NODE.format(*_LIDAR, "")
            + _NODE.format("nav2_controller", "controller_server", "").partition("\n")[2]
        },
    },
]
BAD = [
    _component(f' name="localizer",{_MARK}'),
    _example("controller_server", f' name="follower",{_MARK}'),
    {
        **_example("controller_server", ""),
        "@launch": {_HEAD: _IN_NAMESPACE.replace('"a.yaml")]', f'"a.yaml")]{_MARK}\n')},
    },
    _example("laser", f' name="lidar",{_MARK}', *_LIDAR),
    _example("rover/lidar", f' name="lidar",{_MARK}', *_LIDAR),
    {**_example("lidar_node", ""), "@launch": _SWITCHED_OFF},
]
