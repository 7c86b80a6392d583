"""YAML as values with places.

libyaml's events are put together here, without recursion: aliases represent the node they name and
are counted at their full size, so a small file cannot represent a huge one.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass, field

from yaml import (
    AliasEvent,
    CollectionEndEvent,
    CSafeLoader,
    MappingStartEvent,
    MarkedYAMLError,
    ScalarEvent,
    ScalarNode,
    YAMLError,
    parse,
)
from yaml.constructor import SafeConstructor
from yaml.events import CollectionStartEvent, DocumentEndEvent, Event, NodeEvent
from yaml.resolver import Resolver

from checker.base.files import NotReadable
from checker.base.record import Record
from checker.source.text import SourceText, Span

MAX_LENGTH = 1_000_000
MAX_NODES = 100_000
MAX_DEPTH = 100
MAX_NUMBER_LENGTH = 500
"""Characters of a number: to read one takes the square of its length, and these have a float."""

Plain = str | int | float | bool | None
_PLAIN_TAGS = {f"tag:yaml.org,2002:{name}" for name in ("null", "bool", "int", "float")}


class YamlFault(Record, eq=False):
    """One fault of a YAML file."""

    span: Span
    message: str


class YamlNode(Record, eq=False):
    """A value of a YAML file.

    Exactly one of `scalar`, `items` and `entries` holds it, as `kind` states.

    Attributes:
        kind: `scalar`, `sequence` or `mapping`.
        span: Its text; an alias is where the alias is written.
        scalar: The value of a scalar, by the rules of YAML 1.1.
        items: The values of a sequence.
        entries: Keys and values of a mapping, in order; a key may be there twice.
        size: Number of values in it, aliases counted in full.
        height: The depth of its nesting.
    """

    kind: str
    span: Span
    scalar: Plain = None
    items: tuple[YamlNode, ...] = ()
    entries: tuple[tuple[YamlNode, YamlNode], ...] = ()
    size: int = 1
    height: int = 1

    def get(self, key: Plain) -> YamlNode | None:
        """Return the value of a key of a mapping, the last when it is there twice."""
        result = None
        for name, value in self.entries:
            if name.kind == "scalar" and name.scalar == key and type(name.scalar) is type(key):
                result = value
        return result

    def plain(self) -> object:
        """Return the value as lists, dictionaries and scalars; keys that are none are left out."""
        if self.kind == "scalar":
            return self.scalar
        if self.kind == "sequence":
            return [item.plain() for item in self.items]
        return {name.scalar: value.plain() for name, value in self.entries if name.kind == "scalar"}


class YamlDocument(Record, eq=False):
    """The first document of a YAML file; `root` is None if it is empty or not readable."""

    source: SourceText
    root: YamlNode | None
    faults: tuple[YamlFault, ...] = ()


def read_yaml(source: SourceText) -> YamlDocument:
    """Read a YAML file."""
    builder = _Builder(source)
    if len(source.text) > MAX_LENGTH:
        builder.fault(source.whole(), f"is longer than {MAX_LENGTH} characters")
        return YamlDocument(source, None, tuple(builder.faults))
    try:
        root = builder.build(parse(source.text, Loader=CSafeLoader))
    except MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        at = min(mark.index, len(source.text)) if mark else 0
        builder.fault(Span(source, at, at), str(error.problem or error.context))
        root = None
    except YAMLError as error:
        builder.fault(source.whole(), str(error).splitlines()[0])
        root = None
    return YamlDocument(source, root, tuple(builder.faults))


def read_root(source: SourceText | NotReadable) -> YamlNode | None:
    """Return the value of a YAML file; None if it is empty, or cannot be read."""
    return read_yaml(source).root if isinstance(source, SourceText) else None


def is_yaml(text: str) -> bool:
    """Return whether a text is YAML to its end; `read_yaml` only reads its first value."""
    try:
        for _ in parse(text, Loader=CSafeLoader):
            pass
    except YAMLError:
        return False
    return True


@dataclass(eq=False)
class _Open:
    """A sequence or mapping whose end has not come yet."""

    event: CollectionStartEvent
    children: list[YamlNode] = field(default_factory=list)


class _Builder:
    def __init__(self, source: SourceText) -> None:
        self.faults: list[YamlFault] = []
        self._source = source
        self._anchors: dict[str, YamlNode] = {}
        self._resolver = Resolver()
        self._constructor = SafeConstructor()
        self._nodes = 0

    def fault(self, span: Span, message: str) -> None:
        self.faults.append(YamlFault(span, message))

    def build(self, events: Iterator[Event]) -> YamlNode | None:
        """Put the first document together; None if a bound is passed."""
        opened: list[_Open] = []
        for event in events:
            if isinstance(event, DocumentEndEvent):
                return None
            if isinstance(event, CollectionStartEvent):
                opened.append(_Open(event))
                if len(opened) > MAX_DEPTH:
                    self.fault(self._span(event), f"is nested more than {MAX_DEPTH} levels deep")
                    return None
                continue
            if isinstance(event, CollectionEndEvent):
                node = self._collection(opened.pop(), event)
            elif isinstance(event, (ScalarEvent, AliasEvent)):
                node = self._alias(event) if isinstance(event, AliasEvent) else self._leaf(event)
            else:
                continue
            self._nodes += node.size
            if node.height + len(opened) > MAX_DEPTH or self._nodes > MAX_NODES:
                self.fault(node.span, "expands to too many values or too deeply nested ones")
                return None
            if not opened:
                return node
            opened[-1].children.append(node)
        return None

    def _span(self, event: Event, end: Event | None = None) -> Span:
        first, last = event.start_mark, (end or event).end_mark
        start = first.index if first else 0
        return Span(self._source, start, max(start, last.index if last else 0))

    def _remember(self, event: NodeEvent, node: YamlNode) -> YamlNode:
        if event.anchor:
            self._anchors[event.anchor] = node
        return node

    def _leaf(self, event: ScalarEvent) -> YamlNode:
        # The library's resolver has no annotations.
        resolve: Callable[..., str] = self._resolver.resolve
        tag = event.tag or resolve(ScalarNode, event.value, event.implicit)
        value: Plain = event.value
        if tag in _PLAIN_TAGS:
            value = self._number(event, tag)
        return self._remember(event, YamlNode("scalar", self._span(event), scalar=value))

    def _number(self, event: ScalarEvent, tag: str) -> Plain:
        """Read a number, a truth value or nothing; its text when it cannot be read."""
        with suppress(ValueError, KeyError, IndexError, OverflowError):
            if len(event.value) <= MAX_NUMBER_LENGTH:
                value: Plain = self._constructor.construct_object(ScalarNode(tag, event.value))
                return value
        self.fault(self._span(event), f"{event.value[:40]!r} is not of type {tag}")
        return str(event.value)

    def _alias(self, event: AliasEvent) -> YamlNode:
        named = self._anchors.get(event.anchor or "")
        span = self._span(event)
        if named is None:
            self.fault(span, f"*{event.anchor} names no anchor before it")
            return YamlNode("scalar", span)
        return YamlNode(
            named.kind, span, named.scalar, named.items, named.entries, named.size, named.height
        )

    def _collection(self, opened: _Open, end: Event) -> YamlNode:
        event, children = opened.event, opened.children
        span = self._span(event, end)
        if children and not event.flow_style:
            # libyaml ends a block collection behind the blank lines and comments below it.
            span = Span(self._source, span.start, children[-1].span.end)
        size = 1 + sum(child.size for child in children)
        height = 1 + max((child.height for child in children), default=0)
        if isinstance(event, MappingStartEvent):
            entries = tuple(_merged(zip(children[::2], children[1::2], strict=True)))
            node = YamlNode("mapping", span, entries=entries, size=size, height=height)
        else:
            node = YamlNode("sequence", span, items=tuple(children), size=size, height=height)
        return self._remember(event, node)


def _merged(
    pairs: Iterator[tuple[YamlNode, YamlNode]],
) -> Iterator[tuple[YamlNode, YamlNode]]:
    """Yield entries; those of a mapping under the key `<<` come first, so that others win."""
    own = []
    for key, value in pairs:
        if key.scalar == "<<" and value.kind == "mapping":
            yield from value.entries
        else:
            own.append((key, value))
    yield from own
