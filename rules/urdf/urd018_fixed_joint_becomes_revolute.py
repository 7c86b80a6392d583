"""A fixed joint that Gazebo turns into a revolute joint with both limits at 0.

`<disableFixedJointLumping>` alone keeps the link, but not the joint: libsdformat writes a revolute
joint with the limits 0 and 0. This adds a degree of freedom, which moves under load, and the joint
appears in the joint states.

Fix: write `<preserveFixedJoint>`, which keeps the link, and the joint fixed.
Source: libsdformat, parser_urdf.cc; sdformat issue 131; tried with libsdformat 12.
"""

from checker.finding import Fix
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.extensions import extension_flag
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.xml import Element

_HINGE, _KEPT = "disableFixedJointLumping", "preserveFixedJoint"


@rule("URD018", "fixed-joint-becomes-revolute", Severity.WARNING, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report fixed joints that are kept from lumping and not preserved."""
    if description.for_rviz:
        return
    joints = description.robot.joints_by_name
    kept = {tag.reference.value for tag in description.gazebo if extension_flag(tag.element, _KEPT)}
    for tag in description.gazebo:
        name = tag.reference.value
        fixed = name in joints and joints[name].type.value == "fixed"
        if not fixed or name in kept or not extension_flag(tag.element, _HINGE):
            continue
        hinge = tag.element.child(_HINGE)
        yield finding(
            hinge or tag,
            f"fixed joint {name!r} becomes a revolute joint with both limits at 0 in Gazebo: "
            "write <preserveFixedJoint>",
            key="hinge",
            fix=_renaming_fix(hinge),
        )


def _renaming_fix(hinge: Element | None) -> Fix | None:
    if hinge is None:
        return None
    names = (hinge.name_span, hinge.end_name_span)
    return Fix(Safety.UNSAFE, tuple(name.replacement(_KEPT) for name in names if name is not None))


def _robot(tag: str, kind: str = "fixed") -> dict[str, object]:
    text = f'''<robot name="arm">
<link name="base_link"/>
<link name="hand"/>
<joint name="hand_joint" type="{kind}">
  <parent link="base_link"/><child link="hand"/>
</joint>
<gazebo reference="hand_joint">
{tag}
</gazebo>
</robot>
'''
    return {"@urdf": True, "urdf/arm.urdf": text}


_LUMPED = "<disableFixedJointLumping>true</disableFixedJointLumping>"
GOOD = [
    _robot(f"<preserveFixedJoint>true</preserveFixedJoint>{_LUMPED}"),
    _robot(_LUMPED.replace("true", "false")),
    _robot(_LUMPED, "continuous"),
]
BAD = [_robot(f"{_LUMPED}  <!-- ^ URD018 -->")]
