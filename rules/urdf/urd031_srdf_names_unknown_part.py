"""An SRDF that names links, joints or groups which its robot does not have.

MoveIt drops what names an unknown part, logs a line, and starts: a group is planned without the
joint, or is not there at all ("Group 'arm' was not found"); the pose or the end effector does not
exist; the links of a collision pair are checked against each other, and every start state may be
in collision. A virtual joint whose child is not the root of the robot is skipped: its frame is no
part of the robot, and a planar or floating base cannot be planned. Often links or joints were
renamed in the URDF alone.

An SRDF that a launch file loads, and whose robot has another name than that of the URDF, is a
warning: MoveIt logs "Semantic description is not specified for the same robot as the URDF".

A joint, a chain or a group that a group loses is an error where a launch file loads the SRDF. The
robot is that of the URDF that launch files load or that `.setup_assistant` names, and those with
the name of the SRDF; the name must be unknown in all of them, and not one that their xacro files
make with other arguments; <ros2_control> and <transmission> make none. Where no robot can be read,
nothing is reported. A `.srdf.xacro` is read without arguments; names that it computes are not
judged.

Fix: write the names of the URDF, or let MoveIt's setup assistant write the SRDF again. A virtual
joint: write the root link as `child_link`, or remove it.
Source: srdfdom, src/model.cpp; moveit_core, robot_model.cpp.
"""

from collections.abc import Iterable, Iterator, Sequence

from checker.base.words import Suggestions, count
from checker.formats.srdf.names import Loss, NamedPart, named_parts
from checker.robots.semantic import SemanticDescription
from checker.rule import Concern, Finding, Findings, Severity, finding, misspelt, rule
from checker.rulebook.example_parts import ARM, MOVEIT_LAUNCH

_MANY = 3
"""Names up to which each is a finding of its own."""
_SEVERE = (Loss.SUBGROUP, Loss.CHAIN, Loss.JOINT)
_EFFECTS = {
    Loss.SUBGROUP: "MoveIt drops group {!r}",
    Loss.CHAIN: "MoveIt drops the chain of group {!r}",
    Loss.JOINT: "MoveIt plans group {!r} without it",
    Loss.LINK: "MoveIt plans group {!r} without it",
    Loss.END_EFFECTOR: "MoveIt drops end effector {!r}",
    Loss.PARENT_GROUP: "MoveIt takes another group as parent of end effector {!r}",
    Loss.VIRTUAL_JOINT: "MoveIt drops virtual joint {!r}",
    Loss.STATE: "MoveIt drops pose {!r}",
    Loss.STATE_JOINT: "pose {!r} has no effect on it",
    Loss.PASSIVE_JOINT: "the element has no effect",
    Loss.PAIR: "the collision pair has no effect",
}


@rule("URD031", "srdf-names-unknown-part", Severity.ERROR, Concern.INTERFACE)
def check(semantic: SemanticDescription) -> Findings:
    """Report names of parts that the robot lacks, each once, and virtual joints off the root."""
    if not semantic.robots:
        return
    uses: dict[tuple[str, str], list[NamedPart]] = {}
    for part in named_parts(semantic.root):
        if semantic.lacks(part.kind, part.name.value):
            uses.setdefault((part.kind, part.name.value), []).append(part)
    worst = [sorted(same, key=lambda part: [*Loss].index(part.loss)) for same in uses.values()]
    for loss in Loss:
        lost = [same for same in worst if same[0].loss is loss]
        yield from _several(semantic, lost) if len(lost) > _MANY else _each(semantic, lost)
    yield from _beside_root(semantic)
    yield from _of_another_robot(semantic)


def _of_another_robot(semantic: SemanticDescription) -> Iterator[Finding]:
    """Report the name of a loaded SRDF that none of the robots has."""
    names = sorted({robot.name.value for robot in semantic.robots})
    stated = semantic.root.attribute("name")
    if stated is not None and semantic.is_loaded and semantic.robot not in names:
        yield finding(
            stated,
            f"the SRDF is for robot {semantic.robot!r}, but the URDF is robot {names[0]!r}: MoveIt "
            f'logs an error; write name="{names[0]}"',
            severity=Severity.WARNING,
        )


