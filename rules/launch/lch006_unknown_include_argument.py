"""An argument that the included launch file neither declares nor uses.

It is accepted in silence and has no effect: a misspelt name leaves the default in force. Files that
are not available, and files that include such, are not judged.

Fix: correct the name, or leave the argument out.
Source: launch, `IncludeLaunchDescription`: arguments become configurations, declared or not.
"""

from checker.base.words import Suggestions
from checker.expand.ros2_launch.graph import Ros2Launch
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("LCH006", "unknown-include-argument", Severity.INFO, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report arguments of includes that nothing asks for."""
    for graph in launch.entries:
        for include in graph.includes:
            if include.accepts is None:
                continue
            names = Suggestions(include.accepts)
            for name, value in include.arguments.items():
                if name not in include.accepts:
                    near = names.near(name)
                    yield finding(
                        value,
                        f"{include.path} neither declares nor uses argument {name!r}"
                        f"{names.hint(name)}",
                        severity=Severity.WARNING if near else None,
                    )


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

GOOD = [
    {"@ros2": True, "launch/view.launch.xml": _OTHER, "launch/all.launch.xml": _INCLUDE},
    {
        "@ros2": True,
        "launch/view.launch.xml": _OTHER.replace(
            "<node", '<include file="$(find-pkg-share nav2_bringup)/launch/x.launch.py"/><node'
        ),
        "launch/all.launch.xml": _INCLUDE.replace("gui", "map"),
    },
]
BAD = [
    {
        "@ros2": True,
        "launch/view.launch.xml": _OTHER,
        "launch/all.launch.xml": _INCLUDE.replace(
            '"gui" value="false"/>', '"gui_on" value="false"/> <!-- ^ LCH006 -->'
        ),
    },
]
