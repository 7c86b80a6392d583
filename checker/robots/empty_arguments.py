"""Arguments of xacro that are empty by default and that a launch file is to give."""

from __future__ import annotations

from collections.abc import Collection

from checker.formats.xacro.expansion import Outcome
from checker.formats.xacro.fault import XacroFault
from checker.package.package import Package
from checker.robots.candidates import Candidate
from checker.source.xml import XmlDocument

SAMPLE = "1"
"""A text that is also a number, for an argument whose value is not known."""


def empty_arguments(package: Package, candidate: Candidate, given: Collection[str]) -> list[str]:
    """Return the arguments of a file that are empty unless given.

    A launch file that loads the file and does not name an argument leaves it empty permanently.

    Args:
        package: The package that contains the file.
        candidate: The file.
        given: Names of the arguments that the user gives.
    """
    document = package.xml(candidate.path)
    root = document.root if isinstance(document, XmlDocument) else None
    declared = root.all("xacro:arg") if root is not None else ()
    names = [arg.get("name") or "" for arg in declared if arg.get("default") == ""]
    known = {*given, *candidate.args}
    return [
        name
        for name in names
        if name not in known and (not candidate.loaded or name in candidate.missing)
    ]


def is_refused_alike(outcome: Outcome, other: Outcome) -> bool:
    """Return whether a file is refused for the same reason with other arguments."""
    if not isinstance(outcome, XacroFault) or not isinstance(other, XacroFault):
        return False
    return (outcome.message, outcome.span.place()) == (other.message, other.span.place())
