"""Angles that are written in one unit and read in the other.

`<compiler angle>` is `degree` unless stated, for the ranges of hinges, `ref`, `springref`, `euler`
and `axisangle`. A model converted from URDF has radians: read as degrees, a joint of ±1.57 moves by
±1.57° and looks fixed. The other way round, ±90 rad limit nothing. Values of keyframes, commands
and gains are always in radians.

Fix: state `<compiler angle="radian"/>` for radians, or remove it for degrees.
Source: XMLreference, compiler/angle.
"""

import math
from collections.abc import Iterator

from checker.finding import Fix
from checker.formats.mjcf.values import numbers
from checker.physics.compiled.model import CompiledModel, Joint
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.xml_insertion import attribute_edits, insert_into

_TURNS = 4 * math.pi
"""Radians; robots whose joints turn twice in both directions exist."""
_QUARTER = math.pi / 2
_STEP = math.pi / 12
_NEAR = 0.005
_FEWEST = 3


@rule("MJC008", "angle-unit", Severity.ERROR, Concern.ROBOT)
def check(model: CompiledModel) -> Findings:
    """Report ranges of hinges and orientations that make sense in the other unit alone."""
    hinges = [
        joint
        for joint in model.compiled.joints
        if joint.type == "hinge" and joint.limited and joint.range != (0, 0)
    ]
    if model.model.in_radians:
        yield from _far(model, hinges)
        yield from _turned(model)
    elif (small := _small(hinges)) is not None:
        low, high = map(math.degrees, small.range)
        yield finding(
            model.span(small.line),
            f"joint {small.name!r} moves from {low:.4g}° to {high:.4g}°, and all hinges of the "
            f"model as little: the ranges are in radians, but MuJoCo reads degrees; write "
            f'<compiler angle="radian"/>',
            key="radians",
            fix=_in_radians(model),
        )


def _in_radians(model: CompiledModel) -> Fix:
    """Return the fix that states radians, in the `<compiler>` that there is."""
    stated = model.model.compiler.get("angle")
    if stated is not None:
        return replace_text(stated, "radian", Safety.UNSAFE)
    compiler = next(model.model.tagged("compiler"), None)
    if compiler is not None:
        return Fix(Safety.UNSAFE, attribute_edits(compiler, {"angle": "radian"}))
    root = model.model.document.root
    return Fix(Safety.UNSAFE, (insert_into(root, ['<compiler angle="radian"/>']),))


def _far(model: CompiledModel, hinges: list[Joint]) -> list[Finding]:
    far = [joint for joint in hinges if max(map(abs, joint.range)) > _TURNS]
    return [
        finding(
            model.span(joint.line),
            f"range {joint.range[0]:g} {joint.range[1]:g} of joint {joint.name!r} is in radians, "
            f"{max(map(abs, joint.range)) / math.tau:.3g} turns: with degrees meant, remove "
            'angle="radian" of <compiler>',
            key="degrees",
        )
        for joint in far
    ]


def _turned(model: CompiledModel) -> Iterator[Finding]:
    for element in model.model.elements:
        value, angles = element.attribute("euler"), numbers(element, "euler")
        if value is not None and any(map(_is_in_degrees, angles or ())):
            yield finding(
                value,
                f"euler {value.value!r} of <{element.tag}> is in radians, more than a turn: with "
                'degrees meant, convert it, or remove angle="radian" of <compiler>',
                key="turned",
            )


def _is_in_degrees(angle: float) -> bool:
    """Return whether nobody means radians; a script that adds up angles may exceed one turn."""
    return abs(angle) > (math.tau if angle.is_integer() else _TURNS)


def _small(hinges: list[Joint]) -> Joint | None:
    """Return a hinge whose range looks like radians, if those of all hinges do.

    Quarter turns are enough for one hinge, multiples of 15° for half of three.
    """
    bounds = [[math.degrees(it) for it in joint.range] for joint in hinges]
    if not hinges or any(high - low > math.tau * (1 + _NEAR) for low, high in bounds):
        return None
    for step, fewest in ((_QUARTER, 1), (_STEP, _FEWEST)):
        found = [
            joint
            for joint, values in zip(hinges, bounds, strict=True)
            if any(_is_multiple(value, step) for value in values)
        ]
        if len(hinges) >= fewest and 2 * len(found) >= len(hinges):
            return found[0]
    return None


def _is_multiple(value: float, step: float) -> bool:
    """Return whether a number is a multiple of a step, and no integer, as degrees often are."""
    turns = round(value / step)
    is_near = turns != 0 and abs(value - turns * step) < _NEAR * abs(value)
    return is_near and abs(value - round(value)) > 1e-6


def _arm(compiler: str, bounds: str, mark: str = "") -> dict[str, str]:
    first, second, third = (f'<joint name="{it}" range="{bounds}"/>' for it in ("a", "b", "c"))
    inner = f"<body>{second}<geom size='1'/><body>{third}<geom size='1'/></body></body>"
    return {
        "@mjcf": f"<compiler {compiler}/>\n<worldbody><body>\n{first}{mark}\n"
        f"<geom size='1'/>{inner}</body></worldbody>"
    }


_MARK = "<!-- ^ MJC008 -->"
_GEOM = '<geom size="1" euler="0 0 6.676"/>'
GOOD = [
    _arm("", "-90 90"),
    _arm('angle="radian"', "-1.57 1.57"),
    _arm('angle="radian"', "-9.42 9.42"),
    {"@mjcf": f'<compiler angle="radian"/><worldbody>{_GEOM}</worldbody>'},
]
BAD = [
    _arm("", "-1.5708 1.5708", _MARK),
    {
        "@mjcf": '<compiler angle="radian"/>\n<worldbody><body>\n<joint name="a" range="-90 90"/>'
        f"{_MARK}\n<geom size='1'/></body></worldbody>"
    },
    {
        "@mjcf": '<compiler angle="radian"/>\n<worldbody>\n<geom size="1" euler="0 90 0"/>'
        f"{_MARK}\n</worldbody>"
    },
]
