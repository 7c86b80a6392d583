"""A substitution of roslaunch in a launch file of ROS 2.

`$(arg x)`, `$(find p)` and `$(optenv V)` are unknown there: the launch ends with an error.

Fix: write `$(var x)`, `$(find-pkg-share p)` and `$(env V default)`.
Source: launch_xml and launch_ros, substitutions; ika-rwth-aachen/ros2-pkg-create#27.
"""

from checker.launch.ros2.graph import LaunchFaultKind, Ros2Launch
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule

_NEW = {"arg": "var", "find": "find-pkg-share", "optenv": "env"}


@rule("LCH003", "ros-1-substitution", Severity.ERROR, Concern.INTERFACE)
def check(launch: Ros2Launch) -> Findings:
    """Report substitutions that only ROS 1 has."""
    for graph in launch.entries:
        for fault in graph.faults:
            new = _NEW.get(fault.name)
            if fault.kind is LaunchFaultKind.SUBSTITUTION and new is not None:
                text = fault.span.text
                replacement = text.replace(fault.name, new, 1)
                exact = text.startswith("$(")
                yield finding(
                    fault,
                    f"$({fault.name} …) is not a substitution of ROS 2: expected $({new} …)",
                    key=fault.name,
                    fix=replace_text(fault, replacement, Safety.UNSAFE) if exact else None,
                )


_XML = """<launch>
  <arg name="gui" default="true"/>
  <node pkg="rviz2" exec="rviz2" if="$(var gui)"/>
</launch>
"""

GOOD = [
    {"@ros2": True, "launch/view.launch.xml": _XML},
    {
        "@ros2": True,
        "launch/old.launch": '<launch><node pkg="p" type="t" name="$(arg x)"/></launch>',
    },
]
BAD = [
    {
        "@ros2": True,
        "launch/view.launch.xml": _XML.replace('$(var gui)"/>', '$(arg gui)"/> <!-- ^ LCH003 -->'),
    },
    {
        "@ros2": True,
        "launch/view.launch": """<launch>
  <include file="$(find rviz2)/x.launch"/>  <!-- ^ LCH003 -->
</launch>
""",
    },
]
