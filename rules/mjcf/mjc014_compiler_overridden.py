"""Compiler settings of one model that contradict each other.

`<compiler>` holds for the whole model, whatever file it is in: of each attribute the last one
counts, also for the files that were included before. With `angle="radian"` in the robot and
`angle="degree"` in another included file, each range of the robot is read in degrees.

Fix: state one `<compiler>`, in the file that includes the others.
Source: MuJoCo 4.0.0, tried.
"""

from checker.formats.mjcf.model import MjcfModel
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.text import Located

_FOR_ALL = ("angle", "eulerseq", "autolimits", "inertiafromgeom", "balanceinertia")


@rule("MJC014", "compiler-overridden", Severity.WARNING, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report attributes of `<compiler>` that a later one changes."""
    before: dict[str, Located[str]] = {}
    for element in model.tagged("compiler"):
        for name in _FOR_ALL:
            value = element.attribute(name)
            if value is None:
                continue
            earlier = before.setdefault(name, value)
            if earlier.value != value.value:
                yield finding(
                    value,
                    f"{name}={value.value!r} replaces {name}={earlier.value!r} for the whole model",
                    related=[(earlier, "the value that is replaced")],
                )
                before[name] = value


_BODY = "<worldbody><body><joint/><geom size='1'/></body></worldbody>"


def _scene(angle: str, mark: str = "") -> dict[str, str]:
    part = f'<part>\n<compiler angle="{angle}"/>{mark}\n</part>'
    return {"@mjcf": f'<compiler angle="radian"/>\n<include file="p.xml"/>{_BODY}', "p.xml": part}


GOOD = [_scene("radian")]
BAD = [_scene("degree", "<!-- ^ MJC014 -->")]
