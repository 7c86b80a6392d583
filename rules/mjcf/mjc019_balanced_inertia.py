"""A moment of inertia that no body can have, and that MuJoCo replaces without a message.

With `<compiler balanceinertia="true">`, principal moments A, B, C with A + B < C are replaced by
their mean, which is the inertia of a sphere. Without it MuJoCo refuses the model. Often one number
has a wrong power of ten, or the moments are those of another frame.

Fix: correct the moments, and remove `balanceinertia`.
Source: MuJoCo 4.0.0, tried; XMLreference, compiler/balanceinertia.
"""

from checker.formats.mjcf.model import MjcfModel
from checker.formats.mjcf.values import numbers
from checker.rule import Concern, Findings, Severity, finding, rule

_MARGIN = 1e-6


@rule("MJC019", "balanced-inertia", Severity.WARNING, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report stated principal moments that balanceinertia replaces."""
    balances = model.compiler.get("balanceinertia")
    if balances is None or balances.value != "true":
        return
    for element in model.tagged("inertial"):
        value, moments = element.attribute("diaginertia"), numbers(element, "diaginertia")
        if value is None or moments is None:
            continue
        largest = max(moments)
        others = sum(moments) - largest
        if others < largest * (1 - _MARGIN):
            yield finding(
                value,
                f"diaginertia {value.value!r} is not possible: {largest:g} is more than the sum of "
                f"the others, {others:g}; MuJoCo replaces all by their mean, "
                f"{sum(moments) / len(moments):.3g}",
                key="balanced",
            )


def _foot(moments: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<compiler balanceinertia="true"/>
<worldbody><body name="toe"><joint/>
<inertial pos="0 0 0" mass="0.2" diaginertia="{moments}"/>{mark}
<geom size="0.05"/></body></worldbody>"""
    }


GOOD = [_foot("1e-4 2e-4 2e-4")]
BAD = [_foot("1e-4 2e-4 1e-3", "<!-- ^ MJC019 -->")]
