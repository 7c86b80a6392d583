"""Joins findings of a rule that are one fault, or faults alike, in many places."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from msgspec.structs import replace

from checker.base.words import shortened
from checker.engine.judge import GradedFinding
from checker.finding import Fix, Place, Safety, Severity
from checker.rule import Finding

TEXT_LIMIT = 1000
"""Characters of a message, note or reason; names in a package may be longer than any of them."""
ALIKE = 5
"""So many findings whose messages differ in names and numbers alone are one in many places."""
_NAME = re.compile(r"'[^']*'|\S*[\d_/<>]\S*")
"""Words of a message that differ between cases: quoted, or with characters of no plain word."""


def group_findings(findings: Iterable[GradedFinding]) -> list[list[GradedFinding]]:
    """Return the findings of one rule, grouped into those that are reported as one, in order.

    Those with one key, or one message, are one fault. Many that state the same of different parts
    have one cause, as have those that the copies of one line of a macro show.
    """
    faults: dict[tuple[Severity, str], list[GradedFinding]] = {}
    for finding in findings:
        fault = finding.severity, finding.key or finding.message
        faults.setdefault(fault, []).append(finding)
    alike: dict[tuple[Severity, str], list[list[GradedFinding]]] = {}
    for group in faults.values():
        alike.setdefault(_said(group[0]), []).append(group)
    together = {said for said, groups in alike.items() if _have_one_cause(groups)}
    grouped: dict[tuple[Severity, str], list[GradedFinding]] = {}
    for fault, group in faults.items():
        said = _said(group[0])
        grouped.setdefault(said if said in together else fault, []).extend(group)
    return list(grouped.values())


def _said(finding: GradedFinding) -> tuple[Severity, str]:
    return finding.severity, _NAME.sub("", finding.message)


def _have_one_cause(groups: Sequence[Sequence[Finding]]) -> bool:
    places = [group[0].places[0] for group in groups]
    spots = {(place.file, place.line, place.column) for place in places}
    elements = {place.element for place in places if place.element}
    are_copies = len(spots) == 1 and len(elements) == len(groups)
    return len(groups) >= ALIKE or are_copies


def joined_places(group: Sequence[Finding]) -> tuple[Place, ...]:
    """Return the places of findings that are one, each once, with what differs from the first."""
    places: dict[tuple[str, int, int, str, str], Place] = {}
    said = group[0].message
    for finding in group:
        own = "" if finding.message == said else shortened(finding.message, TEXT_LIMIT)
        for number, bounded in enumerate(bounded_places(finding.places)):
            place = replace(bounded, message="" if number else own)
            # Robots that share a file have the same fault at the same place.
            spot = (place.file, place.line, place.column, place.note, place.message)
            places.setdefault(spot, place)
    return tuple(places.values())


def bounded_places(places: Sequence[Place]) -> tuple[Place, ...]:
    """Return places with notes of bounded length."""
    return tuple(replace(place, note=shortened(place.note, TEXT_LIMIT)) for place in places)


def joined_fix(fixes: Sequence[Fix]) -> Fix | None:
    """Return one fix that makes all edits; it is as safe as the least safe of them."""
    if not fixes:
        return None
    edits = dict.fromkeys(edit for fix in fixes for edit in fix.edits)
    return Fix(max((fix.safety for fix in fixes), key=list(Safety).index), tuple(edits))
