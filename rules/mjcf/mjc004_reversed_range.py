"""A range whose lower bound is not below its upper one: MuJoCo ignores it.

With `limited="auto"`, the default, a range limits only if its first number is less than the
second one; otherwise the joint turns freely, or the command or force is not limited. There is no
message. `range="0 0"` takes away the range of a class and is not reported.

Fix: exchange the numbers. A joint that is not to move needs no joint at all.
Source: MuJoCo 4.0.0, tried; XMLreference, body/joint/limited.
"""

from checker.formats.mjcf.model import MjcfModel
from checker.formats.mjcf.values import numbers
from checker.rule import Concern, Findings, Safety, Severity, finding, replace_text, rule

_RANGES = {
    "range": "limited",
    "ctrlrange": "ctrllimited",
    "forcerange": "forcelimited",
    "actrange": "actlimited",
    "actuatorfrcrange": "actuatorfrclimited",
}
_WITHOUT_LIMIT = ("key", "camera", "light", "general_config", "numeric", "lengthrange")


@rule("MJC004", "reversed-range", Severity.ERROR, Concern.ROBOT)
def check(model: MjcfModel) -> Findings:
    """Report ranges of joints, tendons and actuators that MuJoCo ignores."""
    for element in model.elements:
        if element.tag in _WITHOUT_LIMIT:
            continue
        for name, limited in _RANGES.items():
            value, bounds = element.attribute(name), numbers(element, name)
            # MuJoCo itself refuses one that is said to limit.
            if value is None or bounds is None or len(bounds) != 2 or element.get(limited):
                continue
            lower, upper = bounds
            if lower >= upper and bounds != (0, 0):
                first, second = value.value.split()
                yield finding(
                    value,
                    f"{name} {value.value!r} of {_label(element.tag, element.get('name'))} "
                    f"limits nothing: its first number is not less than its second one"
                    + (f"; write {second} {first}" if lower > upper else ""),
                    fix=replace_text(value, f"{second} {first}", Safety.UNSAFE)
                    if lower > upper
                    else None,
                )


def _label(tag: str, name: str | None) -> str:
    return f"<{tag}> {name!r}" if name else f"a <{tag}>"


def _arm(bounds: str, mark: str = "") -> dict[str, str]:
    joint = f'<joint name="tilt" range="{bounds}"/>{mark}'
    return {"@mjcf": f"<worldbody><body>\n{joint}\n<geom size='1'/></body></worldbody>"}


_MARK = "<!-- ^ MJC004 -->"
GOOD = [_arm("-90 90"), _arm("0 0")]
BAD = [_arm("90 -90", _MARK), _arm("90 90", _MARK)]
