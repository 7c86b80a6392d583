"""Nodes use simulated time, but /clock is not bridged from Gazebo.

With `use_sim_time` the time of a node is zero until a message arrives on /clock. Gazebo publishes
it only in Gazebo: without a bridge, timers do not run, transforms are never recent, and RViz and
navigation wait. It is reported where the launch file that starts Gazebo was read in full, and no
launch file of the package bridges the clock. robot_state_publisher goes on with the time of the
joint states: where it is the only one that waits, it is a warning.

Fix: add the bridge `/clock@rosgraph_msgs/msg/Clock[gz.msgs.Clock`.
Source: ROS 2, design of clock and time; ros-controls/gz_ros2_control issue 443.
"""

from checker.launch.ros2.bridges.entry import BridgeFaultKind
from checker.launch.ros2.graph import GAZEBO, Node
from checker.ros.simulation import Simulation, Simulations
from checker.rule import Concern, Findings, Severity, finding, rule

_IGNORED = BridgeFaultKind.UNKNOWN_KEY
_CLOCK = "rosgraph_msgs/msg/Clock"
_MAY_PUBLISH = ("bridge", "clock", "gz", "ign", "sim")
"""Words in the names of programs, of whatever package, that may publish the clock."""
_GOES_ON = "robot_state_publisher"
_KNOWN = ("ros_gz_bridge", "ros_ign_bridge", "ros_gz_image", "ros_ign_image")


@rule("BRG008", "no-clock", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report the first node of each launch file that waits for the clock."""
    if any(_is_clock(simulation) for simulation in simulations.all):
        return
    for simulation in simulations.launched:
        if not simulation.starts_gazebo or simulation.unread or simulation.graph is None:
            continue
        left_out = {fault.kind for fault in simulation.bridges.faults} - {_IGNORED}
        nodes = simulation.graph.nodes
        waiting = [node for node in nodes if node.starts and _takes_clock(node)]
        others_publish = any(map(_may_publish, nodes))
        if not waiting or left_out or others_publish:
            continue
        goes_on = all(node.executable.value == _GOES_ON for node in waiting)
        parameter = waiting[0].parameter("use_sim_time")
        others = f" and {len(waiting) - 1} more" if len(waiting) > 1 else ""
        yield finding(
            parameter or waiting[0],
            f"node {waiting[0].executable.value!r}{others} with use_sim_time: no message "
            "arrives on /clock, because no bridge passes it from Gazebo, which this launch starts",
            severity=Severity.WARNING if goes_on else None,
        )


def _is_clock(simulation: Simulation) -> bool:
    return any(
        entry.passed.ros_type.value == _CLOCK and entry.ros_topic in ("", "/clock")
        for entry in simulation.entries
    )


def _takes_clock(node: Node) -> bool:
    parameter = node.parameter("use_sim_time")
    return (
        parameter is not None
        and str(parameter.value).lower() == "true"
        and node.package.value not in _KNOWN
    )


def _may_publish(node: Node) -> bool:
    if node.package.value in _KNOWN:
        return False
    if node.package.value in GAZEBO:
        return node.executable.value != "create"
    return any(word in node.executable.value.lower() for word in _MAY_PUBLISH)


_SCAN = """- topic_name: scan
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
"""
_CLOCK_ENTRY = (
    "- topic_name: {}\n  ros_type_name: rosgraph_msgs/msg/Clock\n  gz_type_name: gz.msgs.Clock\n"
)
_TIME = '{"use_sim_time": True}]'
_COMPONENT = """LaunchDescription([
        LoadComposableNodes(target_container="nav", composable_node_descriptions=[
            ComposableNode(package="nav2_amcl", plugin="nav2_amcl::AmclNode", name="amcl",
                           parameters=[{"use_sim_time": @}])]),%
"""


def _component(simulated: str, mark: str = "") -> dict[str, object]:
    imports = "from launch_ros.actions import Node\n"
    more = f"from launch_ros.actions import LoadComposableNodes\n{imports}"
    more += "from launch_ros.descriptions import ComposableNode\n"
    launch = _COMPONENT.replace("@", simulated).replace("%", mark)
    heads = {_TIME: "]", "LaunchDescription([\n": launch, imports: more}
    return {"@bridge": _SCAN, "@launch": heads}


GOOD = [
    _component("False"),
    {"@bridge": True},
    {"@bridge": _SCAN, "@launch": {_TIME: "]"}},
    {"@bridge": _SCAN, "@launch": {"LaunchDescription([\n": "LaunchDescription([other(),\n"}},
    {"@bridge": _SCAN, "config/clock_bridge.yaml": _CLOCK_ENTRY.format("/clock")},
]
BAD = [
    _component("True", "  # ^ BRG008"),
    {"@bridge": _SCAN, "@launch": {f"{_TIME}),": f"{_TIME}),  # ^ BRG008"}},
    {
        "@bridge": _SCAN + _CLOCK_ENTRY.format("/rover/clock"),
        "@launch": {f"{_TIME}),": f"{_TIME}),  # ^ BRG008"},
    },
]
