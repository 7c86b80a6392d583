"""A colour with a component outside 0…1.

libsdformat 11.4 and later refuse the file: red, green, blue and alpha are numbers from 0 to 1.
Releases up to Dome divide numbers above 1 by 255: 255 is full brightness, but 1.5 is nearly dark.

Fix: divide numbers from 0 to 255 by 255.
Source: SDFormat specification, type color; libsdformat 11.4, Param.cc; ign-math 6, Color::Clamp.
"""

from checker.finding import Fix
from checker.formats.sdf.document import SdfDocument
from checker.model.values import ValueReader
from checker.rule import Concern, Context, Findings, Severity, finding, replace_text, rule
from checker.source.text import Located
from checker.source.xml import Element

EIGHT_BIT = 255.0
LENIENT = ("dome", "classic")
"""Releases whose parser changes such numbers instead of refusing the file."""


@rule("SDF016", "colour-out-of-range", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context, *, eight_bit_from: float = 16.0) -> Findings:
    """Report colours with a number below 0 or above 1.

    Options:
        eight_bit_from: Least value of the largest of red, green and blue for which a fix divides by
            255; all numbers must be whole and from 0 to 255.
    """
    lenient = context.release in LENIENT
    for element, kind in sdf.typed_elements:
        if kind is None or kind.value_type != "color":
            continue
        reader = ValueReader()
        colour = reader.numbers_in(element.text)
        if reader.faults or len(colour) not in (3, 4):
            continue  # SDF006 says so.
        if not all(0.0 <= number.value <= 1.0 for number in colour):
            yield finding(
                element.text,
                f"<{element.tag}> is {element.text.value[:60]}, expected numbers from 0 to 1"
                + (f"; it is read as {_converted_colour(colour)}" if lenient else ""),
                severity=Severity.WARNING if lenient else None,
                key="colour",
                fix=_division_fix(element, colour, eight_bit_from),
            )


def _converted_colour(colour: tuple[Located[float], ...]) -> str:
    """Return what a lenient parser makes of a colour."""
    values = (max(0.0, number.value) for number in colour)
    return " ".join(f"{value / EIGHT_BIT if value > 1 else value:.2g}" for value in values)


def _division_fix(element: Element, colour: tuple[Located[float], ...], least: float) -> Fix | None:
    """Return the fix that divides by 255; none for colours that are only slightly too bright."""
    values = [number.value for number in colour]
    whole = all(0.0 <= value <= EIGHT_BIT and value.is_integer() for value in values)
    if not whole or max(values[:3]) < least:
        return None
    # An alpha of 0 or 1 beside numbers up to 255 is meant as it stands.
    alpha = [value / EIGHT_BIT if value > 1.0 else value for value in values[3:]]
    parts = [*(value / EIGHT_BIT for value in values[:3]), *alpha]
    return replace_text(element.text, " ".join(f"{round(part, 4):g}" for part in parts))


def _material(diffuse: str) -> str:
    return f"""
<visual name="body">
  <geometry><box><size>1 1 1</size></box></geometry>
  <material>
    <diffuse>{diffuse}
  </material>
</visual>
"""


GOOD = [_material("0.2 0.35 1</diffuse>"), _material("0 0 0 1</diffuse>")]
BAD = [
    _material("51 89 153 255</diffuse>  <!-- ^ SDF016 -->"),
    _material("-0.1 0 0 1</diffuse>  <!-- ^ SDF016 -->"),
    "<light name='lamp' type='point'><diffuse>2 2 2</diffuse></light>  <!-- ^ SDF016 -->",
]
