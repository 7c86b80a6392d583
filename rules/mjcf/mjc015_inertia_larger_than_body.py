"""A stated inertia that no body of this size can have.

The radius of gyration, √(I/m), of a body cannot exceed the distance from its centre of mass to its
farthest point. A larger one is often a placeholder such as 0.001 kg·m² for a finger of 26 g: the
part resists turning as if its mass were far outside, and servos tuned for the real one are slow.

Fix: compute the inertia from the shapes (leave `<inertial>` out and state their mass), or from CAD.
Source: definition of the radius of gyration.
"""

import math

from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule

_MARGIN = 1.2
"""Times the reach: the shapes of a body may leave out screws and cables."""


@rule("MJC015", "inertia-larger-than-body", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel, *, margin: float = _MARGIN) -> Findings:
    """Report moving bodies whose radius of gyration exceeds the extent of their shapes.

    Options:
        margin: Times the distance of the farthest point that the radius may have.
    """
    for body in () if model.compiled.lacks_meshes else model.compiled.bodies:
        if not (body.stated and body.welded and body.reach and body.mass > 0):
            continue
        largest = max(body.inertia)
        if math.sqrt(largest / body.mass) > margin * body.reach:
            element = model.element(body.line)
            inertial = element.child("inertial") if element is not None else None
            yield finding(
                inertial or model.span(body.line),
                f"body {body.name!r} has {largest:.3g} kg·m² with {body.mass:.3g} kg, but reaches "
                f"only {body.reach:.3g} m: more than {body.mass * body.reach**2:.2g} kg·m² is not "
                "possible",
                key="inertia",
            )


def _arm(inertia: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body name="finger"><joint/>
<inertial pos="0 0 0" mass="0.026" diaginertia="{inertia}"/>{mark}
<geom size="0.02"/></body></worldbody>"""
    }


GOOD = [_arm("4e-6 4e-6 4e-6")]
BAD = [_arm("0.001 0.001 0.001", "<!-- ^ MJC015 -->")]
