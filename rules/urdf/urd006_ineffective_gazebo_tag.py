"""A `gazebo` tag for a link or joint that does not exist, or one without effect.

Gazebo prints no message: the friction, the sensor or the colour is missing. A tag that would only
change a colour or contacts, such as a friction, is a warning, and so is one in a file of macros,
whose user may have the link. It is an info where all that the tag has are the defaults of contacts,
such as a friction of 1 and no slip, where no launch file of the workspace starts anything, as in
the examples of a library of dynamics, and for a link below an `xacro:if` that is false. A sensor
under a joint is an error, as Gazebo makes none. A `<ros2_control>` inside a `<gazebo>` is not read,
so controllers find no joints.

Fix: write the exact name of the link or joint; put elements for links under a link, and elements
for joints under a joint; put `<ros2_control>` directly into `<robot>`.
Source: Gazebo Classic, "Using a URDF in Gazebo": elements for `<robot>`, `<link>` and `<joint>`;
ros2_control, hardware_interface/src/component_parser.cpp: tags directly below `<robot>`.
"""

from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.words import Suggestions
from checker.finding import Fix
from checker.formats.urdf.description import GazeboTag, UrdfDescription
from checker.formats.urdf.extensions import OF_JOINTS, OF_LINKS, simulates, states_defaults
from checker.formats.xacro.expanded import ExpandedText
from checker.formats.xacro.names import BRACES
from checker.model.robot import Robot
from checker.package.package import Package
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    finding,
    misspelt,
    rename,
    rule,
)

_OF_MODEL = {"static"}
"""Elements about the whole model; where the link exists, URD028 reports them."""


@rule("URD006", "ineffective-gazebo-tag", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription, package: Package, context: Context) -> Findings:
    """Report `<gazebo>` tags that refer to nothing, and elements without effect."""
    if description.for_rviz:
        return
    in_gazebo = context.is_gazebo_alone or package.workspace.may_start_gazebo
    is_read = context.is_gazebo_alone or not description.robot.shown_only
    for found in _faults(description, in_gazebo=in_gazebo):
        yield found if is_read else replace(found, severity=Severity.INFO)


def _faults(description: UrdfDescription, *, in_gazebo: bool) -> Iterator[Finding]:
    robot = description.robot
    names = Suggestions([*robot.links_by_name, *robot.joints_by_name])
    # The robot that calls a macro may have more links.
    is_whole = description.call is None
    for tag in description.gazebo:
        name = tag.reference.value
        known = name in robot.links_by_name or name in robot.joints_by_name
        if not known and BRACES.search(name):
            continue  # URD001 reports it
        if tag.reference.stated and not known and name in _optional_names(description):
            message = f"<gazebo> refers to {name!r}, which the xacro makes under a condition"
            yield finding(tag.reference, message, severity=Severity.INFO, key=name)
        elif tag.reference.stated and not known:
            yield _misnamed(tag, robot, names, is_whole=is_whole)
        else:
            yield from _useless(tag, robot, in_gazebo=in_gazebo)


def _misnamed(tag: GazeboTag, robot: Robot, names: Suggestions, *, is_whole: bool) -> Finding:
    name = tag.reference.value
    if {child.tag for child in tag.element.children} == _OF_MODEL:
        message = (
            f"<static> has no effect in <gazebo reference={name!r}>: it is about the whole model: "
            "write it in a <gazebo> without reference"
        )
        return finding(tag.reference, message, severity=Severity.WARNING, key="static")
    found = misspelt(
        tag.reference,
        f"<gazebo> refers to {name!r}, which is not a link or joint",
        names,
        severity=_severity(tag, is_whole=is_whole),
        key=name,
    )
    return replace(found, fix=found.fix or _with_ending(tag, robot))


def _severity(tag: GazeboTag, *, is_whole: bool) -> Severity | None:
    if states_defaults(tag.element):
        return Severity.INFO
    return None if is_whole and simulates(tag.element) else Severity.WARNING


def _with_ending(tag: GazeboTag, robot: Robot) -> Fix | None:
    """Return the fix that writes `base_link` for `base`, where the tag is for a link."""
    link = f"{tag.reference.value}_link"
    is_for_link = all(child.tag in OF_LINKS for child in tag.element.children)
    return rename(tag.reference, link) if is_for_link and link in robot.links_by_name else None


