"""A value that is not of its type.

Examples are `1.O1e2` with a letter O, `nan`, seven numbers in a pose, or `yes` for a boolean.
Parsers refuse the file, or read only the first part, so that the robot weighs 1 kg instead of 101
kg. Words after the numbers that are expected have no effect: a warning; from libsdformat 12 on a
pose may not have any, but may have a comma behind a number: a warning, because the specification
has none. This rule also checks numbers that the specification limits (a stddev below 0), as the
newest version that the target reads has them, and words that it lists (the type of a light). Gazebo
Classic limits no numbers: it takes a `mu` of -1 as no limit of the friction. It reads older files
that state one number as the `<sim_time>` of a saved `<state>`: a warning there. So is the type of a
light, which it reads as a text: the world loads, and only that light differs; and so is an inertia
of a static model, which nothing moves.

Fix: write the value as the message says. Numbers have a decimal point, no unit, and spaces between
them.
Source: SDFormat specification, type, min and max of each element; what libsdformat 12 loads;
gazebo-classic, `FrictionPyramid::SetMuPrimary`.
"""

import re
from collections.abc import Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.base.resources import table
from checker.formats.sdf.document import (
    QUATERNION_POSE,
    SdfDocument,
    misread_values,
    parse_version,
    values_out_of_bounds,
)
from checker.formats.sdf.poses import in_degrees
from checker.formats.sdf.schema import ElementType, type_of
from checker.formats.sdf.unread import is_within
from checker.model.robot import states_static
from checker.model.values import parse_number
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    replace_text,
    rule,
)
from checker.source.text import Located
from checker.source.xml import Element

_Attributes = Mapping[str, Sequence[str]]
"""Attribute name → type, default, required, as the schema has them."""
_COMMA = re.compile(r"(?<=[\d.]),(?=\s|\Z)")
"""What `std::stod`, with which libsdformat reads each word of a pose since 12, leaves out."""


_LOOKALIKES = str.maketrans("OoIl", "0011")
"""Letters that look like digits."""


@rule("SDF006", "unreadable-value", Severity.ERROR, Concern.ROBOT)
def check(sdf: SdfDocument, context: Context) -> Findings:
    """Report texts and attributes that are not values of their type."""
    words = table("sdf_words")
    for element, kind in sdf.typed_as(context.reads):
        if kind is None:
            continue
        attributes = _attribute_types(element, kind, context)
        for found in _text(element, kind, attributes, context):
            is_unused = context.release == "classic" and _is_unused(element)
            yield replace(found, severity=Severity.WARNING) if is_unused else found
        above = element.parent.tag if element.parent is not None else ""
        choice = words["elements"].get(f"{above}/{element.tag}")
        yield from _word(element.text, f"<{element.tag}>", choice)
        is_light = context.release == "classic" and element.tag == "light"
        for found in _attributes(element, attributes, words["attributes"]):
            yield replace(found, severity=Severity.WARNING) if is_light else found


def _is_unused(element: Element) -> bool:
    """Return whether a value is in a saved state, or is about the mass of a static model."""
    if not is_within(element, "inertial"):
        return is_within(element, "state")
    model: Element | None = element
    while model is not None and model.tag != "model":
        model = model.parent
    return model is not None and states_static(model)


def _attribute_types(element: Element, kind: ElementType, context: Context) -> _Attributes:
    """Return what attributes may be at an element, with those of the version it is read as."""
    if not element.attributes.keys() - kind.attributes.keys():
        return kind.attributes
    later = type_of(element, context.reads)
    return kind.attributes if later is None else {**later.attributes, **kind.attributes}


def _counts_words_of_poses(context: Context) -> bool:
    """Return whether the target refuses a pose of too many words: libsdformat from 12 on."""
    reads = parse_version(context.reads)
    return reads is not None and reads >= (1, 9)


