"""A link that no joint connects to the robot.

The link falls off when the simulation starts, or lies inside the robot and pushes it around. None
of the accepted packages that we checked shows this.

Fix: add a joint between the robot and the link, usually `<joint type="fixed">`; or remove the link.
Source: SDFormat specification: links of a model move freely unless joints connect them.
"""

from checker.base.words import Suggestions
from checker.model.components import Joint
from checker.model.robot import Robot
from checker.model.tree import LinkTree
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked

_NOTE = "the rest of the robot starts here"


@rule("KIN003", "link-tied-to-nothing", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report links, and groups of links, that no joint connects to the robot."""
    tree = robot.tree
    # A group without a link at its top is a loop; that, and ties to itself, are for KIN002.
    tops = {top: group for group in tree.groups if (top := _top(tree, group))}
    if len(tops) < 2 or robot.is_static:
        return
    main = max(tops, key=lambda top: len(tops[top]))
    excused, unclear = _tied_by_broken_joints(tree)
    excused |= {tie.child for tie in tree.ties if tie.parent == tie.child}
    for top, group in tops.items():
        # A nested model that nothing ties is a robot of its own; SDF010 speaks of it.
        if top == main or "::" in top or not excused.isdisjoint(group):
            continue
        if unclear is not None:
            yield unchecked(f"it is not known which link joint {unclear.name.value!r} connects")
            return
        others = f" and the {len(group) - 1} below it" if len(group) > 1 else ""
        yield finding(
            tree.links[top],
            f"no joint connects link {top!r}{others} to the robot",
            key="loose",
            related=[(tree.links[main], _NOTE)],
        )


def _tied_by_broken_joints(tree: LinkTree) -> tuple[set[str], Joint | None]:
    """Return links at joints with an unknown end, which KIN001 reports.

    The second value is a joint whose intended link is not known.
    """
    suggestions = Suggestions(tree.links)
    meant = {tie.known for tie in tree.broken if tie.known is not None}
    unclear = None
    for tie in tree.broken:
        near = suggestions.near(tie.joint.scope + tie.missing.value)
        if near is None:
            unclear = tie.joint
        else:
            meant.add(near)
    return meant, unclear


def _top(tree: LinkTree, group: list[str]) -> str | None:
    """Return the first link of a group that has no parent."""
    return next((name for name in group if name not in tree.above), None)


GOOD = [
    """
<link name="mast"/>
<joint name="mast_joint" type="fixed"><parent>base_link</parent><child>mast</child></joint>
""",
    """
<link name="mast"/>
<joint name="foot" type="fixed"><parent>world</parent><child>mast</child></joint>
<joint name="base" type="fixed"><parent>world</parent><child>base_link</child></joint>
""",
    '<model name="arm"><link name="hand"/></model>',
]
BAD = [
    """
<link name="toolbox"/>  <!-- ^ KIN003 -->
""",
    """
<link name="arm"/>
<joint name="shoulder" type="fixed"><parent>base_link</parent><child>arm</child></joint>
<link name="lens"/>
<link name="camera"/>  <!-- ^ KIN003 -->
<joint name="ring" type="fixed"><parent>camera</parent><child>lens</child></joint>
<link name="hook"/>
<joint name="tip" type="fixed"><parent>arm</parent><child>hook</child></joint>
""",
]
