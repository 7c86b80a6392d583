"""What the rules' pages say, put beside the findings of a report that came without it."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec.structs import replace

from checker.report.report import Report, ReportedFinding
from checker.rulebook.discovery import all_rules
from checker.rulebook.pages import Page, parse_page


def explained(report: Report) -> Report:
    """Return a report with why and how at each finding whose rule is known here as well."""
    pages = {rule.id: parse_page(rule.page) for rule in all_rules()}
    packages = [
        replace(each, findings=tuple(_explained(found, pages) for found in each.findings))
        for each in report.packages
    ]
    return replace(report, packages=tuple(packages))


def _explained(finding: ReportedFinding, pages: Mapping[str, Page]) -> ReportedFinding:
    page = pages.get(finding.rule)
    if page is None:
        return finding
    return replace(
        finding,
        why=page.reason,
        how=" ".join(page.fix.split()),
        title=page.title,
        source=" ".join(page.source.split()),
    )
