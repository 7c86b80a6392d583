"""Paths of findings in the files of siblings, as they are on disk."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from msgspec.structs import replace

from checker.finding import Fix, Place
from checker.package.package import Package
from checker.report.report import ReportedFinding


def with_real_paths(
    package: Package, findings: Iterable[ReportedFinding]
) -> Iterator[ReportedFinding]:
    """Yield findings whose places are where a sibling lies, which may be in another folder."""

    def real(place: Place) -> Place:
        return replace(place, file=package.path_on_disk(place.file))

    def moved(fix: Fix) -> Fix:
        edits = tuple(replace(edit, place=real(edit.place)) for edit in fix.edits)
        return Fix(fix.safety, edits)

    for finding in findings:
        yield replace(
            finding,
            places=tuple(map(real, finding.places)),
            fix=moved(finding.fix) if finding.fix else None,
            fixes=tuple(map(moved, finding.fixes)),
            repeats=tuple(
                replace(repeat, places=tuple(map(real, repeat.places)))
                for repeat in finding.repeats
            ),
        )


def neighbours_of(package: Package, findings: Iterable[ReportedFinding]) -> dict[str, str]:
    """Return the names of the siblings that have files with findings, by the files' real paths."""
    files = {finding.places[0].file for finding in findings}
    foreign = (file for file in files if file.startswith("../"))
    return {package.path_on_disk(file): file.split("/")[1] for file in foreign}
