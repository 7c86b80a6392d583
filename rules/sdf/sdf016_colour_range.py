"""A colour outside 0…1.

Red, green, blue and alpha are numbers from 0 to 1. With numbers of 0 to 255 the part is white, or
the parser refuses the file.

Fix: divide by 255.
Source: SDFormat specification, type color; libsdformat refuses other values.
"""

from checker.finding import Fix
from checker.model.sdf.document import SdfDocument
from checker.model.values import ValueReader
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule
from checker.source.text import Located
from checker.source.xml import Element

EIGHT_BIT = 255.0


@rule("SDF016", "colour-range", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, *, eight_bit_from: float = 16.0) -> Findings:
    """Report colours with a number below 0 or above 1.

    Options:
        eight_bit_from: Least value of the largest of red, green and blue for which a fix divides by
            255; all numbers must be whole and from 0 to 255.
    """
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
                f"<{element.tag}> is {element.text.value[:60]}, expected numbers from 0 to 1",
                key="colour",
                fix=_divided(element, colour, eight_bit_from),
            )


def _divided(element: Element, colour: tuple[Located[float], ...], least: float) -> Fix | None:
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
