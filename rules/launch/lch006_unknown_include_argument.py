"""An argument that the included launch file neither declares nor uses.

It is accepted without a message and has no effect: with a misspelt name, the default is used. This
is a warning of such a name, and of an argument that names a file, such as a world or parameters,
which then is not loaded: `gz_sim.launch.py` takes a world in `gz_args`.

The usual launch files of nav2_bringup, slam_toolbox, ros_gz_sim and ros_gz_bridge are checked too,
except in packages for Foxy and Galactic, whose arguments have other names; other files that are not
available, and files that include such files, are not.

Fix: correct the name, or leave the argument out.
Source: launch, `IncludeLaunchDescription`: arguments become configurations, declared or not;
navigation2, slam_toolbox and ros_gz, humble to lyrical: arguments of their launch files.
"""

import posixpath

from checker.base.words import Suggestions
from checker.launch.ros2.graph import Include, Ros2Launch, display_path
from checker.launch.ros2.known_files import known_file
from checker.package.distribution_sign import former_name
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule

_FILES = (".sdf", ".world", ".urdf", ".xacro", ".yaml", ".yml")
_WORLD, _INSTEAD = "gz_args", "; a world belongs into gz_args"


@rule("LCH006", "unknown-include-argument", Severity.INFO, Concern.INTERFACE)
def check(launch: Ros2Launch, package: Package) -> Findings:
    """Report arguments of includes that the included file does not use."""
    is_former = bool(former_name(package))
    for graph in launch.entries:
        for include in graph.includes:
            if include.accepts is None or (is_former and _is_of_others(include)):
                continue
            names = Suggestions(include.accepts)
            for name, value in include.arguments.items():
                if name not in include.accepts:
                    file = value.value.lower().endswith(_FILES)
                    lost = f", so {posixpath.basename(value.value)} is not loaded" if file else ""
                    meant = names.hint(name) or (_INSTEAD if _WORLD in include.accepts else "")
                    yield finding(
                        value,
                        f"{include.path or display_path(include.target.value)} neither declares "
                        f"nor uses argument {name!r}{lost}{meant}",
                        severity=Severity.WARNING if file or names.closest(name) else None,
                    )


def _is_of_others(include: Include) -> bool:
    """Return whether the arguments of a file are those of Humble and later distributions."""
    return bool(include.reason) and known_file(include.target.value) is not None


_OTHER = """<launch>
  <arg name="gui" default="true"/>
  <node pkg="rviz2" exec="rviz2" if="$(var gui)"/>
</launch>
"""
_INCLUDE = """<launch>
  <include file="$(find-pkg-share acme_arm_bringup)/launch/view.launch.xml">
    <arg name="gui" value="false"/>
  </include>
</launch>
"""

_NAV2 = """<launch>
  <include file="$(find-pkg-share nav2_bringup)/launch/bringup_launch.py">
    <arg name="@" value="/maps/hall.yaml"/>
  </include>
</launch>
"""

_GZ = """<launch>
  <include file="$(find-pkg-share ros_gz_sim)/launch/gz_sim.launch.py">
    <arg name="world" value="/worlds/hall.sdf"/> <!-- ^ LCH006 -->
  </include>
</launch>
"""

GOOD = [
    {"@ros2": True, "launch/all.launch.xml": _NAV2.replace("@", "map")},
    {"@ros2": True, "launch/all.launch.xml": _NAV2.replace("@", "graph")},
    {"@ros2": True, "launch/all.launch.xml": _NAV2.replace("@", "a").replace("bringup_", "a_")},
    {"@ros2": True, "launch/view.launch.xml": _OTHER, "launch/all.launch.xml": _INCLUDE},
    {
        "@ros2": True,
        "README.md": "Tested with ROS 2 Foxy.\n",
        "launch/all.launch.xml": _NAV2.replace("@", "map_file"),
    },
    {
        "@ros2": True,
        "launch/view.launch.xml": _OTHER.replace(
            "<node", '<include file="$(find-pkg-share nav2_bringup)/launch/x.launch.py"/><node'
        ),
        "launch/all.launch.xml": _INCLUDE.replace("gui", "map"),
    },
]
BAD = [
    {"@ros2": True, "launch/all.launch.xml": _GZ},
    {
        "@ros2": True,
        "launch/all.launch.xml": _NAV2.replace('"@"', '"map_file"').replace(
            '.yaml"/>', '.yaml"/> <!-- ^ LCH006 -->'
        ),
    },
    {
        "@ros2": True,
        "launch/view.launch.xml": _OTHER,
        "launch/all.launch.xml": _INCLUDE.replace(
            '"gui" value="false"/>', '"gui_on" value="false"/> <!-- ^ LCH006 -->'
        ),
    },
]
