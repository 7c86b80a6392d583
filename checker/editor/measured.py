"""Results of weights, views of sensors and the trial, kept while the text changes."""

from __future__ import annotations

from collections.abc import Collection

from msgspec.structs import replace

from checker.base.record import Record
from checker.finding import Place
from checker.package.package import Package
from checker.report.report import PackageReport, ReportedFinding
from checker.source.text import SourceText
from checker.source.xml import XmlDocument


class Measured(Record, eq=False):
    """A check with weights and trial.

    Attributes:
        package: The package in the state that was checked.
        report: The result.
        rules: Ids of the rules that need what is measured.
    """

    package: Package
    report: PackageReport
    rules: Collection[str]

    def findings_in(self, package: Package) -> tuple[ReportedFinding, ...]:
        """Return what was found, at its places in another state; what is gone is left out."""
        found = []
        for finding in self.report.findings:
            if finding.rule in self.rules:
                places = [
                    moved
                    for place in finding.places
                    if (moved := self._current_place(place, package))
                ]
                if places and not places[0].note:
                    found.append(replace(finding, places=tuple(places), fix=None))
        return tuple(found)

    def _current_place(self, place: Place, package: Package) -> Place | None:
        """Return where the element of a place is now; None if it is not any more."""
        if not place.file or _text(self.package, place.file) == _text(package, place.file):
            return place
        document = package.xml(place.file)
        if not isinstance(document, XmlDocument) or not place.element:
            return None
        same = (each for each in document.elements if each.path == place.element)
        element = next(same, None)
        return None if element is None else element.span.place(place.note)


def _text(package: Package, path: str) -> str | None:
    source = package.read(path)
    return source.text if isinstance(source, SourceText) else None
