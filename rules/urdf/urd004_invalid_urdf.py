"""A joint or link that URDF readers refuse.

URDF readers refuse the whole robot: RViz shows nothing, and spawn_model ends with an error. URDF
requires a tree of links with one root, and effort and velocity limits for each joint that moves.

A package of ROS 2 may still contain launch files of ROS 1: a file of macros that only these load is
checked by a call of its macro.

In URDF packages, KIN001 to KIN003 report links that do not exist, loops and disconnected links.

Fix: correct the joint that the message names.
Source: URDF specification, joint: "parent", "child" and, for revolute and prismatic ones, "limit"
are required; urdfdom, `parseJoint`, `ModelInterface::initTree`, `initRoot`.
"""

from collections import Counter
from collections.abc import Iterator

from checker.base.words import Suggestions
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import has_version
from checker.model.components import Joint, Link
from checker.model.robot import Robot
from checker.rule import Concern, Finding, Findings, Severity, finding, misspelt, rule

TYPES = ("continuous", "fixed", "floating", "planar", "prismatic", "revolute")
LIMITED = ("prismatic", "revolute")


@rule("URD004", "invalid-urdf", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report what prevents a description from being read as a tree of links."""
    robot = description.robot
    if not robot.links:
        yield finding(robot, "the description has no link: RViz, Gazebo and Pinocchio refuse it")
        return
    if not robot.name.value:
        yield finding(robot, "the robot has no name: RViz, Gazebo and Pinocchio refuse it")
    optional = has_version(description.document, "1.2")
    for joint in robot.joints:
        yield from _type_and_limit(joint, optional=optional)
    for part in (robot.links, robot.joints):
        yield from _repeated_names(part)
    # The robot that other rules see is the SDF model here, so no other rule reads these.
    if description.for_rviz:
        yield from _ends(robot)
        yield from _tree(robot)


def _type_and_limit(joint: Joint, *, optional: bool) -> Iterator[Finding]:
    name, kind = joint.name.value, joint.type.value
    if kind not in TYPES:
        phrase = f"has the type {kind!r}" if kind else "has no type"
        yield finding(joint.type, f"joint {name!r} {phrase}, expected one of {', '.join(TYPES)}")
    if kind not in LIMITED:
        return
    limit = joint.element.child("limit")
    if limit is None:
        message = f"{kind} joint {name!r} has no <limit>, expected one with effort and velocity"
        yield finding(joint, message)
        return
    missing = [name for name in ("effort", "velocity") if limit.get(name) is None]
    if missing and not optional:
        yield finding(limit.span, f"<limit> of joint {name!r} has no {' and no '.join(missing)}")


def _repeated_names(parts: tuple[Link, ...] | tuple[Joint, ...]) -> Iterator[Finding]:
    counts = Counter(part.name.value for part in parts)
    seen: dict[str, Link | Joint] = {}
    for part in parts:
        name = part.name.value
        if counts[name] > 1 and name in seen:
            yield finding(
                part.name,
                f"{part.element.tag} {name!r} occurs {counts[name]} times, expected once",
                key=f"{part.element.tag} {name}",
                related=[(seen[name].name, "the first one")],
            )
        seen.setdefault(name, part)


def _ends(robot: Robot) -> Iterator[Finding]:
    names = Suggestions(robot.links_by_name)
    for joint in robot.joints:
        for role, end in (("parent", joint.parent), ("child", joint.child)):
            if end.value not in robot.links_by_name:
                phrase = (
                    f"the {role} {end.value!r}, which is not a link" if end.value else f"no {role}"
                )
                yield misspelt(end, f"joint {joint.name.value!r} has {phrase}", names)


def _tree(robot: Robot) -> Iterator[Finding]:
    above: dict[str, Joint] = {}
    for joint in robot.joints:
        child = joint.child.value
        if child in above:
            yield finding(
                joint,
                f"link {child!r} is the child of two joints, expected one",
                related=[(above[child], "the other joint")],
            )
        above.setdefault(child, joint)
    if not robot.links:
        return
    roots = [link for link in robot.links if link.name.value not in above]
    if not roots:
        yield finding(robot.links[0], "every link is the child of a joint: the joints form a loop")
    for extra in roots[1:]:
        yield finding(
            extra,
            f"link {extra.name.value!r} has no parent, like {roots[0].name.value!r}: a robot has "
            "only one root",
            related=[(roots[0], "the first root")],
        )


_FILE = "urdf/robot_from_sdf.xacro"
_LIMIT = '<limit lower="0" upper="1" effort="1" velocity="1"/>'
_LINKS = '<link name="base"/>\n<link name="arm"/>\n'


def _robot(body: str) -> dict[str, str]:
    return {_FILE: f'<robot name="rover">\n{_LINKS}{body}</robot>\n'}


def _joint(inside: str, kind: str = "revolute", name: str = "j", mark: str = "") -> str:
    return f'<joint name="{name}" type="{kind}">{mark}\n{inside}\n</joint>\n'


_MARK = "  <!-- ^ URD004 -->"
_ROS_2 = """<package format="3">
  <name>acme_arm_description</name>
  <buildtool_depend>ament_cmake</buildtool_depend>
</package>
"""


def _macro(mark: str = "", manifest: str = "") -> dict[str, object]:
    """Return a file with only a macro, and a launch file of ROS 1 that loads it."""
    changed = {"package.xml": manifest} if manifest else {}
    return {
        "@urdf": True,
        "launch/cart.launch": (
            '<launch><param name="robot_description" '
            'command="xacro $(find acme_arm_description)/urdf/cart.xacro"/></launch>\n'
        ),
        "urdf/cart.xacro": f"""<robot name="cart" xmlns:xacro="http://ros.org/wiki/xacro">{mark}
<xacro:macro name="cart" params="parent">
<link name="${{parent}}"/>
<link name="box"/>
<joint name="j" type="fixed"><parent link="${{parent}}"/><child link="box"/></joint>
</xacro:macro>
<gazebo reference="box"><mu1>1</mu1></gazebo>
</robot>
""",
        **changed,
    }


_ENDS = '<parent link="base"/><child link="arm"/>'
GOOD = [
    _macro(manifest=_ROS_2),
    _robot(_joint(_ENDS + _LIMIT)),
    _robot(_joint(_ENDS, "continuous")),
    {"@urdf": True},
    {
        "@urdf": True,
        "config/arm.srdf.xacro": (
            '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">\n'
            '<group name="arm"><joint name="shoulder"/></group></robot>\n'
        ),
    },
]
BAD = [
    _macro(_MARK),
    _robot(_joint(_ENDS, mark=_MARK)),
    _robot(_joint(f'{_ENDS}\n<limit lower="0" upper="1"/>{_MARK}')),
    _robot(_joint(_ENDS, "hinge", mark=_MARK)),
    _robot(_joint(_ENDS, "fixed") + _joint(_ENDS, "fixed", "k", _MARK)),
    _robot(_joint(_ENDS, "fixed") + f'<link name="arm"/>{_MARK}\n'),
    _robot(_joint(_ENDS, "fixed") + f'<link name="mast"/>{_MARK}\n'),
    _robot(
        _joint(_ENDS, "fixed")
        + _joint(f'<parent link="base"/>\n<child link="am"/>{_MARK}', "fixed", "k")
    ),
    {"@urdf": _joint('<parent link="base_link"/><child link="hand"/>', mark=_MARK)},
]
