"""Joints that do not form a tree: a link is its own parent, has two parents or is in a loop.

Simulators place each link by the one joint above it. If a link has a second joint above it, Gazebo
reports that the link already has a parent and drops the joint. A loop has no root link. RViz and
robot_state_publisher read the file: for them the joint written last is the one above the link, and
the transforms of the others are wrong or missing; so where no simulator is started, a second parent
is a warning. Gazebo Classic simulates both in models of SDF, and nothing moves in a static model:
there they are infos. No accepted package that we checked has this fault.

Fix: remove the extra joint, or swap its parent and child. Where each joint is an axis of one link,
as of an eye that turns and nods, put a link between them: parent, axis, link, axis, child.
Source: gz-physics, DART's tree of bodies; SDFormat: a joint's parent and child must differ;
urdfdom, `ModelInterface::initTree`: a later joint replaces the parent without a message.
"""

from collections.abc import Iterator

from checker.base.words import and_list
from checker.model.robot import Robot
from checker.model.tree import LinkTree, Tie
from checker.rule import Concern, Context, Finding, Findings, Severity, finding, rule


@rule("KIN002", "not-a-tree", Severity.ERROR, Concern.ROBOT)
def check(robot: Robot, context: Context) -> Findings:
    """Report joints that connect a link to itself or give it a second parent."""
    for tie in robot.tree.ties:
        if tie.parent == tie.child:
            yield finding(
                tie.joint, f"joint {tie.joint.name.value!r} connects {tie.child!r} to itself"
            )
    severity = _severity(robot, context)
    is_shown = robot.shown_only and severity is None
    yield from _second_parents(robot.tree, Severity.WARNING if is_shown else severity)
    yield from _loops(robot.tree, severity)


def _severity(robot: Robot, context: Context) -> Severity | None:
    """Return the severity of what only a simulator with trees of bodies refuses."""
    of_classic = context.release == "classic" and not robot.conventions.is_urdf
    if robot.is_static or of_classic:
        return Severity.INFO
    # A file that is made for no simulator may hold loops: SDFormat itself allows them.
    return None if context.release else Severity.WARNING


def _second_parents(tree: LinkTree, severity: Severity | None) -> Iterator[Finding]:
    for child, (first, *others) in tree.ties_above.items():
        if not others:
            continue
        names = and_list([repr(tie.joint.name.value) for tie in (first, *others)])
        yield finding(
            others[0].joint,
            f"link {child!r} is the child of {1 + len(others)} joints: {names}; a link has one "
            "joint above it: put a link between two axes",
            severity=severity,
            related=[
                (first.joint, "the first joint above it"),
                *((tie.joint, "another joint above it") for tie in others[1:]),
            ],
        )


def _loops(tree: LinkTree, severity: Severity | None) -> Iterator[Finding]:
    for loop in tree.loops():
        names = [tie.child for tie in loop]
        circle = " → ".join([*names[:6], "…"] if len(names) > 6 else [*names, names[0]])
        yield finding(
            _last_written(loop).joint,
            f"the joints connect links in a loop: {circle}",
            severity=severity,
        )


def _last_written(loop: list[Tie]) -> Tie:
    """Return the joint that closes the loop, in the order of the file."""
    return max(loop, key=lambda tie: tie.joint.span.start)


def _joints(*ends: tuple[str, str, str]) -> str:
    return '<link name="arm"/>\n<link name="hand"/>\n' + "\n".join(
        f'<joint name="{parent}_{child}" type="fixed">{mark}\n'
        f"<parent>{parent}</parent><child>{child}</child></joint>"
        for parent, child, mark in ends
    )


_MARK = "  <!-- ^ KIN002 -->"
GOOD = [
    _joints(("base_link", "arm", ""), ("arm", "hand", "")),
    _joints(("world", "base_link", ""), ("base_link", "arm", ""), ("base_link", "hand", "")),
]
BAD = [
    _joints(("base_link", "base_link", _MARK)),
    _joints(("base_link", "arm", ""), ("hand", "arm", _MARK)),
    _joints(("base_link", "arm", ""), ("hand", "arm", _MARK), ("base_link", "arm", "")),
    _joints(("arm", "hand", ""), ("hand", "arm", _MARK)),
]
