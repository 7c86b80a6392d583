"""A number that is not one, or is below zero, where MuJoCo needs a positive one.

MuJoCo accepts `nan`, and damping, armature, friction and stiffness below zero, without a message.
NaN spreads to the whole state in the first step; negative damping and armature add energy until the
simulation diverges. With a time step of zero or less time does not advance.

Fix: state a number above zero, or leave the attribute out.
Source: MuJoCo 4.0.0, tried.
"""

import math

from checker.formats.mjcf.model import MjcfModel
from checker.formats.mjcf.values import numbers
from checker.rule import Concern, Findings, Severity, finding, rule

_POSITIVE = ("damping", "armature", "frictionloss", "stiffness", "friction", "density", "mass")
_ELEMENTS = ("joint", "geom", "tendon", "spatial", "fixed", "inertial", "position", "velocity")
_OF_ACTUATORS = ("kp", "kv")


@rule("MJC006", "nan-or-negative", Severity.ERROR, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report NaN anywhere, and numbers below zero where they make no sense."""
    for element in model.elements:
        for name in element.attributes:
            value, stated = element.attribute(name), numbers(element, name)
            if value is None or stated is None:
                continue
            what = f"{name} of <{element.tag}>{_named(element.get('name'))}"
            if any(map(math.isnan, stated)) and name not in ("name", "class"):
                yield finding(value, f"{what} is {value.value!r}, which is no number")
            elif element.tag in _ELEMENTS and _is_negative(name, stated):
                yield finding(value, f"{what} is {value.value}, expected 0 or more")
        step = numbers(element, "timestep") if element.tag == "option" else None
        if step is not None and step[0] <= 0:
            where = element.attribute("timestep") or element
            yield finding(where, f"timestep is {step[0]:g} s, expected more than 0")


def _is_negative(name: str, stated: tuple[float, ...]) -> bool:
    return name in (*_POSITIVE, *_OF_ACTUATORS) and min(stated) < 0


def _named(name: str | None) -> str:
    return f" {name!r}" if name else ""


def _arm(joint: str) -> dict[str, str]:
    return {"@mjcf": f"<worldbody><body>\n{joint}\n<geom size='1'/></body></worldbody>"}


_MARK = "<!-- ^ MJC006 -->"
GOOD = [_arm('<joint damping="0.1"/>'), _arm('<joint ref="-1"/>')]
BAD = [
    _arm(f'<joint damping="nan"/>{_MARK}'),
    _arm(f'<joint armature="-0.01"/>{_MARK}'),
    {"@mjcf": f"<option timestep='0'/>{_MARK}\n<worldbody><geom size='1'/></worldbody>"},
]
