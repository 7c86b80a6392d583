"""Parts that are inside each other at the first keyframe.

The contact pushes them apart with the first step: the robot jumps, or a joint is jammed. Bodies and
their parents are left out, as MuJoCo leaves them out, and so are overlaps of less than 2 mm. Of a
robot with a fixed base, what is more than 10 mm inside the ground or its stand counts as well.

Fix: correct the keyframe or the shapes, or add `<exclude>` for shapes that always overlap.
Source: MuJoCo 4.0.0, tried.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_DEPTH = 0.002
_GROUND_DEPTH = 0.01


@rule("MJC017", "overlap-at-start", Severity.WARNING, Concern.ROBOT)
def check(
    model: CompiledModel, *, depth: float = _DEPTH, ground_depth: float = _GROUND_DEPTH
) -> Findings:
    """Report bodies that overlap at the first keyframe.

    Options:
        depth: Metres by which moving bodies of one robot overlap.
        ground_depth: Metres by which a body of a robot with a fixed base is inside what is static.
    """
    compiled = model.compiled
    for (first, second), overlap in model.overlaps.items() if compiled.at_key else ():
        one, other = compiled.bodies[first], compiled.bodies[second]
        is_static = not one.welded
        are_one = _is_fixed(model, second) if is_static else model.root(first) == model.root(second)
        if not are_one or overlap <= (ground_depth if is_static else depth):
            continue
        yield finding(
            model.span(other.line),
            f"bodies {one.name!r} and {other.name!r} overlap by {overlap * 1000:.3g} mm at the "
            "first keyframe",
            related=[(model.span(one.line), "the other body")],
        )


def _is_fixed(model: CompiledModel, body: int) -> bool:
    """Return whether a moving body is part of a robot that the world holds by hinges and slides."""
    free = {joint.body for joint in model.compiled.joints if joint.type == "free"}
    return model.compiled.bodies[body].welded != 0 and model.root(body) not in free


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
