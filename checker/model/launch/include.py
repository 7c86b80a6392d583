"""`<include>`: which file is meant, and what is handed over to it."""

from __future__ import annotations

import posixpath
import re
from collections.abc import Mapping
from types import MappingProxyType
from typing import Protocol

from checker.model.launch.graph import UnresolvedInclude
from checker.model.launch.reading import Reader, truth_of
from checker.model.launch.scope import HERE, Scope
from checker.model.launch.substitution import is_known
from checker.record import record
from checker.source.text import Located, Span
from checker.source.xml import Element, XmlDocument

_FOUND = re.compile(r"\$\(find\s+([^\s()]+)\s*\)/*(.*)\Z", re.DOTALL)


class MissingLaunchFile(str):
    """The reason of a resolver that has the package at hand, but no such file in it."""

    __slots__ = ()


class ReadLaunch(Protocol):
    """Finds an included launch file."""

    def __call__(self, package: str, path: str, from_file: str) -> XmlDocument | str:
        """Return the document, or the reason why it is not at hand.

        A reason that is a `MissingLaunchFile` makes a fault of it. The same file should be
        returned as the same document, so that it is parsed once.

        Args:
            package: Package that holds the file; empty when `path` starts where `from_file` does,
                at the package's folder.
            path: Path of the file, without `.` and `//`; it may start with `..`.
            from_file: The including file (`SourceText.file`).
        """
        ...


@record(eq=False)
class Inclusion:
    """An `<include>` as written, substitutions made.

    Attributes:
        package: Package of `$(find …)`, else empty.
        path: Path within the package; empty when it is not known before the launch.
        file: The `file` attribute.
        arguments: All that is handed over.
        argument_places: The `<arg>` elements below it, by name.
        passes_all: Whether `pass_all_args` is set.
        span: The start tag.
    """

    package: str
    path: str
    file: Located[str]
    arguments: MappingProxyType[str, str]
    argument_places: Mapping[str, Span]
    passes_all: bool
    span: Span

    def unresolved(self, namespace: str, reason: str) -> UnresolvedInclude:
        """Return the record of a file that is not at hand."""
        path = self.path or self.file.value
        arguments = self.arguments
        return UnresolvedInclude(self.package, path, arguments, namespace, str(reason), self.span)


def read_inclusion(reader: Reader, element: Element, scope: Scope) -> Inclusion:
    """Read an `<include>`."""
    file = reader.text(element, "file", scope) or Located("", element.span, stated=False)
    passes_all = truth_of(reader.value(element, "pass_all_args", scope)) or False
    arguments = dict(scope.args) if passes_all else {}
    places: dict[str, Span] = {}
    for child in element.all("arg"):
        if not reader.enabled(child, scope):
            continue
        given = reader.text(child, "value", scope) or reader.text(child, "default", scope)
        if given is not None:
            name = child.get("name") or ""
            arguments[name], places[name] = given.value, child.span
    package, path = target_of(file.value)
    given_arguments = MappingProxyType(arguments)
    return Inclusion(package, path, file, given_arguments, places, passes_all, element.span)


def target_of(file: str) -> tuple[str, str]:
    """Return package and path of an included file; an empty path when they are not known."""
    found = _FOUND.match(file)
    if found:
        package, path = found.groups()
    elif file.startswith(HERE):
        package, path = "", file
    else:
        return "", ""
    return package, posixpath.normpath(path) if path and is_known(path) else ""
