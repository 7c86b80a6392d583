"""Known launch files of other packages: their arguments, and the nodes they start."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache

from msgspec import convert, field

from checker.base.record import Record
from checker.base.resources import table
from checker.launch.ros1.graph import Remap
from checker.launch.ros2.context import Context
from checker.launch.ros2.graph import (
    Condition,
    Node,
    NodeKind,
    Parameter,
    ParameterFile,
    Unread,
    is_known,
    share_path,
)
from checker.launch.ros2.substitutions import perform
from checker.launch.ros2.values import Unknown
from checker.source.text import Located, Span

_NAMESPACE = "namespace"
_TIME = "use_sim_time"
_UNKNOWN = "$(unknown)"


class _KnownNode(Record):
    package: str
    executable: str
    name: str
    parameters: str = ""
    remaps: Mapping[str, str] = field(default_factory=dict)
    in_some: bool = False
    differs: bool = False


class _KnownInclude(Record):
    file: str
    when: Mapping[str, str] = field(default_factory=dict)
    in_some: bool = False


class KnownFile(Record):
    """A launch file of another package.

    Attributes:
        arguments: The arguments that it reads in any distribution, with their defaults.
        nodes: The nodes that it starts itself.
        includes: Other known files that it includes.
    """

    arguments: Mapping[str, str]
    nodes: tuple[_KnownNode, ...] = ()
    includes: tuple[_KnownInclude, ...] = ()


@cache
def _files() -> Mapping[str, KnownFile]:
    return convert(table("launch_files")["files"], dict[str, KnownFile])


def known_file(target: str) -> KnownFile | None:
    """Return what is known of the launch file at a path; None if nothing is."""
    path = share_path(target)
    return _files().get(f"{path.package}/{path.path}") if path is not None else None


def nodes_of(file: KnownFile, context: Context, span: Span) -> Iterator[Node]:
    """Yield the nodes that a known file starts; those that only some distributions have are unsure.

    Args:
        file: The included file.
        context: The context of the include, its arguments among the configurations.
        span: The span of the include.
    """
    given = {name: _value(name, file, context, span) for name in file.arguments}
    for node in file.nodes:
        yield _node(node, given, context.under(_unsure(span, in_some=node.in_some)), span)
    for include in file.includes:
        conditions = (
            *_conditions(include.when, given, span),
            *_unsure(span, in_some=include.in_some),
        )
        yield from nodes_of(_files()[include.file], context.under(conditions), span)


def _value(name: str, file: KnownFile, context: Context, span: Span) -> str:
    """Return the value of an argument; a text with a mark where it is not known."""
    value = context.state.configurations.get(name, file.arguments[name])
    text = perform(value, context, span)
    return _UNKNOWN if isinstance(text, Unknown) else str(text)


def _conditions(
    when: Mapping[str, str], given: Mapping[str, str], span: Span
) -> Iterator[Condition]:
    for name, expected in when.items():
        holds = given[name].lower() == expected if is_known(given[name]) else None
        yield Condition(Located(given[name], span), wanted=True, holds=holds)


def _unsure(span: Span, *, in_some: bool) -> Iterator[Condition]:
    if in_some:
        text = Located("whether the distribution starts it", span, stated=False)
        yield Condition(text, wanted=True, holds=None)


def _node(known: _KnownNode, given: Mapping[str, str], context: Context, span: Span) -> Node:
    files = [ParameterFile(given[it], False, span) for it in [known.parameters] if it]
    rewritten = [Parameter(_TIME, _UNKNOWN, True, False, span)] if _TIME in given else []
    differs = Unread("its arguments differ by distribution", span)
    return Node(
        kind=NodeKind.INCLUDED,
        package=Located(known.package, span, stated=False),
        executable=Located(known.executable, span, stated=False),
        name=Located(known.name, span, stated=False),
        namespace=_UNKNOWN if given.get(_NAMESPACE) else context.state.namespace,
        parameters=(*context.state.parameters, *files, *rewritten),
        remaps=(
            *(Remap(source, target, span) for source, target in known.remaps.items()),
            *context.state.remaps,
        ),
        unread=(differs,) if known.differs else (),
        conditions=context.conditions,
        after=context.after,
        span=span,
    )
