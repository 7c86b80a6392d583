"""A parameter file that rcl refuses: the node ends when it starts.

A parameter file of ROS 2 contains names of nodes, below each of them `ros__parameters`, and the
values below that. A value anywhere else makes rcl refuse the whole file ("Cannot have a value
before ros__parameters"), for every node that loads it. Files of ROS 1, and those that a library
reads by itself, have their values at the top.

It is reported where a launch file loads the file as the parameters of a node. A parameter whose
value is the path of such a file is not reported. For a component, launch itself reads the file, and
accepts values at the top.

Fix: put the values below the name of the node and `ros__parameters`. A slash and two asterisks
instead of the name represent every node.
Source: ros2/rcl, rcl_yaml_param_parser, `parse_file_events`.
"""

from checker.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("WIR007", "invalid-parameter-file", Severity.ERROR, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report the parameter files of nodes that have a value of no node."""
    for node in wiring.nodes:
        for file in node.files:
            if file.refused is None:
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
    _example("rate: 10\n", '{"config": ', "}"),
]
BAD = [
    _example("rate: 10  # ^ WIR007\n"),
    _example("lidar:\n  rate: 10  # ^ WIR007\n"),
    _example("lidar:\n  ros__parameters: {rate: 10}\nframes: [a, b]  # ^ WIR007\n"),
    _example("lidar:\n  ros__parameters: {rate: 10}\n  names:  # ^ WIR007\n"),
    _example("ros__parameters:  # ^ WIR007\n  rate: 10\n"),
]
