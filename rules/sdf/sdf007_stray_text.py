"""Text between elements, where SDFormat has none.

The text is usually a leftover: a tag that lost its brackets, a note without `<!--`, or the end of a
line that was cut. Parsers skip it without a message.

Fix: remove it, or turn it into the intended element or comment.
Source: SDFormat specification: elements hold either one value or other elements.
"""

from collections.abc import Iterator

from checker.formats.sdf.document import SdfDocument
from checker.rule import Concern, Findings, Severity, finding, replace_text, rule
from checker.source.text import Span
from checker.source.xml import Element
from checker.source.xml_insertion import with_blanks

_SHOWN = 60


@rule("SDF007", "stray-text", Severity.WARNING, Concern.ROBOT)
def check(sdf: SdfDocument) -> Findings:
    """Report text in elements that hold no value."""
    for element, kind in sdf.typed_elements:
        if kind is None or kind.free or kind.value_type:
            continue
        for span in element.stray_texts if element.children else _own_text_span(element):
            words = " ".join(span.text.split())
            shown = words if len(words) <= _SHOWN else words[:_SHOWN] + "…"
            yield finding(
                span,
                f"{shown!r} is text between the elements of <{element.tag}>: remove it or make it "
                "a comment",
                fix=replace_text(with_blanks(span), ""),
            )


def _own_text_span(element: Element) -> Iterator[Span]:
    if element.text.stated:
        yield element.text_span


GOOD = [
    """
<link name="arm">
  <!-- a note -->
  <pose>0 0 1 0 0 0</pose>
</link>
""",
    '<plugin name="p" filename="libp.so">anything</plugin>',
]
BAD = [
    """
<link name="arm">
  a note  <!-- ^ SDF007 -->
  <pose>0 0 1 0 0 0</pose>
</link>
""",
    """
<link name="arm">
  <pose>0 0 1 0 0 0</pose>&gt;  <!-- ^ SDF007 -->
</link>
""",
    '<link name="arm">wrist</link>  <!-- ^ SDF007 -->',
]
