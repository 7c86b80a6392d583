"""Joints that do not make a tree: a link tied to itself, with two parents, or in a loop.

Simulators place each link by the one joint above it. Of a second joint above a link, Gazebo says
that the link has a parent already and drops it; a loop has no link to begin with.
No accepted package at hand shows it.

Fix: remove the joint that is too much, or swap its parent and child.
Source: gz-physics, DART's tree of bodies; SDFormat: a joint's parent and child must differ.
"""

from collections.abc import Iterator

from checker.model.robot import Robot
from checker.model.tree import LinkTree, Tie
from checker.rule import Context, Finding, Findings, Severity, finding, rule


@rule("KIN002", "joints-make-no-tree", Severity.ERROR)
def check(robot: Robot, context: Context) -> Findings:
    """Report joints by which links hang on themselves or on two links."""
    for tie in robot.tree.ties:
        if tie.parent == tie.child:
            yield finding(tie.joint, f"joint {tie.joint.name.value!r} ties {tie.child!r} to itself")
    # A file that is made for no simulator may hold loops: SDFormat itself allows them.
    severity = None if context.release else Severity.WARNING
    yield from _second_parents(robot.tree, severity)
    yield from _loops(robot.tree, severity)


def _second_parents(tree: LinkTree, severity: Severity | None) -> Iterator[Finding]:
    for child, (first, *others) in tree.above.items():
        for other in others:
            yield finding(
                other.joint,
                f"joint {other.joint.name.value!r} hangs {child!r} on {other.parent!r}, but it "
                f"hangs on {first.parent!r} already",
                severity=severity,
                related=[(first.joint, "the first joint above it")],
            )


def _loops(tree: LinkTree, severity: Severity | None) -> Iterator[Finding]:
    for loop in tree.loops():
        names = [tie.child for tie in loop]
        circle = " → ".join([*names[:6], "…"] if len(names) > 6 else [*names, names[0]])
        yield finding(
            _last_written(loop).joint,
            f"the joints hang links on one another in a loop: {circle}",
            severity=severity,
        )


def _last_written(loop: list[Tie]) -> Tie:
    """Return the tie that closed the loop, going by the order of the file."""
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
    _joints(("arm", "hand", ""), ("hand", "arm", _MARK)),
]
