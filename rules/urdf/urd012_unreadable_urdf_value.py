"""A number that URDF readers cannot read, or a missing element or attribute.

urdfdom refuses the whole robot for a joint with such a fault. Of a link, it reads the inertial,
then the visuals, then the collisions, and drops all from the fault on: the robot loads, and a part
has no mass or touches nothing. Such faults are a decimal comma, a unit, a word, `inf`, `nan`, and a
blank behind a single number. A number below 0 or above 1 in a colour only loses the colour. Where
no simulator gets the robot, a fault in a part of a link is a warning: RViz shows the robot without
that part. URD001 reports a `${…}` that is not expanded.

Fix: write what the message names, or delete the part that lacks it. A number has a decimal point,
no unit, and blanks only between several numbers.
Source: urdfdom, `strToDouble`: nothing may follow the number; tried with check_urdf of urdfdom 6;
`parseURDF`, which keeps what `parseLink` has read before a fault.
"""

from collections import Counter
from collections.abc import Iterator

from checker.base.words import and_list, count
from checker.formats.urdf.description import UrdfDescription
from checker.formats.urdf.specification import (
    AttributeSpec,
    lacking_elements,
    specified_elements,
)
from checker.formats.xacro.names import EXPRESSION
from checker.model.values import parse_number, short
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Located
from checker.source.xml import Element

_ONLY_LOOKS = ("color",)
"""urdfdom ignores a colour that it cannot read."""
_READ = ("inertial", "visual", "collision")
"""Parts of a link in the order in which urdfdom reads them."""


@rule("URD012", "unreadable-urdf-value", Severity.ERROR, Concern.ROBOT)
def check(description: UrdfDescription) -> Findings:
    """Report what links and joints lack, and attributes that are not the numbers they should be."""
    for element, attributes in specified_elements(description.document):
        missing = [
            name
            for name, spec in attributes.items()
            if spec.required and element.attribute(name) is None
        ]
        if missing:
            yield _weighed(element, f"<{element.tag}> has no {', '.join(missing)}", description)
        for name, spec in attributes.items():
            yield from _numbers(element, name, spec, description)
    for colour in description.document.root.descendants("color"):
        yield from _out_of_range(colour)
    for element, what in lacking_elements(description.document):
        yield _weighed(element, f"<{element.tag}> has no {what}", description)


def _weighed(
    element: Element, message: str, description: UrdfDescription, text: Located[str] | None = None
) -> Finding:
    """Return a finding that says what the link of an element loses, and weighs by who gets it.

    Args:
        element: The element.
        message: What is wrong with it.
        description: The robot.
        text: The attribute that is wrong; None for the element itself.
    """
    looks = element.tag in _ONLY_LOOKS
    lost = "" if looks else _lost(element)
    harmless = description.for_rviz or looks or (lost and description.shown_only)
    severity = Severity.WARNING if harmless else None
    return finding(text or element, message + lost, severity=severity, key=message)


def _lost(element: Element) -> str:
    """Return what the link of an element loses, as the end of a message; empty without one."""
    part = element
    while part.parent is not None and part.parent.tag != "link":
        part = part.parent
    link = part.parent
    if link is None or part.tag not in _READ:
        return ""
    parts = sorted(
        (it for it in link.children if it.tag in _READ), key=lambda it: _READ.index(it.tag)
    )
    lost = Counter(it.tag for it in parts[parts.index(part) :])
    what = and_list([count(number, tag) for tag, number in lost.items()])
    return f": urdfdom drops {what} of link {short(link.get('name') or '')!r}"


def _numbers(
    element: Element, name: str, spec: AttributeSpec, description: UrdfDescription
) -> Iterator[Finding]:
    text = element.attribute(name)
    if text is not None and spec.numbers and (problem := _problem(text, spec.numbers)):
        yield _weighed(element, f"{name} of <{element.tag}> {problem}", description, text)


def _out_of_range(colour: Element) -> Iterator[Finding]:
    text = colour.attribute("rgba")
    values = [parse_number(word) for word in text.value.split()] if text is not None else []
    if text is not None and any(value is not None and not 0 <= value <= 1 for value in values):
        yield finding(
            text,
            f"rgba of <color> is {short(text.value)!r}, expected numbers from 0 to 1: URDF readers "
            "drop the colour",
            severity=Severity.WARNING,
            key="colour",
        )


def _problem(text: Located[str], count: int) -> str:
    """Return what is wrong with the numbers of an attribute; nothing if they can be read."""
    words = text.value.split()
    if EXPRESSION.search(text.value):
        return ""
    for word in words:
        value = parse_number(word)
        if value is None:
            return f"contains {short(word)!r}, which is not a number"
        if value in (float("inf"), float("-inf")):
            return f"is {word}, which URDF readers refuse; expected a finite number"
    if len(words) != count:
        expected = f"{count} numbers" if count > 1 else "one number"
        return f"has {len(words)} values, expected {expected}"
    if count == 1 and text.value != text.value.rstrip():
        return "ends with a blank, which URDF readers refuse"
    return ""


_MOMENTS = 'ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"'


def _link(mass: str = 'value="1"', moments: str = _MOMENTS, size: str = "1 1 1") -> dict[str, str]:
    inertial = f"<inertial>\n<mass {mass}/>{{mark}}\n<inertia {moments}/>\n</inertial>"
    shape = f'<collision><geometry>\n<box size="{size}"/>\n</geometry></collision>'
    joint = '<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>'
    return {"@urdf": f'<link name="tip">\n{inertial}\n{shape}\n</link>\n{joint}'}


def _marked(example: dict[str, str], line: str) -> dict[str, str]:
    text = example["@urdf"].replace("{mark}", "")
    return {"@urdf": text.replace(line, f"{line}  <!-- ^ URD012 -->", 1)}


GOOD = [
    _marked(_link(), "nothing"),
    _marked(_link(size=" 1  1e0 +1. "), "nothing"),
    _marked(_link('value="${0.5 * 2}"'), "nothing"),
]
BAD = [
    _marked(_link('value="1,5"'), '<mass value="1,5"/>'),
    _marked(_link('value="1 "'), '<mass value="1 "/>'),
    _marked(_link('value="nan"'), '<mass value="nan"/>'),
    _marked(_link(""), "<mass />"),
    _marked(_link(moments=_MOMENTS.replace(' iyz="0"', "")), 'izz="1"/>'),
    _marked(_link(size="1 1"), '<box size="1 1"/>'),
    _marked(_link(size="1 inf 1"), '<box size="1 inf 1"/>'),
    {
        "@urdf": """
<material name="sand">
<color rgba="194 178 128 1"/>  <!-- ^ URD012 -->
</material>
<link name="tip"/>
<joint name="j" type="fixed"><parent link="upper_arm"/><child link="tip"/></joint>
"""
    },
]
