"""A friction that is made harder with `impratio`, while the friction cones are pyramids.

`impratio` above 1 is set so that held objects do not slip. MuJoCo advises against it with
pyramidal cones, which are the default: each edge of a pyramid mixes the normal force with
friction. In a grasp that we tried, an object slipped three times as fast as with elliptic cones,
at any `impratio`. A model that states `cone="pyramidal"` is not reported.

Fix: write `cone="elliptic"` in `<option>`.
Source: MuJoCo 4.0.0, XMLreference, option/impratio; tried.
"""

from checker.formats.mjcf.model import MjcfModel
from checker.formats.mjcf.values import numbers
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("MJC023", "impratio-of-pyramids", Severity.WARNING, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report `impratio` of a model whose files leave the cones at their default."""
    options = tuple(model.tagged("option"))
    if not model.is_whole or any(option.get("cone") for option in options):
        return
    for option in options:
        value, ratio = option.attribute("impratio"), numbers(option, "impratio")
        if value is not None and ratio is not None and ratio[0] > 1.0:
            yield finding(
                value,
                f"impratio {ratio[0]:g} with pyramidal friction cones, the default: held objects "
                'slip more than with cone="elliptic"',
            )


def _grip(option: str, mark: str = "") -> dict[str, str]:
    body = "<worldbody><body name='pad'><joint/><geom size='0.02'/></body></worldbody>"
    return {"@mjcf": f"<option {option}/>{mark}\n{body}"}


GOOD = [_grip('cone="elliptic" impratio="10"'), _grip('impratio="1"')]
BAD = [_grip('impratio="10"', "<!-- ^ MJC023 -->")]
