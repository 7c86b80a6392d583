"""The robots that a xacro file makes with other values of its arguments."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.formats.urdf.description import UrdfDescription, read_description
from checker.formats.xacro.expanded import ExpandedText
from checker.formats.xacro.expansion import Expander, Expansions, Wanted
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.package.package import Package
from checker.robots.further_values import alternatives, further_values
from checker.source.xml import XmlDocument

TRIED_LIMIT = 8
"""Values that are tried of one package: they take as long as the robots of the defaults."""
_OF_THE_USER = (
    *(XacroFaultKind.ARGUMENT, XacroFaultKind.ENVIRONMENT),
    *(XacroFaultKind.RECURSION, XacroFaultKind.LIMIT),
)
"""Faults that may be absent with another value."""


class Made(Record, eq=False):
    """A robot that a file makes.

    Attributes:
        wish: What was expanded.
        document: The result.
        allowed: Values that a launch file allows for arguments, by name.
        loaded: Whether a launch file loads it.
    """

    wish: Wanted
    document: XmlDocument
    allowed: Mapping[str, tuple[str, ...]]
    loaded: bool = False

    @property
    def read(self) -> Sequence[XmlDocument]:
        """The documents that it is made of."""
        source = self.document.source
        return source.read if isinstance(source, ExpandedText) else ()

    def with_value(self, name: str, value: str) -> Wanted:
        """Return what to expand with another value, without the given values that it excludes."""
        instead = alternatives(self.read, name)
        kept = {
            other: given
            for other, given in self.wish.args.items()
            if other not in instead or given.lower() != value.lower()
        }
        return replace(self.wish, args={**kept, name: value})

    def unloaded(self, name: str, value: str) -> str:
        """Return that no launch file gives a value, as a clause; empty if one may."""
        if not self.loaded or value in self.allowed.get(name, ()):
            return ""
        return f"only with {name}:={value}, which no launch file gives by default"


def other_robots(
    package: Package, expander: Expander, made: Sequence[Made], given: Collection[str]
) -> Iterator[UrdfDescription | XacroFault]:
    """Yield the robots that another value of one argument makes, and the faults that it meets.

    Args:
        package: The package being checked.
        expander: Expands the files.
        made: The robots that are judged.
        given: Names of the arguments that the user gives: these have one value.
    """
    tried = [
        (robot.with_value(name, value), f"{name}:={value}", robot.unloaded(name, value))
        for robot in sorted(made, key=_importance)
        for name, value in _further_values(package, robot)
        if name not in given
    ][:TRIED_LIMIT]
    wanted = [wish for wish, *_ in tried]
    outcomes = Expansions(package, wanted, expander).outcomes() if wanted else []
    known = {(robot.wish.path, robot.document.source.text) for robot in made}
    for (wish, values, unloaded), outcome in zip(tried, outcomes, strict=True):
        if isinstance(outcome, XacroFault) and outcome.kind not in _OF_THE_USER:
            yield replace(outcome, message=f"{outcome.message} (with {values})")
        elif isinstance(outcome, XmlDocument) and outcome.root.child("link"):
            key = wish.path, outcome.source.text
            if key in known:
                continue
            known.add(key)
            read = read_description(outcome, wish.path, for_rviz=False)
            yield replace(read, values=values, unloaded=unloaded)


def _importance(robot: Made) -> tuple[bool, bool]:
    """Return a key that sorts loaded robots first, and files of macros alone last."""
    return robot.document.root.child("link") is None, not robot.loaded


def _further_values(package: Package, robot: Made) -> list[tuple[str, str]]:
    return further_values(package, robot.read, robot.wish.args, robot.allowed)
