"""The relays to the mapping server are missing, or do not get the robot's name.

A robot's map reaches the challenge's mapping server through topics that
`mapping_server_relays.launch` of subt_ros relays. Without this file everything else works, but the
map is lost; without `name` it relays no robot's topics.

Fix: inside the group of the robot's name, `<include file="$(find
subt_ros)/launch/models_common/mapping_server_relays.launch"><arg name="name" value="$(arg name)"/>
</include>`.
Source: two reviews required it; all accepted packages that we checked include it, whatever their
drive. The content of the file is general knowledge: subt_ros is not available.
"""

import posixpath

from checker.launch.ros1.graph import Include, LaunchGraph, UnresolvedInclude
from checker.launch.ros1.substitution import is_known
from checker.package.inheritance import Found
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_TOPICS = "launch/vehicle_topics.launch"


@rule("ROS013", "mapping-server-relays", Severity.WARNING, Concern.INTERFACE)
def check(
    package: Package, launch: LaunchGraph, *, relays: str = "mapping_server_relays.launch"
) -> Findings:
    """Look for the include of the relays in all started files.

    Options:
        relays: Name of the launch file, without folders, that must be included and get the robot's
            name as `name`.
    """
    started: tuple[Include | UnresolvedInclude, ...] = launch.includes + launch.unresolved_includes
    includes = [include for include in started if posixpath.basename(include.file) == relays]
    named = launch.arguments.get("name")
    for include in includes:
        name = include.arguments.get("name")
        if name is None:
            yield finding(
                include, f"{relays} is included without the arg 'name', expected $(arg name)"
            )
        elif named is not None and is_known(name) and name != named.value:
            yield finding(
                include,
                f"{relays} gets the name {name!r}, expected the robot's name: $(arg name)",
            )
    if includes:
        return
    reasons = [reason for reason in launch.unread if reason != launch.unknown_commands]
    for reason in reasons:
        yield unchecked(reason)
    if not reasons:
        part = package.part(_TOPICS)
        place = package.place(part.path) if isinstance(part, Found) else package.folder_place()
        off = [
            include
            for include in launch.dormant_includes
            if posixpath.basename(include.file) == relays
        ]
        yield finding(
            place,
            f"nothing includes {relays} of subt_ros: expected it in the group of the robot, "
            "with its name",
            related=[(include, "switched off") for include in off],
        )


_FILE = "$(find subt_ros)/launch/models_common/mapping_server_relays.launch"
_NAME = '<arg name="name" value="$(arg name)"/>'


def _launch(content: str, mark: str = "", arguments: str = "") -> dict[str, str]:
    return {
        _TOPICS: f"""<launch>
<arg name="name"/>
<arg name="world_name"/>
<include {arguments} file="{_FILE}">{mark}
{content}
</include>
</launch>
"""
    }


_MARK = "  <!-- ^ ROS013 -->"

GOOD = [
    _launch(_NAME),
    _launch("", arguments='pass_all_args="true"'),
]
BAD = [
    _launch("", _MARK),
    _launch('<arg name="name" value="X1"/>', _MARK),
    {**_launch(_NAME, arguments='if="0"'), "@reported": [f"{_TOPICS}:1"]},
    {"@reported": [f"{_TOPICS}:1"]},
]
