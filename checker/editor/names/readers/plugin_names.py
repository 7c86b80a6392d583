"""Names in the parameters of a plugin, and in a sensor, of SDF or of URDF's `<gazebo>`."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping

from checker.base.resources import table
from checker.editor.names.mention import (
    FRAMES,
    LINK_ONLY,
    TOPIC_ONLY,
    NameKind,
    Role,
    WrittenName,
)
from checker.editor.names.readers.expressions import is_computed
from checker.editor.names.readers.topics import is_topic, topic_key
from checker.editor.names.readers.values import names_in, scoped_names, words_in
from checker.source.text import Located
from checker.source.xml import Element

_LINE_END = re.compile(r"\r\n|[\r\n\t]")
NAMESPACE = "robotNamespace"
"""Parameter that is a prefix of the topics of some plugins."""
RESERVED = frozenset({"", "world", "__model__", "__root__"})
"""Names of frames that are always there."""
_LISTS = ("joints", "links", "jointname", "jointnames", "wheelnames")
"""Endings of tags whose text is a list."""


def is_topic_tag(tag: str) -> bool:
    """Return whether the text of a tag is a topic."""
    return tag.lower().endswith("topic") or tag.lower().endswith("topicname")


def verbatim(text: Located[str] | None) -> Located[str] | None:
    """Return a text as the file writes it; None where entities are in it.

    XML makes the line ends in an attribute blanks.
    """
    if text is None or not text.stated:
        return None
    raw = text.span.text
    if raw == text.value:
        return text
    return Located(raw, text.span) if _LINE_END.sub(" ", raw) == text.value else None


def plugin_names(plugin: Element, prefix: str) -> Iterator[WrittenName]:
    """Yield what the parameters of a plugin name.

    Args:
        plugin: The element.
        prefix: The prefix of the model that it belongs to: empty, or `robot::`.
    """
    namespace = plugin.child(NAMESPACE)
    space = namespace.value if namespace is not None else ""
    known = table("plugin_references")["plugins"].get(_class(plugin), {})
    waiting = [(child, child.tag) for child in reversed(plugin.children)]
    while waiting:
        element, path = waiting.pop()
        for name in element.attributes:
            text = verbatim(element.attribute(name))
            if text is not None and ":" not in name:
                yield from _parameter(text, name, f"{path}/@{name}", prefix, known)
        waiting += [(child, f"{path}/{child.tag}") for child in reversed(element.children)]
        if not element.children and (text := verbatim(element.text)) is not None:
            if is_topic_tag(element.tag):
                yield from topic_named(text, space)
            else:
                yield from _parameter(text, element.tag, path, prefix, known)


def _class(plugin: Element) -> str:
    return (plugin.get("name") or "").rpartition("::")[2]


def _parameter(
    text: Located[str], tag: str, path: str, prefix: str, known: Mapping[str, str]
) -> Iterator[WrittenName]:
    kind = known.get(path)
    start = text.span.start
    if kind in ("joint", "link"):
        yield from scoped_names(text.value, start, (NameKind(kind),), Role.NAMES, prefix)
    elif "frame" in tag.lower():
        yield from frame_named(text, prefix)
    elif tag.lower().endswith(_LISTS) and ("," in text.value or " " in text.value):
        yield from words_in(text.value, start, tag)
    else:
        yield from names_in(text.value, start, tag)


def topic_named(text: Located[str], space: str = "") -> Iterator[WrittenName]:
    """Yield the topic that a sensor or plugin states.

    Args:
        text: The topic.
        space: What the plugin puts in front of it: `model/X1`.
    """
    if not is_topic(text.value):
        return
    key, own = topic_key(text.value)
    if space and not text.value.startswith("/"):
        key, own = topic_key(f"{space.strip('/')}/{text.value}")[0], 0
    start = text.span.start
    if key[-1:] not in ("", "/"):
        end = start + len(text.value)
        yield WrittenName(TOPIC_ONLY, key, start + own, end, Role.DEFINES)


def frame_named(text: Located[str], prefix: str = "") -> Iterator[WrittenName]:
    """Yield the frame that a sensor or plugin publishes: `odom`, `X1/base_link`."""
    value, start = text.value, text.span.start
    if "::" in value:
        yield from scoped_names(value, start, FRAMES, Role.NAMES, prefix)
        return
    first = value.rfind("/", 0, len(value)) + 1
    last = value[first:]
    if last not in RESERVED and not is_computed(last) and not last.isspace():
        yield WrittenName(FRAMES, prefix + last, start + first, start + len(value), Role.STATES)


def sensor_names(sensor: Element, prefix: str) -> Iterator[WrittenName]:
    """Yield what the elements of a sensor name: topics, frames, links of contacts."""
    for element in sensor.descendants():
        if element.children or any(_is_in_plugin(element, sensor)):
            continue
        text = verbatim(element.text)
        if text is None:
            continue
        if is_topic_tag(element.tag):
            yield from topic_named(text)
        elif "frame" in element.tag and element.tag != "reference_frame":
            yield from frame_named(text, prefix)
        elif element.tag == "collision" and "::" in text.value:
            link = text.value.rpartition("::")[0]
            yield from scoped_names(link, text.span.start, LINK_ONLY, Role.MAY_NAME, prefix)


def _is_in_plugin(element: Element, sensor: Element) -> Iterator[bool]:
    above = element.parent
    while above is not None and above is not sensor:
        yield above.tag == "plugin"
        above = above.parent
