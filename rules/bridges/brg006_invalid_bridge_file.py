"""A YAML file of a bridge that is not valid, or an entry that the bridge ignores.

The file must be a sequence of mappings: each entry starts with `- `. Otherwise nothing is
bridged. An entry without types, with an unknown direction, or with `topic_name` in addition to
`ros_topic_name` or `gz_topic_name` is ignored with a line in the log. Keys that the bridge does not
know are ignored: a warning.

Fix: write `ros_topic_name`, `gz_topic_name`, `ros_type_name`, `gz_type_name` and `direction`
(BIDIRECTIONAL, GZ_TO_ROS or ROS_TO_GZ) for each topic.
Source: ros_gz_bridge, bridge_config.cpp; gazebosim/ros_gz issue 337.
"""

from checker.launch.ros2.bridges.entry import BridgeFaultKind
from checker.ros.simulation import Simulations
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule


@rule("BRG006", "invalid-bridge-file", Severity.ERROR, Concern.INTERFACE)
def check(simulations: Simulations) -> Findings:
    """Report what is wrong with files of bridges."""
    for simulation in simulations.all:
        for fault in simulation.bridges.faults:
            if fault.kind is BridgeFaultKind.ARGUMENT or fault.is_elsewhere:
                continue
            ignored = fault.kind is BridgeFaultKind.UNKNOWN_KEY
            yield finding(
                fault,
                fault.message,
                severity=Severity.WARNING if ignored else None,
                fix=replace_text(fault, fault.meant, Safety.UNSAFE) if fault.meant else None,
            )


_ENTRY = """- ros_topic_name: scan
  gz_topic_name: scan
  ros_type_name: sensor_msgs/msg/LaserScan
  gz_type_name: gz.msgs.LaserScan
  direction: GZ_TO_ROS
"""


def _changed_entry(*changes: str) -> dict[str, object]:
    """Return the entry with texts changed: each followed by what takes its place."""
    text = _ENTRY
    for old, new in zip(changes[::2], changes[1::2], strict=True):
        text = text.replace(old, new, 1)
    return {"@bridge": text}


_MARK = "  # ^ BRG006\n"
_FIRST = "topic_name: scan\n"
_PARAMETERS = "bridge:\n  ros__parameters:\n    config_file: ''\n"
GOOD = [
    {"@bridge": True},
    {"@bridge": _ENTRY},
    _changed_entry("  direction: GZ_TO_ROS\n", "  lazy: true\n  publisher_queue: 5\n"),
    _changed_entry("  gz_topic_name: scan\n", ""),
    {"@bridge": True, "config/bridge_parameters.yaml": _PARAMETERS},
]
BAD = [
    _changed_entry("- ", "  ", _FIRST, f"topic_name: scan{_MARK}"),
    _changed_entry("GZ_TO_ROS\n", f"GZ_to_ROS{_MARK}"),
    _changed_entry("  gz_type_name: gz.msgs.LaserScan\n", "", _FIRST, f"topic_name: scan{_MARK}"),
    _changed_entry("  gz_topic_name: scan\n", f"  topic_name: scan{_MARK}"),
    _changed_entry("  direction", f"  queue_size: 5{_MARK}  direction"),
    {"@bridge": True, "config/other_bridge.yaml": _ENTRY.replace("GZ_TO_ROS\n", f"NONE{_MARK}")},
]
