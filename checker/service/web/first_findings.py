"""What a stored report says at a glance: a verdict for each package, and the gravest findings."""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path

from checker.base.record import Record
from checker.base.words import plain, shortened
from checker.report.from_json import report_from_json
from checker.report.report import ReportedFinding
from checker.service.store.store import Store

SHOWN = 20
"""Findings at a glance; the report shows all."""
SIZE_LIMIT = 20_000_000
"""Bytes of a report that is read for a glance; a larger one takes seconds."""
_TEXT_LIMIT = 300


class FirstFinding(Record):
    """A finding in a line.

    Attributes:
        package: Its name.
        where: `model.sdf:12:3`, or the package's folder.
    """

    severity: str
    rule: str
    name: str
    message: str
    where: str
    package: str


class Glance(Record):
    """The beginning of a report.

    Attributes:
        findings: The gravest, at most `SHOWN`.
        more: How many others there are.
    """

    findings: tuple[FirstFinding, ...] = ()
    more: int = 0


def glance(store: Store, key: str) -> Glance | None:
    """Return the beginning of a stored report; None if it is not there or too large to read."""
    path = store.file(key, "report.json") if key else None
    try:
        return _read(path) if path is not None else None
    except OSError:
        return None


@lru_cache(maxsize=64)
def _read(path: Path) -> Glance | None:
    """Read a report; what lies under a key never changes."""
    try:
        if path.stat().st_size > SIZE_LIMIT:
            return None
        report = report_from_json(path.read_text("utf-8"))
    except ValueError:
        return None
    found = [(package.name, each) for package in report.packages for each in package.findings]
    found.sort(key=lambda pair: pair[1].severity.rank)
    shown = tuple(_first(name, each) for name, each in found[:SHOWN])
    return Glance(shown, len(found) - len(shown))


def _first(package: str, finding: ReportedFinding) -> FirstFinding:
    place = finding.places[0]
    where = f"{place.file}:{place.line}:{place.column}" if place.file else "the package's folder"
    return FirstFinding(
        str(finding.severity),
        *map(_short, (finding.rule, finding.name, finding.message, where, package)),
    )


def _short(text: str) -> str:
    return plain(shortened(text, _TEXT_LIMIT))