def _text(
    element: Element, kind: ElementType, attributes: _Attributes, context: Context
) -> Iterator[Finding]:
    text, value_type = element.text, kind.value_type
    if not text.stated:
        # An empty element that is required is for SDF005.
        if value_type not in ("", "string", "pose") and kind.occurs in ("0", "*"):
            yield finding(
                element,
                f"<{element.tag}> is empty, so its default {kind.default} is used",
                severity=Severity.WARNING,
            )
        return
    if value_type == "pose" and "rotation_format" in attributes:
        quaternion = element.get("rotation_format") == "quat_xyzw"
        value_type = QUATERNION_POSE if quaternion else value_type
        if quaternion and in_degrees(element):
            yield finding(element, "<pose> gives a quaternion, but says that it is in degrees")
    faults = misread_values(text, value_type)
    if all(fault.lossy for fault in faults):
        # A file of an older version is read by the newest description that the target has.
        newest = type_of(element, context.reads) or kind
        outside = values_out_of_bounds(text, newest.bounds)
        faults += outside if context.release != "classic" else ()
    by_word = kind.value_type == "pose" and _counts_words_of_poses(context)
    plain = Located(_COMMA.sub("", text.value), text.span)
    is_taken = by_word and not misread_values(plain, value_type)
    for fault in faults:
        lossy = is_taken if by_word else fault.lossy
        severity = Severity.WARNING if lossy else None
        digits = fault.span.text.translate(_LOOKALIKES)
        is_mistyped = digits != fault.span.text and parse_number(digits) is not None
        fix = replace_text(fault.span, digits, Safety.UNSAFE) if is_mistyped else None
        yield finding(fault.span, f"<{element.tag}> {fault.problem}", severity=severity, fix=fix)


def _attributes(
    element: Element, known: _Attributes, words: Mapping[str, Sequence[str]]
) -> Iterator[Finding]:
    for name in element.attributes:
        written = element.attribute(name) if name in known else None
        if written is None or not written.value.strip():
            continue
        text = Located(written.value.strip(), written.span)
        label = f"{name!r} of <{element.tag}>"
        for fault in misread_values(text, known[name][0]):
            severity = Severity.WARNING if fault.lossy else None
            yield finding(fault.span, f"{label} {fault.problem}", severity=severity)
        yield from _word(text, label, words.get(f"{element.tag}/{name}"))


def _word(text: Located[str], label: str, choice: Sequence[str] | None) -> Iterator[Finding]:
    if choice and text.stated and text.value not in choice:
        listed = ", ".join(choice)
        yield finding(text, f"{label} is {text.value[:40]!r}, expected {listed}")


def _inertial(mass: str, pose: str = "0 0 0 0 0 0</pose>") -> str:
    return f"""
<inertial>
  <pose>{pose}
  <mass>{mass}
</inertial>
"""


def _depth(far: str) -> str:
    return f"""
<sdf version="1.4"><model name="rover">
<link name="l">
<sensor name="depth" type="depth">
  <camera>
    <horizontal_fov>2</horizontal_fov>
    <image><width>64</width><height>48</height></image>
    <clip><near>0.1</near><far>{far}
    </clip>
  </camera>
</sensor>
</link>
</model></sdf>
"""


_SAVED = """
<sdf version="1.4"><world name="hall">
<state world_name="hall">
  <sim_time>0</sim_time>@
</state>
</world></sdf>
"""
_SUN = """
<sdf version="1.6"><world name="hall">
<light name="lamp" type="sun"/>  <!-- ^ SDF006 -->
</world></sdf>
"""
GOOD = [
    _depth("3</far>"),
    _inertial("1.01e2</mass>"),
    _inertial(".5</mass>", "\n0 0 0\n0 0 -1.5707963267948966</pose>"),
    "<light name='lamp' type='point'><diffuse>1 1 1</diffuse></light>",
    "<link name='arm'><gravity>false</gravity><pose/></link>",
]
BAD = [
    {"@profile": "gazebo-classic", "@fragment": _SAVED.replace("@", "  <!-- ^ SDF006 -->")},
    {"@profile": "gazebo-classic", "@fragment": _SUN},
    _depth("-1</far>  <!-- ^ SDF006 -->"),
    _inertial("1.O1e2</mass>  <!-- ^ SDF006 -->"),
    _inertial("nan</mass>  <!-- ^ SDF006 -->"),
    _inertial("3.6 kg</mass>  <!-- ^ SDF006 -->"),
    _inertial("1</mass>", "0 0 0 0 0 0 0</pose>  <!-- ^ SDF006 -->"),
    _inertial("1</mass>", "0 0 inf 0 0 0</pose>  <!-- ^ SDF006 -->"),
    _inertial("1</mass>", "0, 0.2, 0, 0, 0, 0</pose>  <!-- ^ SDF006 -->"),
    "<link name='arm'><gravity>no</gravity></link>  <!-- ^ SDF006 -->",
    "<light name='lamp' type='bulb'/>  <!-- ^ SDF006 -->",
    """
<sensor name="eye" type="camera">
  <camera>
    <horizontal_fov>90</horizontal_fov>  <!-- ^ SDF006 -->
    <image>
      <width>640.5</width>  <!-- ^ SDF006 -->
    </image>
  </camera>
</sensor>
""",
]
