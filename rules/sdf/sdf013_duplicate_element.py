"""An element occurs twice, but only one is allowed.

Parsers use one of the two, usually the first, and print no message: the other has no effect. A
second one that is empty or the same as the first is an info.

Fix: remove the wrong one.
Source: SDFormat specification, "Required: 0" or "1" at the element: at most one.
"""

from checker.formats.sdf.document import SdfDocument
from checker.formats.sdf.schema import ElementType
from checker.rule import Concern, Findings, Severity, finding, rule
from checker.source.xml import Element

ELSEWHERE = {("sdf", "model")}
"""Parents and elements that another rule judges."""
SEVERAL = {("contact", "collision"), ("geometry", "polyline")}
"""Parents and elements of which simulators read several, despite the tables: the second
polyline is a hole in the first."""


@rule("SDF013", "duplicate-element", Severity.WARNING, Concern.ROBOT)
def check(sdf: SdfDocument) -> Findings:
    """Report second elements of a kind that may occur once."""
    for element, kind in sdf.typed_elements:
        if kind is None or kind.free or len(element.children) < 2:
            continue
        first: dict[str, Element] = {}
        contents: dict[str, list[tuple[object, ...]]] = {}
        for child in element.children:
            earlier = first.setdefault(child.tag, child)
            if earlier is child or not _is_single(element, kind, child.tag):
                continue
            content = contents.get(child.tag) or contents.setdefault(child.tag, _content(earlier))
            second = _content(child)
            empty, same = second == [(child.tag, (), "")], second == content
            how = "the same as the first" if same else "different from the first"
            how = "which is empty" if empty else how
            yield finding(
                child,
                f"<{element.tag}> contains a second <{child.tag}>, {how}",
                severity=Severity.INFO if empty or same else None,
                related=[(earlier, "the first")],
            )


def _is_single(parent: Element, kind: ElementType, tag: str) -> bool:
    if (parent.tag, tag) in SEVERAL | ELSEWHERE:
        return False
    if (parent.tag, tag) == ("sensor", "camera") and parent.get("type") == "multicamera":
        return False
    child = kind.children.get(tag)
    return child is not None and child.occurs in ("0", "1")


def _content(element: Element) -> list[tuple[object, ...]]:
    """Return the content of an element, without spaces and the order of attributes.

    `true` is the same as `1`.
    """
    return [
        (node.tag, tuple(sorted(node.attributes.items())), _value(" ".join(node.raw_text.split())))
        for node in (element, *element.descendants())
    ]


def _value(text: str) -> str:
    return {"true": "1", "false": "0"}.get(text, text)


GOOD = [
    """
<geometry>
  <polyline><point>-2 -2</point><point>2 -2</point><point>0 2</point><height>1</height></polyline>
  <polyline><point>-1 -1</point><point>1 -1</point><point>0 1</point><height>1</height></polyline>
</geometry>
""",
    """
<link name="arm">
  <visual name="a"><geometry><box/></geometry></visual>
  <visual name="b"><geometry><box/></geometry></visual>
</link>
""",
]
BAD = [
    """
<inertial>
  <mass>1</mass>
  <mass>2</mass>  <!-- ^ SDF013 -->
</inertial>
""",
    """
<inertial>
  <mass>1</mass>
  <mass> 1 </mass>  <!-- ^ SDF013 -->
</inertial>
""",
    # Info: an empty element has no effect.
    """
<collision name="c">
  <surface>
    <friction>
      <ode><mu>0.9</mu></ode>
      <ode/>  <!-- ^ SDF013 -->
    </friction>
  </surface>
</collision>
""",
]
