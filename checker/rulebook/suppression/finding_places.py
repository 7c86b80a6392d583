"""Place of a finding in words that stay when lines move, for the baseline."""

from __future__ import annotations

import re
from collections.abc import Hashable, Iterator

from checker.base.record import Record
from checker.finding import Place, Severity, fingerprint, without_line_numbers
from checker.report.report import ReportedFinding

NAME_LIMIT = 300
"""Characters of a place's name; what is longer ends in its fingerprint."""

ELEMENT_MARK = "#"
_COMPARED = 900
"""Characters; reports shorten longer messages."""


class Spot(Record):
    """One main place of a finding.

    Attributes:
        rule: Id of the rule.
        place: File and element, as `place_name` gives them.
        key: What the finding's places have in common; empty if that is the message.
    """

    rule: str
    severity: Severity
    place: str
    key: str
    message: str


def spot(rule: str, severity: Severity, place: Place, key: str, message: str) -> Spot:
    """Return what the baseline keeps of one place of a finding."""
    own_key = "" if key[:_COMPARED] == message[:_COMPARED] else key
    return Spot(rule, severity, place_name(place, own_key), own_key, message)


def spots_of(finding: ReportedFinding) -> Iterator[Spot]:
    """Yield the main places of a finding; the others have notes."""
    for number, place in enumerate(finding.places):
        if number == 0 or not place.note:
            message = place.message or finding.message
            yield spot(finding.rule, finding.severity, place, finding.key, message)


def place_name(place: Place, key: str) -> str:
    """Name a place by file and element: `model.sdf#sdf/model[rover]/link[base]`.

    Without an element the message has to do. Findings that are joined by a key differ in their
    messages; there, the words of the line are a part of the name.
    """
    file = re.sub("[%#:]", lambda mark: f"%{ord(mark[0]):02X}", place.file or ".")
    name = file
    if place.element:
        name += f"{ELEMENT_MARK}{place.element}"
    elif key and place.snippet.strip():
        name += f": {' '.join(place.snippet.split())}"
    return name if len(name) <= NAME_LIMIT else f"{name[: NAME_LIMIT - 17]}…{fingerprint(name)}"


def by_words(rule: str, place: str, key: str, message: str) -> Hashable:
    """Return what a fault of the same words at the same place has in common with this one."""
    return rule, place, key or without_line_numbers(message)


def by_element(rule: str, place: str, key: str, _message: str) -> Hashable:
    """Return what a fault of the same element has in common: a value may change, and the words.

    None if there is no element.
    """
    return (rule, place, key) if ELEMENT_MARK in place else None
