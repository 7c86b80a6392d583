"""A body that touches its own fixed base.

MuJoCo leaves out contacts between a body and its parent, but **not if the parent is welded to the
world**: the base of an arm on the floor collides with its first link. The contact pushes from the
first step on, or stops the joint on its way.

Fix: add `<contact><exclude body1="BASE" body2="LINK"/></contact>`.
Source: MuJoCo 4.0.0, tried; documentation, Computation, "Collision detection".
"""

from checker.finding import Fix
from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.xml_insertion import append_to

_DEPTH = 0.001


@rule("MJC009", "static-parent-collides", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, depth: float = _DEPTH) -> Findings:
    """Report bodies that overlap their parent at the start, where the parent cannot move.

    Options:
        depth: Metres by which they overlap.
    """
    compiled = model.compiled
    for (parent, child), overlap in model.overlaps.items():
        base, link = compiled.bodies[parent], compiled.bodies[child]
        is_base = parent != 0 and base.welded == 0
        if overlap <= depth or not is_base or compiled.bodies[link.welded].parent != parent:
            continue
        yield finding(
            model.span(link.line),
            f"body {link.name!r} overlaps its base {base.name!r} by {overlap * 1000:.3g} mm at "
            f"the start, and MuJoCo makes contacts with a parent that is welded to the world: "
            f'write <exclude body1="{base.name}" body2="{link.name}"/>',
            fix=_excluded(model, base.name, link.name),
        )


def _excluded(model: CompiledModel, base: str, link: str) -> Fix | None:
    """Return the fix that leaves the pair out; None if one of the bodies has no name."""
    if not (base and link):
        return None
    exclude = f'<exclude body1="{base}" body2="{link}"/>'
    contact = model.model.document.root.child("contact")
    if contact is not None:
        return Fix(Safety.UNSAFE, (append_to(contact, [exclude]),))
    lines = ["<contact>", f"  {exclude}", "</contact>"]
    return Fix(Safety.UNSAFE, (append_to(model.model.document.root, lines),))


def _arm(exclude: str = "", mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body name="base"><geom size="0.1"/>
<body name="link" pos="0 0 0.15">{mark}
<joint axis="0 1 0"/><geom size="0.1"/></body></body></worldbody>{exclude}"""
    }


GOOD = [_arm('<contact><exclude body1="base" body2="link"/></contact>')]
BAD = [_arm(mark="<!-- ^ MJC009 -->")]
