"""Names in Ruby: the strings of a spawner, and the XML that it emits.

The text is read as it is: names that Ruby puts together are expressions.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from checker.editor.names.mention import WrittenName
from checker.editor.names.readers.plugin_names import (
    NAMESPACE,
    frame_named,
    is_topic_tag,
    topic_named,
)
from checker.editor.names.readers.values import names_in, words_in
from checker.source.text import Located, SourceText, Span

_TEXT = re.compile(
    r"""<([A-Za-z_][\w.:-]{0,60})(?:\s[^<>]{0,2000})?>([^<>\n]{1,2000})</"""
    r"""|(?<![\w])([A-Za-z_][\w-]{0,60})=\\?(["'])([^"'<>\\\n]{1,500})\\?\4"""
    r"""|(["'])((?:(?!\6)[^\\\n]){0,500})\6"""
    r"""|%[wWiI][\[({<]([^\])}>]{0,2000})[\])}>]"""
)
_COMMENT = re.compile(r"^[ \t]*#(?!\{)[^\n]*", re.MULTILINE)
_NAMESPACE = re.compile(rf"<{NAMESPACE}>([^<>\n]{{1,200}})</")
_PLUGIN_LIMIT = 10_000
"""Characters in front of a topic, and behind it, that its plugin may have."""
_WORDS = re.compile(r"[\s,]+")


def ruby_names(source: SourceText) -> Iterator[WrittenName]:
    """Yield the names of a Ruby file."""
    text = _COMMENT.sub(lambda match: " " * len(match.group()), source.text)
    for match in _TEXT.finditer(_without_xml_comments(text)):
        if match[1] is not None:
            yield from _of_element(source, match)
        elif match[3] is not None:
            yield from names_in(match[5], match.start(5), match[3])
        elif match[7] is not None:
            yield from names_in(match[7], match.start(7))
        else:
            yield from words_in(match[8], match.start(8))


def _without_xml_comments(text: str) -> str:
    """Return a text of the same length with blanks for the comments of the XML in it."""
    parts: list[str] = []
    at = 0
    while (start := text.find("<!--", at)) >= 0 and (end := text.find("-->", start)) >= 0:
        parts += [text[at:start], " " * (end + 3 - start)]
        at = end + 3
    return "".join([*parts, text[at:]])


def ruby_values(source: SourceText) -> frozenset[str]:
    """Return the strings of a Ruby file, which are possible values of its expressions."""
    found = (match[7] or match[5] or match[8] for match in _TEXT.finditer(source.text))
    return frozenset(word for text in found if text for word in (text, *_WORDS.split(text)))


def _of_element(source: SourceText, match: re.Match[str]) -> Iterator[WrittenName]:
    """Yield what an element that is emitted names."""
    tag, text = match[1], match[2].strip()
    start = match.start(2) + len(match[2]) - len(match[2].lstrip())
    located = Located(text, Span(source, start, start + len(text)))
    if is_topic_tag(tag):
        yield from topic_named(located, _namespace(source.text, start))
    elif "frame" in tag.lower():
        yield from frame_named(located)
    else:
        is_command = tag == "command"
        yield from names_in(text, start, "" if is_command else tag, words=is_command)


def _namespace(text: str, at: int) -> str:
    """Return what the plugin around a place puts in front of its topics; empty for nothing."""
    begun = text.rfind("<plugin", max(0, at - _PLUGIN_LIMIT), at)
    ended = text.find("</plugin", at, at + _PLUGIN_LIMIT)
    if begun < 0 or ended < 0:
        return ""
    found = _NAMESPACE.search(text, begun, ended)
    return found[1].strip() if found else ""
