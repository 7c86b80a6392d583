"""Common parts of actions: texts, names, words, parameters and remaps."""

from __future__ import annotations

from collections.abc import Iterator

from checker.launch.ros1.graph import Remap, resolve_name
from checker.launch.ros2.actions.node_parameters import UNKNOWN, read_parameters
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import Parameters, Unread
from checker.launch.ros2.substitutions import perform
from checker.launch.ros2.values import Guarded, Made, Unknown, Value, chosen_value, span_of
from checker.source.text import Located, Span


def text_of(made: Made, name: str, context: Context, unread: list[Unread]) -> Located[str]:
    """Return a text of an action; what is not known is noted."""
    if made.values.get(name) is None:
        return Located("", made.span, stated=False)
    text = perform(made.values[name], context, made.span)
    if isinstance(text, Unknown):
        unread.append(Unread(text.reason, text.span))
    return with_place(text, made.span)


def namespace_of(made: Made, context: Context) -> str:
    """Return the namespace that an action puts its node into."""
    value = made.values.get("namespace")
    text = perform(value, context, made.span) if value is not None else ""
    if isinstance(text, Unknown):
        text = UNKNOWN
    return resolve_name(str(text), context.state.namespace)


def words_of(
    value: Value, context: Context, span: Span, unread: list[Unread]
) -> Iterator[Located[str]]:
    """Yield the words of a command line; those that a condition leaves out are none."""
    value = chosen_value(value)
    if value is None:
        return
    if isinstance(value, Unknown):
        unread.append(Unread(value.reason, value.span))
        return
    for item in value if isinstance(value, list | tuple) else [value]:
        if isinstance(item, Guarded) and item.holds is False:
            continue
        text = perform(item, context, span)
        if isinstance(text, Unknown):
            unread.append(Unread(text.reason, text.span))
        yield with_place(text, span)


def parameters_of(value: Value, context: Context, span: Span, unread: list[Unread]) -> Parameters:
    """Return the parameters that an action states; what is not known is noted."""
    if value is None:
        return ()
    items = [*read_parameters(value, context, span)]
    unread += (item for item in items if isinstance(item, Unread))
    return tuple(item for item in items if not isinstance(item, Unread))


def remaps_of(made: Made, context: Context, unread: list[Unread]) -> tuple[Remap, ...]:
    """Return the remaps of an action, and those around it."""
    value = chosen_value(made.values.get("remappings"))
    if isinstance(value, Unknown):
        unread.append(Unread(value.reason, value.span))
        value = None
    own = []
    for pair in map(chosen_value, value if isinstance(value, list | tuple) else ()):
        if not isinstance(pair, tuple | list) or len(pair) != 2:
            reason = pair.reason if isinstance(pair, Unknown) else "it is not a pair"
            unread.append(Unread(reason, span_of(pair, made.span)))
            continue
        source, target = (perform(part, context, made.span) for part in pair)
        unread += (Unread(t.reason, t.span) for t in (source, target) if isinstance(t, Unknown))
        where = span_of(source, made.span)
        own.append(Remap(text_or_unknown(source), text_or_unknown(target), where))
    return (*own, *context.state.remaps)


def with_place(value: Value, span: Span) -> Located[str]:
    """Return a text with its place; a text with a mark where it is not known."""
    return Located(text_or_unknown(value), span_of(value, span))


def text_or_unknown(value: Value) -> str:
    """Return a text, or the mark of one that is not known."""
    return str(value) if isinstance(value, str) else UNKNOWN


def texts_of(value: Value, context: Context, span: Span) -> dict[str, str]:
    """Return a mapping of texts, such as the environment of a node."""
    if not isinstance(value, dict):
        return {}
    return {
        text_or_unknown(perform(name, context, span)): text_or_unknown(perform(text, context, span))
        for name, text in value.items()
    }