def _optional_names(description: UrdfDescription) -> set[str | None]:
    """Return the names of links and joints below a condition of the files that are read."""
    source = description.document.source
    return {
        part.get("name")
        for document in (source.read if isinstance(source, ExpandedText) else ())
        for condition in document.elements
        if condition.tag in ("xacro:if", "xacro:unless")
        for part in condition.descendants()
        if part.tag in ("link", "joint")
    }


def _useless(tag: GazeboTag, robot: Robot, *, in_gazebo: bool) -> Iterator[Finding]:
    if not tag.element.children:
        yield finding(tag, "<gazebo> is empty", severity=Severity.INFO, key="nothing")
        return
    name = tag.reference.value
    for child in tag.element.children:
        if child.tag == "self_collide" and not tag.reference.stated:
            continue  # becomes a part of the model
        if child.tag == "ros2_control":
            yield finding(
                child,
                "<ros2_control> inside <gazebo> is not read, so controllers do not find its "
                "joints: move it directly into <robot>",
            )
            continue
        if not tag.reference.stated and child.tag in OF_LINKS | OF_JOINTS:
            what = "a link" if child.tag in OF_LINKS else "a joint"
            message = f"<{child.tag}> has no effect in a <gazebo> without the reference of {what}"
        elif child.tag in OF_JOINTS and name and name not in robot.joints_by_name:
            message = f"<{child.tag}> is for a joint, but {name!r} is a link"
        elif child.tag == "sensor" and child.get("type") == "force_torque":
            continue  # measures at a joint
        elif child.tag in OF_LINKS and name and name not in robot.links_by_name:
            message = f"<{child.tag}> is for a link, but {name!r} is a joint"
        else:
            continue
        lost = child.tag == "sensor" and in_gazebo
        yield finding(child, message, severity=None if lost else Severity.WARNING)


def _tag(inside: str, reference: str = "") -> dict[str, str]:
    attribute = f' reference="{reference}"' if reference else ""
    return {"@urdf": f"<gazebo{attribute}>\n{inside}\n</gazebo>"}


_MARK = "  <!-- ^ URD006 -->"
_PLUGIN = '<plugin name="p" filename="libgazebo_ros_control.so"/>'
_TOOL = """<robot name="tool" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:macro name="tool" params="parent">
<link name="tool"/>
<joint name="mount" type="fixed"><parent link="${parent}"/><child link="tool"/></joint>
</xacro:macro>
<gazebo reference="@"><mu1>1</mu1></gazebo>%
</robot>
"""


def _macro(reference: str, mark: str = "") -> dict[str, object]:
    return {
        "@urdf": True,
        "urdf/tool.xacro": _TOOL.replace("@", reference).replace("%", mark),
    }


_MAST = f"""<robot name="mast" xmlns:xacro="http://ros.org/wiki/xacro">
<link name="base"/>
<xacro:if value="false"><link name="mast"/></xacro:if>
<gazebo reference="mast"><mu1>1</mu1></gazebo>{_MARK}
</robot>
"""
GOOD = [
    {"@urdf": True},
    _macro("tool"),
    _tag("<mu1>1</mu1><own_extension/>", "upper_arm"),
    _tag('<sensor name="s" type="force_torque"/>', "shoulder"),
    _tag("<provideFeedback>true</provideFeedback>", "shoulder"),
    _tag("<static>true</static>" + _PLUGIN),
    {"urdf/rviz.urdf": '<robot name="r"><link name="a"/><gazebo reference="b"/></robot>'},
]
BAD = [
    {"@urdf": f'<gazebo reference="World">{_MARK}\n<static>true</static>\n</gazebo>'},
    {"@urdf": True, "urdf/mast.urdf.xacro": _MAST},
    _macro("toool", _MARK),
    {"@urdf": f'<gazebo reference="uper_arm">{_MARK}\n<mu1>1</mu1>\n</gazebo>'},
    _tag(f"<mu1>1</mu1>{_MARK}"),
    _tag(f"<stopErp>0.2</stopErp>{_MARK}", "upper_arm"),
    _tag(f'<sensor name="eye" type="camera"/>{_MARK}', "shoulder"),
    _tag(f"<selfCollide>true</selfCollide>{_MARK}", "shoulder"),
    {"@urdf": f'<gazebo reference="upper_arm"/>{_MARK}'},
    _tag(f'<ros2_control name="arm" type="system">{_MARK}\n</ros2_control>'),
]
