"""A parameter file that rcl refuses: the node ends when it starts.

A parameter file of ROS 2 contains names of nodes, below each of them `ros__parameters`, and the
values below that. A value anywhere else makes rcl refuse the whole file ("Cannot have a value
before ros__parameters"), for every node that loads it. Files of ROS 1, and those that a library
reads by itself, have their values at the top. A list of lists is refused as well ("Sequences cannot
be key"): a `footprint` of Nav2 is a text that contains one.

It is reported where a launch file loads the file as the parameters of a node. A parameter whose
value is the path of such a file is not reported. For a component, launch itself reads the file, and
accepts values at the top.

Fix: put the values below the name of the node and `ros__parameters`. A slash and two asterisks
instead of the name represent every node. Write a list of lists as a text, in quotation marks, or as
one list, as the node expects it.
Source: ros2/rcl, rcl_yaml_param_parser, `parse_file_events`.
"""

from collections.abc import Iterator
from itertools import pairwise

from checker.launch.ros2.graph import NodeKind
from checker.ros.wiring.nodes import WiredNode
from checker.ros.wiring.parameters import LoadedFile
from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Finding, Findings, Severity, finding, rule

_TEXT = "footprint"
"""A parameter of Nav2's costmaps that is a text."""


@rule("WIR007", "invalid-parameter-file", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report the parameter files of nodes that have a value of no node, or a list of lists."""
    for node in wiring.nodes:
        for file in node.files:
            if file.refused is None:
                yield from _lists_of_lists(node, file)
                continue
            name = node.full_name.removeprefix("/") or "/**"
            yield finding(
                file.refused,
                f"{node.label} ends when it starts: {file.path} has a value outside of "
                f"ros__parameters, expected `{name}:`, below it `ros__parameters:`, then the "
                "values",
                key=file.path,
                related=[(file.given.span, "the file is given to the node here")],
            )


def _lists_of_lists(node: WiredNode, file: LoadedFile) -> Iterator[Finding]:
    """Yield parameters of any node in a file that have two lists in a row as their items."""
    if node.node.kind is NodeKind.COMPONENT:
        return
    for parameter in (it for block in file.blocks for it in block.parameters.values()):
        kinds = [item.kind for item in parameter.node.items]
        if ("sequence", "sequence") in pairwise(kinds):
            short = parameter.name.rpartition(".")[2]
            cure = f'write it as a text, `{short}: "[[0.2, 0.1], …]"`'
            yield finding(
                parameter.node,
                f"{node.label} ends when it starts: {parameter.name} is a list of lists, for which "
                f"rcl refuses {file.path}: {cure if short == _TEXT else 'write one list'}",
                key=f"{file.path} lists",
                related=[(file.given.span, "the file is given to the node here")],
            )


_NODE = """LaunchDescription([
        Node(package="acme_lidar", executable="lidar_node", name="lidar",
             parameters=[{}os.path.join(HERE, "config", "a.yaml"){}]),
"""


def _example(yaml: str, before: str = "", after: str = "") -> dict[str, object]:
    return {
        "@bridge": True,
        "@launch": {"LaunchDescription([\n": _NODE.format(before, after)},
        "config/a.yaml": yaml,
    }


_COMPONENT = """<launch>
  <node_container pkg="rclcpp_components" exec="component_container" name="box" namespace="">
    <composable_node pkg="acme_lidar" plugin="acme_lidar::Lidar" name="lidar">
      <param from="$(find-pkg-share acme_rover_bringup)/config/a.yaml"/>
    </composable_node>
  </node_container>
</launch>
"""

GOOD = [
    {
        "@bridge": True,
        "launch/lidar.launch.xml": _COMPONENT,
        "config/a.yaml": "rate: 10\n",
    },
    _example("lidar:\n  ros__parameters:\n    rate: 10\n    frames: [a, b]\n"),
    _example(
        "r1:\n  lidar:\n    ros__parameters: {rate: 10}\n/**:\n  ros__parameters: {a: {b: 1}}\n"
    ),
    _example("lidar: {}\n"),
    _example('lidar:\n  ros__parameters:\n    footprint: "[[0.2, 0.1], [0.2, -0.1]]"\n'),
    _example("rate: 10\n", '{"config": ', "}"),
]
BAD = [
    _example("rate: 10  # ^ WIR007\n"),
    _example("lidar:\n  rate: 10  # ^ WIR007\n"),
    _example("lidar:\n  ros__parameters: {rate: 10}\nframes: [a, b]  # ^ WIR007\n"),
    _example("lidar:\n  ros__parameters: {rate: 10}\n  names:  # ^ WIR007\n"),
    _example("ros__parameters:  # ^ WIR007\n  rate: 10\n"),
    _example("lidar:\n  ros__parameters:\n    footprint: [[0.2, 0.1], [0.2, -0.1]]  # ^ WIR007\n"),
    _example("a:\n  b:\n    ros__parameters:\n      places: [[1, 2], [3]]  # ^ WIR007\n"),
]
