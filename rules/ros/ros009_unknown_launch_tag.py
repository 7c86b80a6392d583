"""A tag or attribute that roslaunch does not know, or a missing required one.

roslaunch prints one warning in its log and continues: a misspelt `<remap srom=…>` renames nothing,
and the topic keeps a name to which no node subscribes. Without a required attribute roslaunch does
not start, and the robot has no topics.

Fix: spell the tag or attribute as roslaunch does, or move it to where roslaunch reads it.
Source: roslaunch XML specification (`roslaunch_tags.json`); reviewed packages with `<node>` tags
that end before their attributes.
"""

import re
from collections.abc import Iterator, Mapping

from checker.base.words import Suggestions, is_slip
from checker.launch.ros1.attributes import LaunchTag, launch_tags, left_outside
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, replace_text, rule
from checker.source.text import Span
from checker.source.xml import Element, XmlDocument

_BEHIND = 2000
"""Characters after a tag in which its second `>` is searched."""
_OTHER_LAUNCHERS = ("ignition", "gz")
"""Root tags of files that `ign launch` starts."""


@rule("ROS009", "unknown-launch-tag", Severity.ERROR, Concern.INTERFACE)
def check(package: Package) -> Findings:
    """Compare the package's own launch files with the tags that roslaunch knows."""
    known = launch_tags()
    tags = Suggestions(known)
    attributes = {name: Suggestions(sorted(tag.attributes)) for name, tag in known.items()}
    for file in package.index.with_suffix(".launch"):
        document = package.xml(file.path)
        if not isinstance(document, XmlDocument) or document.root.tag in _OTHER_LAUNCHERS:
            continue
        if document.root.tag != "launch":
            yield finding(
                document.root, f"the root tag is <{document.root.tag}>, expected <launch>"
            )
            continue
        for element in _known_elements(document.root, known):
            yield from _children(element, known, tags)
            yield from _attributes(element, known[element.tag], attributes[element.tag])


def _known_elements(root: Element, known: Mapping[str, LaunchTag]) -> Iterator[Element]:
    """Yield the elements that roslaunch reads, without the content of unknown ones."""
    waiting = [root]
    while waiting:
        element = waiting.pop()
        yield element
        waiting.extend(child for child in reversed(element.children) if child.tag in known)


def _children(
    parent: Element, known: Mapping[str, LaunchTag], tags: Suggestions
) -> Iterator[Finding]:
    for child in parent.children:
        if child.tag in known[parent.tag].children or ":" in child.tag:
            continue
        if child.tag in known:
            message = f"<{child.tag}> has no effect inside <{parent.tag}>"
            yield finding(child, message, severity=Severity.WARNING)
        else:
            near = tags.closest(child.tag)
            hint = f"; did you mean <{near}>?" if near else ""
            yield finding(child, f"<{child.tag}> is not a tag of roslaunch{hint}")


def _attributes(element: Element, tag: LaunchTag, names: Suggestions) -> Iterator[Finding]:
    stated = element.attributes
    outside = left_outside(element)
    missing = [name for name in tag.required if name not in stated]
    if any(name in outside for name in missing):
        yield _closed_early(element, list(outside))
        return
    for name in stated:
        if name in tag.attributes or ":" in name:
            continue
        near, sure = names.closest(name), names.correction(name)
        if near is None and len(missing) == 1:
            near = missing[0]
            sure = near if is_slip(name, near) else None
        missing = [attribute for attribute in missing if attribute != near]
        span = element.attribute_name_span(name)
        yield finding(
            span,
            f"<{element.tag}> has no attribute {name!r}"
            + (f"; did you mean {near!r}?" if near else ""),
            key=f"{element.tag} {name}",
            fix=replace_text(span, sure, Safety.UNSAFE) if sure and sure not in stated else None,
        )
    if missing:
        yield finding(
            element, f"<{element.tag}> lacks {_name_list(missing)}, which roslaunch requires"
        )


def _closed_early(element: Element, outside: list[str]) -> Finding:
    end = element.span.end
    bracket = Span(element.source, end - 1, end, element)
    behind = re.match(r"[^<>]*>", element.source.text[end : end + _BEHIND])
    closed_again = bracket.text == ">" and behind is not None
    return finding(
        element,
        f"<{element.tag}> is closed before its attributes: move {_name_list(outside)} in front of "
        "its '>'",
        key=f"{element.tag} closed",
        fix=replace_text(bracket, "", Safety.UNSAFE) if closed_again else None,
    )


def _name_list(names: list[str]) -> str:
    return ", ".join(repr(name) for name in names[:8])


_TOPICS = "launch/vehicle_topics.launch"
_MARK = "  <!-- ^ ROS009 -->"


def _launch(content: str, mark: str = "") -> dict[str, str]:
    return {_TOPICS: f"<launch>\n{content}{mark}\n</launch>\n"}


def _node(content: str = "", mark: str = "") -> dict[str, str]:
    return _launch(f'<node pkg="p" type="t" name="n">\n{content}{mark}\n</node>')


GOOD = [
    _node('<remap from="a" to="b" if="1"/>\n<param name="rate" value="5"/>'),
    _launch('<arg name="x" default="1" doc="how many"/>'),
    _launch('<rosparam ns="n" subst_value="true">\na: 1\n</rosparam>'),
    {"launch/example.launch": '<ignition version="1.0"><plugin name="p"/></ignition>\n'},
]
BAD = [
    _node('<remap srom="a" to="b"/>', _MARK),
    _node('<arg name="a" value="b"/>', _MARK),
    _launch('<nod pkg="p" type="t" name="n"><odd/></nod>', _MARK),
    _launch('<node pkg="p" type="t" name="n" arg="a"/>', _MARK),
    _launch('<node pkg="p" name="n"/>', _MARK),
    _launch(f'<node>{_MARK}\n  pkg="p" type="t" name="n">\n</node>'),
    {"launch/other.launch": f"<lunch>{_MARK}\n</lunch>\n"},
]
