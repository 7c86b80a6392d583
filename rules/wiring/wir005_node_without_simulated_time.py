"""A node works with the time of the machine, in a launch that simulates.

Its time is decades ahead of the stamps of all that Gazebo sends: a filter drops the measurements as
too old, lookups of transforms fail ("extrapolation into the past"), and navigation waits. With
`use_sim_time` a node takes its time from /clock. A block of a parameter file that gives it to one
node gives it to no other.

It is reported of localisation, mapping and navigation, where the launch file starts Gazebo, /clock
comes from it, and all parameters of the node were read.

Fix: state `use_sim_time: true` for the node, or `SetParameter` for all that follow it.
Source: ROS 2 design, "Clock and Time"; robot_localization, slam_toolbox and navigation2.
"""

from checker.model.ros.wiring.wiring import Wiring
from checker.rule import Concern, Findings, Severity, finding, rule

_PARAMETER = "use_sim_time"
_CLOCK = "rosgraph_msgs/msg/Clock"
_PACKAGES = (
    *("robot_localization", "slam_toolbox", "nav2_amcl", "nav2_controller", "nav2_planner"),
    *("nav2_behaviors", "nav2_bt_navigator", "nav2_collision_monitor"),
)
"""Their nodes compare their own time with the stamps of messages and transforms."""


@rule("WIR005", "node-without-simulated-time", Severity.WARNING, Concern.INTERFACE)
def check(wiring: Wiring) -> Findings:
    """Report nodes that do not take their time from Gazebo, though it is there."""
    if not _has_clock(wiring):
        return
    for node in wiring.nodes:
        if node.node.package.value not in _PACKAGES or not node.knows_parameters:
            continue
        setting = node.settings.get(_PARAMETER)
        if setting is None or setting.text == "false":
            stated = "no use_sim_time" if setting is None else "use_sim_time: false"
            yield finding(
                node.node.span if setting is None else setting.span,
                f"{node.called} has {stated}, expected true: this launch starts Gazebo, and what "
                "it sends has the time of /clock",
                key=node.full_name,
            )


def _has_clock(wiring: Wiring) -> bool:
    """Whether the launch starts Gazebo for certain, and its time comes to ROS."""
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


GOOD = [
    _filter("ekf_filter_node"),
    _filter("/**"),
    _filter("other", ', {"use_sim_time": True}'),
    _filter("other", package="acme_filter"),
    {**_filter("other"), "@bridge": "[]\n"},
    {
        **_filter("other"),
        "@launch": {
            _HEAD: _EKF.format("robot_localization", "", ""),
            '[("gz_args", "-r empty.sdf")]),': '[("gz_args", "-g")]),',
        },
    },
]
BAD = [
    _filter("other", mark=_MARK),
    _filter("ekf_filter_node", ', {"use_sim_time": False}]),  # ^ WIR005\n#'),
]
