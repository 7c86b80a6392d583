"""A spawner that emits broken XML, or text between the elements.

XML that is not well-formed cannot be spawned. Text between the elements is ignored, and is usually
the rest of an element that lost its tag. A single quotation mark after a comment is harmless: many
spawners have one from a template.

Fix: correct the tag that the message names, or remove the text.
Source: XML specification; SubT spawner templates.
"""

from collections.abc import Iterator

from checker.launch.spawner.reader import Spawner, Unread
from checker.rule import Concern, Finding, Findings, Severity, finding, rule
from checker.source.text import Span
from checker.source.xml import XmlDocument
from checker.source.xml_fragments import parse_fragments
from checker.source.xml_positions import XmlFault

_HARMLESS = frozenset("\"' \t\r\n")


@rule("SPW004", "broken-emitted-xml", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner) -> Findings:
    """Report emitted text that no XML reader accepts."""
    for name, text in (("spawner", spawner.spawn), ("rosExecutables", spawner.executables)):
        if isinstance(text, Unread):
            continue
        document = parse_fragments(text)
        if isinstance(document, XmlFault):
            yield finding(document.span, f"{name} emits broken XML: {document.message}")
        else:
            for stray in _stray_texts(document):
                yield _judge(stray, name)


def _stray_texts(document: XmlDocument) -> Iterator[Span]:
    if not document.root.children and document.root.text.stated:
        yield document.root.text.span
    for element in document.elements:
        yield from element.stray_texts


def _judge(stray: Span, function: str) -> Finding:
    if _HARMLESS.issuperset(stray.text):
        return finding(
            stray,
            "stray quotation mark between elements",
            severity=Severity.INFO,
            key=f"{function} mark",
        )
    inside = f"in <{stray.element.rpartition('/')[2].partition('[')[0]}>"
    where = inside if "/" in stray.element else "outside all elements"
    excerpt = " ".join(stray.text.split())[:60]
    return finding(
        stray, f"{function} emits the text {excerpt!r} {where}", severity=Severity.WARNING
    )


def _spawner(inside: str, behind: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  <<-HEREDOC
    <spawn name="#{{_name}}">
{inside}
      <name>#{{_name}}</name>
    </spawn>{behind}
  HEREDOC
end

def rosExecutables(_name, _worldName)
  ""
end
"""


_MARK = "<!-- ^ SPW004 -->"

GOOD = [{"launch/spawner.rb": _spawner("<!-- gas -->")}]
BAD = [
    {"launch/spawner.rb": _spawner(f'<!-- gas -->"{_MARK}')},
    {"launch/spawner.rb": _spawner(f"is_performer>true{_MARK}")},
    {"launch/spawner.rb": _spawner("", f" the end{_MARK}")},
    {"launch/spawner.rb": _spawner(f"<world></wrld>{_MARK}")},
]
