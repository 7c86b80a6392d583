"""An argument that `parameter_bridge` cannot read.

The program prints its usage and ends at the first such argument: none of its other topics is
bridged either. A YAML file is no argument of its own.

Fix: write `<topic>@<ros type>[<gz type>` (Gazebo to ROS), `]` (ROS to Gazebo) or `@` (both ways),
without spaces, such as `/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan`. Give a file of topics
as `--ros-args -p config_file:=FILE`, or in `parameters` of the node: `{'config_file': FILE}`.
Source: ros_gz_bridge, parameter_bridge.cpp.
"""

from checker.launch.ros2.bridges.entry import BridgeFaultKind
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("BRG001", "invalid-bridge-argument", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report the arguments that are refused."""
    for simulation in simulations.all:
        for fault in simulation.bridges.faults:
            if fault.kind is BridgeFaultKind.ARGUMENT and not fault.is_elsewhere:
                yield finding(fault, fault.message)


def _bridge(argument: str, mark: str = "") -> dict[str, object]:
    return {"@bridge": True, "@launch": {"arguments=[],": f'arguments=["{argument}"],{mark}'}}


_MARK = "  # ^ BRG001"
GOOD = [
    {"@bridge": True},
    _bridge("/scan@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan"),
    _bridge("/scan@sensor_msgs/msg/LaserScan@gz.msgs.LaserScan"),
    _bridge("/world/w/control@ros_gz_interfaces/srv/ControlWorld"),
    _bridge('--ros-args", "-p", "config_file:=/acme/bridge.yaml'),
]
BAD = [
    _bridge("/scan[sensor_msgs/msg/LaserScan[gz.msgs.LaserScan", _MARK),
    _bridge("/scan@sensor_msgs/msg/LaserScan", _MARK),
    _bridge("/scan@sensor_msgs/msg/LaserScan[", _MARK),
    _bridge("@sensor_msgs/msg/LaserScan[gz.msgs.LaserScan", _MARK),
    _bridge("@/acme/bridge.yaml", _MARK),
]