def _each(semantic: SemanticDescription, lost: Iterable[Sequence[NamedPart]]) -> Iterator[Finding]:
    for part, *others in lost:
        effect, known = _EFFECTS[part.loss].format(part.owner), semantic.names[part.kind]
        message = f"{_owner(semantic, part)} has no {part.kind} {part.name.value!r}: {effect}"
        near = Suggestions(sorted(known))
        severity = _severity(semantic, part)
        made = misspelt(part.name, message, near, severity=severity)
        yield finding(
            part.name,
            made.message,
            severity=severity,
            related=[(other.name, "named here as well") for other in others],
            fix=made.fix,
        )


def _several(
    semantic: SemanticDescription, lost: Sequence[Sequence[NamedPart]]
) -> Iterator[Finding]:
    part = lost[0][0]
    names = ", ".join(same[0].name.value for same in lost[:_MANY])
    places = [other.name for same in lost for other in same][1:]
    effect = _EFFECTS[part.loss].format(part.owner)
    yield finding(
        part.name,
        f"{_owner(semantic, part)} has no {part.kind}s {names} … "
        f"({count(len(lost), 'name')}): {effect}; write the names of the URDF, or let MoveIt's "
        "setup assistant write the SRDF again",
        severity=_severity(semantic, part),
        related=[(place, "named here as well") for place in places],
    )


def _owner(semantic: SemanticDescription, part: NamedPart) -> str:
    return "the SRDF" if part.kind == "group" else f"robot {semantic.robot!r}"


def _severity(semantic: SemanticDescription, part: NamedPart) -> Severity | None:
    return None if part.loss in _SEVERE and semantic.is_loaded else Severity.WARNING


def _beside_root(semantic: SemanticDescription) -> Iterator[Finding]:
    """Report virtual joints onto a link that is the root of none of the robots."""
    roots = {
        name
        for robot in semantic.robots
        for name in robot.links_by_name
        if name not in {joint.child.value for joint in robot.joints}
    }
    for joint in semantic.root.all("virtual_joint"):
        child = joint.attribute("child_link")
        name = child.value.strip() if child is not None else ""
        if child is None or name in roots or name not in semantic.names["link"] or len(roots) != 1:
            continue
        (root,) = roots
        needless = joint.get("type") == "fixed" and joint.get("parent_frame") == root
        cure = "remove it" if needless else f'remove it, or write child_link="{root}"'
        yield finding(
            child,
            f"link {name!r} of virtual joint {joint.get('name')!r} is not the root of robot "
            f"{semantic.robot!r}, which is {root!r}: MoveIt skips the joint; {cure}",
            severity=Severity.INFO if needless else Severity.WARNING,
        )


def _srdf(content: str, *, loaded: bool = True, urdf: str = ARM) -> dict[str, object]:
    return {
        "@urdf": True,
        "urdf/arm.urdf": urdf,
        "config/arm.srdf": f'<robot name="arm">\n{content}\n</robot>\n',
        **({"launch/plan.launch.py": MOVEIT_LAUNCH} if loaded else {}),
    }


def _group(part: str, more: str = "") -> str:
    return f'<group name="arm">\n{part}\n</group>{more}'


