"""A plugin names a joint, link or sensor that does not exist.

The plugin starts, finds nothing to act on, and does nothing: the wheel does not turn, the rotor
does not lift, or the wheel slip is not applied. A drive plugin of Gazebo Classic ends with an
error.

No accepted package that we checked has this fault.

Fix: name the part exactly as in its `name` attribute in the model.
Source: parameter descriptions of Gazebo's systems, and of the plugins of gazebo_ros_pkgs
(`plugin_references.json`).
"""

from checker.base.resources import table
from checker.base.words import Suggestions
from checker.model.components import Plugin
from checker.model.plugin_library import library_stem
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, misspelt, rename, rule, unchecked


@rule("PLG004", "plugin-names-unknown-part", Severity.ERROR, Concern.INTERFACE)
def check(robot: Robot) -> Findings:
    """Report parameters that name no part of the robot."""
    parts = {
        "joint": frozenset(robot.joints_by_name),
        "link": frozenset(robot.links_by_name),
    }
    suggestions = {kind: Suggestions(names) for kind, names in parts.items()}
    if robot.unread_plugins:
        yield unchecked(robot.unread_plugins)
    references = table("plugin_references")
    for plugin in robot.all_plugins:
        of_class = references["plugins"].get(plugin.class_name, {})
        of_library = references["libraries"].get(library_stem(plugin.filename.value), {})
        parameters = of_class or of_library
        for path, kind in parameters.items():
            for named in plugin.at(path):
                if _exists(robot, plugin, named.value, parts[kind]):
                    continue
                message = (
                    f"{plugin.label} names {kind} {named.value!r}, "
                    f"which {robot.name.value!r} does not have"
                )
                joints = _joints_of(robot, named.value) if kind == "joint" else []
                if len(joints) == 1:
                    message += f": it is a link, whose joint is {joints[0]!r}"
                    yield finding(named, message, fix=rename(named, joints[0]))
                else:
                    yield misspelt(named, message, suggestions[kind])


def _exists(robot: Robot, plugin: Plugin, name: str, names: frozenset[str]) -> bool:
    scope = f"{plugin.nested_in}::" if plugin.nested_in else ""
    if scope + name in names or name in names:
        return True
    return "::" in name and bool(robot.unresolved_includes)


def _joints_of(robot: Robot, link: str) -> list[str]:
    """Return the joints that carry a link."""
    return [joint.name.value for joint in robot.joints if joint.child.value == link]


_CLASSIC = """<gazebo>
  <plugin name="drive" filename="libgazebo_ros_diff_drive.so">
    <leftJoint>{}</leftJoint>{}
  </plugin>
</gazebo>
"""
GOOD = [
    """
<joint name="left" type="revolute"><parent>base_link</parent><child>base_link</child></joint>
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive"><left_joint>left</left_joint></plugin>
""",
    {"@urdf": _CLASSIC.format("shoulder", "")},
]
BAD = [
    {"@urdf": _CLASSIC.format("left_wheel_joint", "  <!-- ^ PLG004 -->")},
    """
<joint name="left_wheel_joint" type="revolute">
  <parent>base_link</parent><child>base_link</child>
</joint>
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive">
  <left_joint>left_wheel</left_joint>  <!-- ^ PLG004 -->
</plugin>
""",
    """
<link name="wheel"/>
<joint name="axle" type="revolute"><parent>base_link</parent><child>wheel</child></joint>
<plugin filename="libignition-gazebo-diff-drive-system.so"
        name="ignition::gazebo::systems::DiffDrive">
  <left_joint>wheel</left_joint>  <!-- ^ PLG004 -->
</plugin>
""",
    """
<plugin filename="libignition-gazebo-wheel-slip-system.so"
        name="ignition::gazebo::systems::WheelSlip">
  <wheel link_name="wheel_1"/>  <!-- ^ PLG004 -->
</plugin>
""",
]
