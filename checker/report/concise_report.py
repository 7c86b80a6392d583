"""One line a finding, in the form of compilers, which editors and terminals understand."""

from __future__ import annotations

from collections.abc import Mapping

from checker.base.words import plain, shortened
from checker.report.finding_text import MESSAGE_LIMIT, where_text
from checker.report.ownership import Identity, share_of
from checker.report.render_settings import RenderSettings, is_shown
from checker.report.report import PackageReport, ReportedFinding
from checker.report.summary import sentence


def concise_text(
    package: PackageReport, owner_of: Mapping[Identity, str], settings: RenderSettings
) -> str:
    """Return the lines of a package: its findings, and the verdict.

    Args:
        package: The package to report.
        owner_of: See `share_of`.
        settings: What to show.
    """
    own = share_of(package, owner_of).own
    lines = [_line(found, package, settings) for found in own if is_shown(found, settings)]
    if not settings.quiet:
        text = f"{plain(package.name)}: {sentence(package)}"
        lines.append(settings.palette.verdict(package.verdict, text))
    return "".join(f"{line}\n" for line in lines)


def _line(finding: ReportedFinding, package: PackageReport, settings: RenderSettings) -> str:
    message = plain(shortened(finding.message, MESSAGE_LIMIT))
    more = f" (and {len(finding.places) - 1} more)" if len(finding.places) > 1 else ""
    severity = settings.palette.severity(finding.severity)
    where = where_text(finding.places[0], package)
    rules = ", also ".join((finding.rule, *finding.also))
    return f"{where}: {severity}: {message}{more} [{rules}]"
