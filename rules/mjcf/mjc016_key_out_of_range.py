"""A keyframe that puts a joint, or the command of an actuator, outside its range.

MuJoCo takes the values as they are: the limit of the joint pushes it back with the first step, and
a command is clamped. Often the numbers are in another order than the joints or actuators.

Fix: state a value within the range, or correct the order.
Source: MuJoCo 4.0.0, tried.
"""

from collections.abc import Iterator, Sequence

from checker.formats.mjcf.values import numbers
from checker.physics.compiled.model import CompiledModel
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.xml import Element

_WIDTH = {"free": 7, "ball": 4}
_SHARE = 0.01
_LEAST = 0.01


@rule("MJC016", "key-out-of-range", Severity.WARNING, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report values of keyframes outside a range by more than 1 % of it."""
    compiled = model.compiled
    if compiled.refusals:
        return
    ranges = {
        "qpos": [
            (joint.name, joint.range if joint.limited else None)
            for joint in compiled.joints
            for _ in range(_WIDTH.get(joint.type, 1))
        ],
        "ctrl": [
            (actuator.name, actuator.ctrl_range if actuator.ctrl_limited else None)
            for actuator in compiled.actuators
        ],
    }
    for key in model.model.tagged("key"):
        for name, expected in ranges.items():
            yield from _outside(key, name, expected)


def _outside(
    key: Element, name: str, expected: Sequence[tuple[str, tuple[float, float] | None]]
) -> Findings:
    value, stated = key.attribute(name), numbers(key, name)
    if value is None or stated is None or len(stated) != len(expected):
        return
    far = [*_far(stated, expected)]
    if far:
        part, number, (low, high) = far[0]
        more = f", as {len(far) - 1} more are outside theirs" if len(far) > 1 else ""
        yield finding(
            value,
            f"{name} of keyframe {key.get('name') or ''!r} is {number:g} for {part!r}, expected "
            f"{low:.4g} to {high:.4g}{more}",
        )


def _far(
    stated: Sequence[float], expected: Sequence[tuple[str, tuple[float, float] | None]]
) -> Iterator[tuple[str, float, tuple[float, float]]]:
    for number, (part, bounds) in zip(stated, expected, strict=True):
        if bounds is not None:
            margin = max(_LEAST, _SHARE * (bounds[1] - bounds[0]))
            if not bounds[0] - margin <= number <= bounds[1] + margin:
                yield part, number, bounds


def _arm(position: str, mark: str = "") -> dict[str, str]:
    return {
        "@mjcf": f"""<worldbody><body><joint name="tilt" range="-90 90"/><geom size="0.1"/></body>
</worldbody><keyframe>
<key name="home" qpos="{position}"/>{mark}
</keyframe>"""
    }


GOOD = [_arm("1.5"), _arm("1.58")]
BAD = [_arm("90", "<!-- ^ MJC016 -->")]
