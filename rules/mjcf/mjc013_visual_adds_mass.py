"""Meshes that are only seen and that add to the mass of a body.

Where a body has no `<inertial>`, MuJoCo computes its mass from **all** of its shapes, with
1000 kg/m³ unless stated. A mesh for the eye beside simple shapes for contacts makes the body about
twice as heavy.

Fix: state `mass="0"` (or `density="0"`) in the class of the visual shapes, or an `<inertial>`.
Source: XMLreference, compiler/inertiafromgeom and inertiagrouprange.
"""

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_SHARE = 0.05


@rule("MJC013", "visual-adds-mass", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, share: float = _SHARE) -> Findings:
    """Report moving bodies with visual meshes that weigh, and other shapes that collide.

    Options:
        share: Part of the body's mass from which on it is reported.
    """
    for body in () if model.compiled.lacks_meshes else model.compiled.bodies:
        if body.welded and body.visual_mass > share * body.mass:
            yield finding(
                model.span(body.line),
                f"body {body.name!r} weighs {body.mass:.4g} kg, of which {body.visual_mass:.4g} kg "
                'are of meshes that collide with nothing: state mass="0" for these',
                key="visual mass",
            )


def _arm(visual: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<asset><mesh name="arm" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
<worldbody><body name="arm">{mark}
<joint/><geom size="0.1"/>
<geom type="mesh" mesh="arm" contype="0" conaffinity="0" {visual}/></body></worldbody>"""
    }


GOOD = [_arm('mass="0"'), _arm('mass="2"')]
BAD = [_arm("", "<!-- ^ MJC013 -->")]
