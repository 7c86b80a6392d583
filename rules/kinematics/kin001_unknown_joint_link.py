"""A joint whose parent or child does not exist.

The simulator refuses the whole model, or drops the joint and the part falls off. In a static model
nothing falls: for Gazebo Classic, which only drops the joint, it is a warning, and so it is in a
file of SDF 1.6 or older where the profile names no Gazebo release.

No accepted package that we checked has this fault.

Fix: name a link of the model exactly as in its `name` attribute.
Source: SDFormat specification, joint/parent and joint/child.
"""

from checker.base.words import Suggestions
from checker.formats.sdf.document import parse_version
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.rule import Concern, Context, Findings, Severity, misspelt, rule, unchecked
from checker.source.text import Located


@rule("KIN001", "unknown-joint-link", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report joints whose parent or child is missing or does not exist."""
    severity = Severity.WARNING if _is_static_in_classic(robot, context.release) else None
    for uri in robot.unresolved_includes:
        yield unchecked(f"{uri.value or 'an include without <uri>'} is included, but not available")
    names = robot.attachable_names
    suggestions = Suggestions(names)
    for joint in robot.joints:
        for role, end in (("parent", joint.parent), ("child", joint.child)):
            if _exists(robot, joint, role, end) or robot.may_be_included(end.value):
                continue
            phrase = f"{role} {end.value!r}, which does not exist" if end.value else f"no {role}"
            message = f"joint {joint.name.value!r} has {phrase}"
            yield misspelt(end, message, suggestions, severity=severity)


def _is_static_in_classic(robot: Robot, release: str) -> bool:
    # From SDF 1.7 on libsdformat resolves the ends of joints itself, and refuses the model.
    is_old = (parse_version(robot.version) or _RESOLVING) < _RESOLVING
    return robot.is_static and (release == "classic" or (not release and is_old))


_RESOLVING = (1, 7)


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
