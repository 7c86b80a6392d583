"""The robots that a xacro file makes with other values of its arguments."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from msgspec.structs import replace

from checker.base.record import Record
from checker.formats.urdf.description import UrdfDescription, read_description
from checker.formats.xacro.expanded import ExpandedText
from checker.formats.xacro.expansion import Expander, Expansions, Wanted
from checker.formats.xacro.fault import XacroFault, XacroFaultKind
from checker.model.robot import OTHERS_SIMULATED
from checker.package.package import Package
from checker.robots.further_values import alternatives, defaults, further_values
from checker.source.xml import XmlDocument

TRIED_LIMIT = 8
"""Values of launch files that are tried of one package, and others; each takes as long as the
robot of the defaults."""
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
        launched: What other launch files make of the file.
        shown: What launch files make of it that spawn nothing, beside those that spawn it.
    """

    wish: Wanted
    document: XmlDocument
    allowed: Mapping[str, tuple[str, ...]]
    loaded: bool = False
    launched: Sequence[Wanted] = ()
    shown: Sequence[Wanted] = ()

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

    def values_of(self, wish: Wanted) -> dict[str, str]:
        """Return the arguments of which another wish has another value."""
        own, other = ({**defaults(self.read), **each.args} for each in (self.wish, wish))
        return {name: value for name, value in other.items() if own.get(name) != value}

    def is_launched(self, name: str, value: str) -> bool:
        """Return whether another launch file gives a value, or leaves it as the default."""
        wishes = (*self.launched, *self.shown)
        given = (self.values_of(wish).get(name, "") for wish in wishes)
        return value.lower() in map(str.lower, given)

    def unloaded(self, name: str, value: str) -> str:
        """Return that no launch file gives a value, as a clause; empty if one may."""
        if not self.loaded or value in self.allowed.get(name, ()):
            return ""
        return f"only with {name}:={value}, which no launch file gives by default"


def other_robots(
    package: Package, expander: Expander, made: Sequence[Made], given: Collection[str]
) -> Iterator[UrdfDescription | XacroFault]:
    """Yield the robots that other values make, and the faults that they meet.

    Those that launch files give come first, then those of one argument each.

    Args:
        package: The package being checked.
        expander: Expands the files.
        made: The robots that are judged.
        given: Names of the arguments that the user gives: these have one value.
    """
    by_launch = [
        (wish, in_words(others), "", "" if wish in robot.launched else OTHERS_SIMULATED)
        for robot in made
        for wish in (*robot.launched, *robot.shown)
        if (others := robot.values_of(wish))
    ]
    single = [
        (robot.with_value(name, value), f"{name}:={value}", robot.unloaded(name, value), "")
        for robot in sorted(made, key=_importance)
        for name, value in _further_values(package, robot)
        if name not in given and not robot.is_launched(name, value)
    ]
    tried = [*by_launch[:TRIED_LIMIT], *single[:TRIED_LIMIT]]
    wanted = [wish for wish, *_ in tried]
    outcomes = Expansions(package, wanted, expander).outcomes() if wanted else []
    known = {(robot.wish.path, robot.document.source.text) for robot in made}
    for (wish, values, unloaded, shown), outcome in zip(tried, outcomes, strict=True):
        if isinstance(outcome, XacroFault) and outcome.kind not in _OF_THE_USER:
            yield replace(outcome, message=f"{outcome.message} (with {values})")
        elif isinstance(outcome, XmlDocument) and outcome.root.child("link"):
            key = wish.path, outcome.source.text
            if key in known:
                continue
            known.add(key)
            read = read_description(outcome, wish.path, for_rviz=False)
            yield replace(read, values=values, unloaded=unloaded, shown_only=shown)


def in_words(values: Mapping[str, str]) -> str:
    """Return values of arguments as a command line has them."""
    return " ".join(f"{name}:={value}" for name, value in values.items())


def _importance(robot: Made) -> tuple[bool, bool]:
    """Return a key that sorts loaded robots first, and files of macros alone last."""
    return robot.document.root.child("link") is None, not robot.loaded


def _further_values(package: Package, robot: Made) -> list[tuple[str, str]]:
    return further_values(package, robot.read, robot.wish.args, robot.allowed)
