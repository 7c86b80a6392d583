"""Completions at a caret."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from checker.editor.completion import elements, expressions, plugins
from checker.editor.completion.files import files
from checker.editor.completion.item import Completion, Request, sort_by_rank
from checker.editor.completion.names import names
from checker.editor.target import usual_target
from checker.editor.xacro_names import PREFIX
from checker.editor.xml_context import Where, xml_context
from checker.engine.subject import Subject
from checker.rule import Context

_QUOTES = ("'", '"')


def completions_at(
    subject: Subject, path: str, text: str, offset: int, target: Context | None = None
) -> tuple[Completion, ...]:
    """Return what may be written at a caret, the likeliest first.

    Args:
        subject: The package, with the last text of the file that could be read.
        path: The path of the XML file, relative to the package.
        text: The current text of the file; it need not be well-formed.
        offset: The offset of the caret, in characters of that text.
        target: What the package is judged for; its usual target where it is None.
    """
    xml = xml_context(text, offset)
    at = min(max(offset, 0), len(text))
    judged = target or usual_target(subject.package)
    return sort_by_rank(_items(Request(subject, path, text, at, xml, judged)))


def _items(request: Request) -> Iterator[Completion]:
    match request.xml.where:
        case Where.TAG:
            yield from _elements(request)
        case Where.CLOSING:
            yield from elements.closing(request)
        case Where.ATTRIBUTE:
            yield from _attributes(request)
        case Where.VALUE:
            yield from _quoted(request, _values(request))
        case Where.TEXT:
            yield from _values(request)
            if not request.xml.typed:
                yield from _elements(request)


def _elements(request: Request) -> Iterator[Completion]:
    yield from elements.elements(request)
    yield from plugins.parameters(request)
    yield from expressions.tags(request)


def _attributes(request: Request) -> Iterator[Completion]:
    if request.xml.tag.startswith(PREFIX):
        yield from expressions.attributes(request)
    elif request.plugin is not None:
        yield from plugins.parameter_attributes(request)
    else:
        yield from elements.attributes(request)


def _values(request: Request) -> Iterator[Completion]:
    inside = expressions.expressions(request)
    if inside is not None:
        yield from inside
        return
    yield from names(request)
    yield from plugins.plugins(request)
    yield from files(request)
    if request.plugin is not None:
        yield from plugins.parameter_values(request)
    elif request.xml.tag.startswith(PREFIX):
        yield from expressions.values(request)
    else:
        yield from elements.values(request)


def _quoted(request: Request, items: Iterator[Completion]) -> Iterator[Completion]:
    """Yield values with quotes around them where none is behind the `=` yet."""
    in_front = request.text[request.xml.start - 1 : request.xml.start]
    for item in items:
        bare = in_front not in _QUOTES and item.start == request.xml.start
        yield replace(item, insert=f'"{item.insert}"') if bare else item
