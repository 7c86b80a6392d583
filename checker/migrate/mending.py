"""What the rules can mend by themselves in the new model: colours, misplaced elements, nesting."""

from __future__ import annotations

from collections.abc import Iterator

from checker.cache import NO_CACHE
from checker.finding import Safety
from checker.judging import findings_of
from checker.migrate.destination import Staging
from checker.package.opening import open_input
from checker.patching.rounds import fix_package
from checker.report.report import ReportedFinding
from checker.settings import Settings

MODEL = "model.sdf"
_SETTINGS = Settings(select=("SDF", "SEN", "REF", "GEO", "KIN"), trial=False, cache=False)
"""Groups of rules on the model alone; of the rest of the package nothing is there yet."""


def mend_model(staging: Staging) -> list[str]:
    """Apply every fix of the rules to the model that was written; return what was mended."""
    with open_input(staging.folder) as opened:
        package = opened.packages[0]
        fixed = fix_package(
            package, lambda each: findings_of(each, _SETTINGS, NO_CACHE), list(Safety)
        )
    for file in fixed.files:
        staging.write(file.path, file.after.encode())
    return list(_notes(fixed.findings))


def _notes(findings: tuple[ReportedFinding, ...]) -> Iterator[str]:
    for finding in findings:
        more = f" (and {len(finding.places) - 1} more)" if len(finding.places) > 1 else ""
        yield f"{finding.rule} is fixed: {finding.message}{more}"