_BASE = '<virtual_joint name="fixture" type="fixed" parent_frame="world" child_link="{}"/>{}'
_PAIR = '<disable_collisions link1="base_link" link2="{}" reason="Never"/>{}'
_MARK = "  <!-- ^ URD031 -->"
_CONTROLLED = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:property name="z" value="0.1"/>
<xacro:macro name="wheel" params="at"><origin xyz="${at} 0 ${z}"/></xacro:macro>
<link name="base_link"/>
<ros2_control name="arm" type="system"><joint name="elbow"/></ros2_control>
</robot>
"""
_PREFIXED = """<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">
<xacro:arg name="prefix" default=""/>
<link name="$(arg prefix)base_link"/>
</robot>
"""


def _xacro(content: str, mark: str = "") -> dict[str, object]:
    """Return an SRDF that xacro expands."""
    head = '<robot name="arm" xmlns:xacro="http://www.ros.org/wiki/xacro">'
    macro = f'<xacro:macro name="arm" params="prefix">\n{content}{mark}\n</xacro:macro>'
    return {
        **_srdf(""),
        "config/arm.srdf": None,
        "config/arm.srdf.xacro": f'{head}\n{macro}\n<xacro:arm prefix="left_"/>\n</robot>\n',
    }


_ASSISTANT = """moveit_setup_assistant_config:
  urdf: {package: acme_arm_description, relative_path: urdf/arm.urdf}
  srdf: {relative_path: config/arm.srdf}
"""


def _named(name: str, mark: str = "") -> dict[str, object]:
    """Return an SRDF, loaded by its path, with the file of MoveIt's assistant."""
    return {
        **_srdf(""),
        ".setup_assistant": _ASSISTANT,
        "launch/plan.launch.py": "# loads config/arm.srdf\n",
        "config/arm.srdf": f'<robot name="{name}">{mark}\n<group name="all"/>\n</robot>\n',
    }


GOOD = [
    _named("arm"),
    _xacro('<group name="arm"><joint name="${prefix}shoulder"/></group>'),
    _srdf(_group('<joint name="shoulder"/>', _BASE.format("base_link", ""))),
    _srdf(_group('<joint name="fixture"/>', _BASE.format("base_link", ""))),
    _srdf(_group('<chain base_link="base_link" tip_link="upper_arm"/>')),
    _srdf(_PAIR.format("upper_arm", "")),
    {
        **_srdf('<passive_joint name="wrist"/>'),
        "config/arm.srdf": '<robot name="hand"><passive_joint name="wrist"/></robot>\n',
    },
    {
        **_srdf(_PAIR.format("left_base_link", "").replace('"base', '"left_base')),
        "urdf/arm.urdf": None,
        "urdf/arm.urdf.xacro": _PREFIXED,
        "launch/spawn.launch": None,
    },
    # Another package has a fuller robot of this name.
    {
        **_srdf(_group('<joint name="elbow"/>')),
        "../acme_arm/package.xml": "<package><name>acme_arm</name></package>",
        "../acme_arm/urdf/arm.urdf": ARM.replace("shoulder", "elbow"),
    },
]
BAD = [
    _named("lift", _MARK),
    _srdf(_group(f'<joint name="sholder"/>{_MARK}')),
    _srdf(_group(f'<joint name="elbow"/>{_MARK}'), loaded=False),
    _srdf(_group(f'<link name="hand"/>{_MARK}')),
    _srdf(_group(f'<chain base_link="base_link" tip_link="tool"/>{_MARK}')),
    _srdf(_group(f'<group name="hand"/>{_MARK}')),
    _srdf(_PAIR.format("lower_arm", _MARK)),
    _srdf("\n".join(_PAIR.format(f"a{i}", "" if i else _MARK) for i in range(5))),
    _srdf(f'<end_effector name="hand" group="hand" parent_link="upper_arm"/>{_MARK}'),
    _srdf(f'<passive_joint name="wrist"/>{_MARK}'),
    _srdf(
        _group(
            '<joint name="shoulder"/>',
            f'\n<group_state name="home" group="arm">\n<joint name="elbow" value="0"/>{_MARK}\n'
            "</group_state>",
        )
    ),
    _srdf(_BASE.format("upper_arm", _MARK)),
    _xacro('<group name="arm"><joint name="elbow"/></group>', _MARK),
    {
        **_srdf(_group(f'<joint name="elbow"/>{_MARK}')),
        "urdf/arm.urdf": None,
        "urdf/arm.urdf.xacro": _CONTROLLED,
        "launch/spawn.launch": None,
    },
]
