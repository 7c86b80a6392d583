"""A joint whose parent or child does not exist.

The simulator refuses the whole model, or drops the joint and the part falls off.

No accepted package that we checked has this fault.

Fix: name a link of the model exactly as in its `name` attribute.
Source: SDFormat specification, joint/parent and joint/child.
"""

from checker.base.words import Suggestions
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, misspelt, rule, unchecked
from checker.source.text import Located


@rule("KIN001", "unknown-joint-link", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report joints whose parent or child is missing or does not exist."""
    for uri in robot.unresolved_includes:
        yield unchecked(f"{uri.value or 'an include without <uri>'} is included, but not available")
    names = robot.attachable_names
    suggestions = Suggestions(names)
    for joint in robot.joints:
        for role, end in (("parent", joint.parent), ("child", joint.child)):
            if _exists(robot, joint, role, end) or robot.may_be_included(end.value):
                continue
            phrase = f"{role} {end.value!r}, which does not exist" if end.value else f"no {role}"
            yield misspelt(end, f"joint {joint.name.value!r} has {phrase}", suggestions)


def _exists(robot: Robot, joint: Joint, role: str, end: Located[str]) -> bool:
    # Without frames, `world` is a link like any other.
    if end.value == "world" and role == "parent" and robot.conventions.has_frames:
        return True
    return joint.scope + end.value in robot.attachable_names


_XACRO = 'xmlns:xacro="http://www.ros.org/wiki/xacro"'
_MAST = f"""<robot name="mast" {_XACRO}>
<link name="mast"/>
<joint name="mount" type="fixed"><parent link="upper_arm"/><child link="mast"/></joint>
</robot>
"""
GOOD = [
    {
        # A part of a robot, which another file includes by a computed name.
        "@urdf": True,
        "urdf/sensor_mast.xacro": _MAST,
        "urdf/whole.xacro": f"""<robot name="whole" {_XACRO}>
<xacro:property name="kind" value="mast"/>
<link name="upper_arm"/>
<xacro:include filename="sensor_${{kind}}.xacro"/>
</robot>
""",
    },
    """
<link name="wheel"/>
<joint name="axle" type="revolute"><parent>base_link</parent><child>wheel</child></joint>
""",
]
BAD = [
    {
        "@urdf": True,
        "urdf/sensor_mast.xacro": _MAST.replace(
            'upper_arm"/>', 'upper_arm"/>  <!-- ^ KIN001 -->\n'
        ),
    },
    """
<link name="front_wheel"/>
<joint name="axle" type="revolute">
  <parent>base_link</parent>
  <child>frontwheel</child>  <!-- ^ KIN001 -->
</joint>
""",
    """
<joint name="axle" type="fixed">  <!-- ^ KIN001 -->
  <parent>base_link</parent>
</joint>
""",
]
