"""A joint with the name of a link.

In URDF, RViz and the ROS tools, a joint and a link may have the same name. In SDF they may not:
once Gazebo has converted the file, libsdformat refuses the model, and nothing is spawned. The name
of a fixed joint that Gazebo merges does not count. In a URDF without a `<gazebo>` element, or where
the workspace starts something else than Gazebo, this is a warning; an info if no launch file of the
workspace gives it to a simulator.

Fix: give the joint its own name, such as `arm_joint`, also in controllers and transmissions.
Source: SDFormat 1.7, "unique sibling names"; tried with libsdformat 12: "Joint with non-unique name
detected in model".
"""

from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.fixed_joints import Lumping
from checker.package.package import Package
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("URD016", "joint-named-as-link", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription, package: Package) -> Findings:
    """Report joints that share their name with a link, once Gazebo has merged fixed joints."""
    if description.for_rviz:
        return
    robot, lumping = description.robot, Lumping(description)
    severity = Severity.INFO if robot.shown_only else Severity.WARNING
    starts = package.workspace.may_start_gazebo
    gone = {joint.name.value for joint in lumping.merged.values()}
    for joint in robot.joints:
        link = robot.links_by_name.get(joint.name.value)
        if link is None or joint.name.value in gone or link.name.value in lumping.merged:
            continue
        yield finding(
            joint.name,
            f"joint {joint.name.value!r} has the name of a link: Gazebo refuses the model",
            severity=None if robot.is_for_gazebo and starts else severity,
            related=[(link, "the link")],
        )


def _robot(joint: str, kind: str, mark: str = "", gazebo: str = "<gazebo/>") -> dict[str, object]:
    text = f'''<robot name="arm">
<link name="base_link"/>
<link name="hand"/>
<joint name="{joint}" type="{kind}">{mark}
  <parent link="base_link"/><child link="hand"/>
</joint>
{gazebo}
</robot>
'''
    return {"@urdf": True, "urdf/arm.urdf": text}


_KEPT = '<gazebo reference="hand"><preserveFixedJoint>true</preserveFixedJoint></gazebo>'
_MARK = "  <!-- ^ URD016 -->"
GOOD = [
    _robot("hand_joint", "continuous"),
    _robot("hand", "fixed"),
]
BAD = [
    _robot("hand", "continuous", _MARK),
    _robot("hand", "continuous", _MARK, gazebo=""),
    _robot("base_link", "continuous", _MARK),
    _robot("base_link", "fixed", _MARK, _KEPT.replace("hand", "base_link")),
]
