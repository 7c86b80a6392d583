"""A launch file that roslaunch refuses.

roslaunch reads all files before it starts anything. With an undeclared arg, an include without a
required arg, or an include of a missing file, the robot starts without any of its topics. Files in
packages that are not available are not checked.

Fix: declare the arg with `<arg name="…"/>`, pass it with `<arg name="…" value="…"/>` inside the
include, or correct the path.
Source: roslaunch XML specification, substitution args and `<include>`.
"""

from collections.abc import Collection, Iterator, Mapping

from checker.launch.ros1.graph import LaunchFault, LaunchFaultKind, LaunchGraph, Param
from checker.launch.ros1.launch_file import target_of
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, finding, rule, unchecked

_FATAL: Mapping[LaunchFaultKind, str] = {
    LaunchFaultKind.UNDECLARED_ARG: "roslaunch stops with an error",
    LaunchFaultKind.MISSING_ARG: "roslaunch stops",
    LaunchFaultKind.UNKNOWN_ARG: "roslaunch stops",
    LaunchFaultKind.CONSTANT_ARG: "roslaunch stops",
    LaunchFaultKind.REPEATED_ARG: "roslaunch stops",
    LaunchFaultKind.CONDITION: "roslaunch stops",
    LaunchFaultKind.SUBSTITUTION: "roslaunch stops",
    LaunchFaultKind.MISSING_FILE: "roslaunch stops",
    LaunchFaultKind.INCLUDE_LOOP: "roslaunch never finishes",
    LaunchFaultKind.BRIDGE: "the bridge ends immediately",
}
"""Consequences of faults; a limit of this checker's reader is not a fault of the file."""

_OF_COMMANDS = (
    LaunchFaultKind.UNDECLARED_ARG,
    LaunchFaultKind.MISSING_ARG,
    LaunchFaultKind.CONSTANT_ARG,
)
_FILES = ("load", "textfile", "binfile")


@rule("ROS010", "broken-launch-file", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, launch: LaunchGraph) -> Findings:
    """Report faults that stop roslaunch, in the files that are started."""
    if launch.unknown_commands:
        yield unchecked(launch.unknown_commands)
    absent = [
        fault.message for fault in launch.faults if fault.kind is LaunchFaultKind.MISSING_FILE
    ]
    for reason in launch.unread:
        if reason != launch.unknown_commands and not reason.endswith(tuple(absent)):
            yield unchecked(reason)
    included = {include.file for include in launch.includes}
    for fault in launch.faults:
        if fault.kind is LaunchFaultKind.LIMIT:
            yield unchecked(f"{fault.span.source.file} is not read completely: {fault.message}")
        elif not (launch.unknown_commands and _may_be_given(fault, included)):
            yield finding(fault, f"{fault.message}: {_FATAL[fault.kind]}", key=fault.message)
    for param in launch.params:
        if param.kind in _FILES:
            yield from _missing_file(package, param)


def _may_be_given(fault: LaunchFault, included: Collection[str]) -> bool:
    """Return whether the missing arg may be passed on the command line."""
    return fault.kind in _OF_COMMANDS and fault.span.source.file not in included


def _missing_file(package: Package, param: Param) -> Iterator[Finding]:
    """Report a parameter whose file an available package does not have."""
    name, path = target_of(param.value)
    holder = package.named(name or package.name)
    if path and holder is not None and not holder.exists(path):
        named = f"{path} of {name}" if name else path
        yield finding(param, f"{named}, from which {param.name} is read, does not exist")


_TOPICS = "launch/vehicle_topics.launch"
_ARGS = '<arg name="name"/>\n<arg name="world_name"/>\n'
_MARK = "  <!-- ^ ROS010 -->"
_HERE = "acme_rover_sensor_config_1"


def _launch(content: str, more: str = "") -> dict[str, str]:
    return {
        _TOPICS: f"<launch>\n{_ARGS}{content}\n</launch>\n",
        "launch/camera.launch": f'<launch>\n<arg name="side"/>\n{more}\n</launch>\n',
    }


def _include(args: str, mark: str = "", file: str = "$(dirname)/camera.launch") -> dict[str, str]:
    return _launch(f'<include file="{file}">{mark}\n{args}\n</include>')


_SIDE = '<arg name="side" value="left"/>'

GOOD = [
    _include(_SIDE),
    {_TOPICS: '<launch>\n<param name="a" value="$(arg name)"/>\n</launch>\n'},
    _include(_SIDE, file=f"$(find {_HERE})/launch/camera.launch"),
    _include("", file="$(find subt_ros)/launch/models_common/set_rate_relay.launch"),
    _launch('<group if="0"><param name="a" value="$(arg nobody)"/></group>'),
    _launch('<rosparam file="$(find acme_params)/config/a.yaml"/>'),
]
BAD = [
    _launch(f'<param name="a" value="$(arg nobody)"/>{_MARK}'),
    _include("", _MARK),
    _include(f'{_SIDE}\n<arg name="sied" value="left"/>{_MARK}'),
    _include(_SIDE, _MARK, f"$(find {_HERE})/launch/camara.launch"),
    _launch(f'<include file="$(dirname)/vehicle_topics.launch" pass_all_args="true"/>{_MARK}'),
    _launch(f'<arg name="name"/>{_MARK}'),
    _launch(f'<group if="maybe"/>{_MARK}'),
    _launch(f'<rosparam file="$(find {_HERE})/config/a.yaml"/>{_MARK}'),
    _launch(
        f'<node pkg="ros_ign_bridge" type="parameter_bridge" name="b" args="/topic@type"/>{_MARK}'
    ),
]
