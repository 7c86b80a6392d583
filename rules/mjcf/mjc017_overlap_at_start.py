"""Two parts of a robot that are inside each other at its first keyframe.

The contact pushes them apart with the first step: the robot jumps, or a joint is jammed. Bodies and
their parents are left out, as MuJoCo leaves them out, and so are overlaps of less than 2 mm.

Fix: correct the keyframe or the shapes, or add `<exclude>` for shapes that always overlap.
Source: MuJoCo 4.0.0, tried.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_DEPTH = 0.002


@rule("MJC017", "overlap-at-start", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, depth: float = _DEPTH) -> Findings:
    """Report moving bodies of one robot that overlap at the first keyframe.

    Options:
        depth: Metres by which they overlap.
    """
    compiled = model.compiled
    deepest: dict[tuple[int, int], float] = {}
    for contact in compiled.contacts if compiled.at_key and not model.lacks_files else ():
        first, second = sorted(compiled.geoms[geom].body for geom in contact.geoms)
        are_moved = compiled.bodies[first].welded and compiled.bodies[second].welded
        if are_moved and contact.distance < -depth and model.root(first) == model.root(second):
            deepest[first, second] = min(contact.distance, deepest.get((first, second), 0.0))
    for (first, second), distance in deepest.items():
        one, other = compiled.bodies[first], compiled.bodies[second]
        yield finding(
            model.span(other.line),
            f"bodies {one.name!r} and {other.name!r} overlap by {-distance * 1000:.3g} mm at the "
            "first keyframe",
            related=[(model.span(one.line), "the other body")],
        )


def _arm(angle: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body name="base"><freejoint/><geom size="0.1"/>
<body name="upper" pos="0 0 0.2"><joint axis="0 1 0"/><geom size="0.05"/>
<body name="lower" pos="0 0 0.2">{mark}
<joint axis="0 1 0"/><geom size="0.02" pos="0 0 0.4"/></body></body></body></worldbody>
<keyframe><key qpos="0 0 0 1 0 0 0 0 {angle}"/></keyframe>"""
    }


GOOD = [_arm("0")]
BAD = [_arm("3.14159", "<!-- ^ MJC017 -->")]
