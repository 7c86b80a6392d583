"""Scope at one point of a launch file: args, namespace, remaps."""

from __future__ import annotations

import posixpath
from collections import ChainMap
from dataclasses import dataclass, field
from types import MappingProxyType

import msgspec

from checker.base.record import Record
from checker.launch.ros1.graph import Remap, resolve_name
from checker.source.text import Located, Span
from checker.source.xml import XmlDocument

HERE = "./"
Chain = tuple[tuple[str, frozenset[tuple[str, str]]], ...]


class LaunchFile(Record, eq=False):
    """One file being expanded.

    Attributes:
        document: Its XML.
        given: Args that the command line or the including file passes.
        included_at: The `<include>` that names it; None for the entry file.
        overrides_constants: Whether the args came by `pass_all_args`.
        chain: The files around it with what they were given, itself last.
        shown_at: The `<include>` that names it, or for a file around it, where the file is the
            challenge's own: what it starts is that include's doing. None for other files.
        declared: Names declared anywhere in it so far, each with value and place.
    """

    document: XmlDocument
    given: MappingProxyType[str, str]
    included_at: Span | None
    overrides_constants: bool
    chain: Chain
    shown_at: Span | None = None
    declared: dict[str, Located[str]] = msgspec.field(default_factory=dict)

    @property
    def name(self) -> str:
        """Its path, as `SourceText.file` states it."""
        return self.document.source.file

    @property
    def directory(self) -> str:
        """Value of `$(dirname)`: `./` and the folder, relative to the package folder."""
        return HERE + posixpath.dirname(self.name)


def args_of(file: LaunchFile) -> ChainMap[str, str]:
    """Return the args with which a file begins: roslaunch knows those given undeclared, too."""
    return ChainMap({}, dict(file.given))


@dataclass(eq=False)
class Scope:
    """Scope inside one group, file or node.

    Attributes:
        file: The file being expanded.
        args: Values of args by name; a group sees those outside it and hides its own.
        namespace: Absolute.
        remaps: The remaps in order of the file.
        depth: The number of groups and files around it.
    """

    file: LaunchFile
    args: ChainMap[str, str]
    namespace: str = "/"
    remaps: list[Remap] = field(default_factory=list)
    depth: int = 0

    def inner(self, namespace: str) -> Scope:
        """Return the scope inside a group or an included file."""
        return Scope(
            self.file,
            self.args.new_child(),
            resolve_name(namespace, self.namespace),
            list(self.remaps),
            self.depth + 1,
        )

    def of_file(self, file: LaunchFile) -> Scope:
        """Return the scope of an included file: namespace and remaps reach in, args do not."""
        return Scope(file, args_of(file), self.namespace, self.remaps, self.depth)

    def declares(self, name: str) -> bool:
        """Return whether an arg is declared here or around; one that is only given is not."""
        return any(name in declared for declared in self.args.maps[:-1])

    def remaps_with(self, own: list[Remap]) -> tuple[Remap, ...]:
        """Return the remaps in force for a node with its own remaps; the strongest first."""
        inherited = (
            Remap(remap.source, remap.target, remap.span, inherited=True)
            for remap in reversed(self.remaps)
        )
        return (*reversed(own), *inherited)
