"""The verdict on a package as one sentence, the same in every report."""

from __future__ import annotations

from checker.base.record import Record
from checker.base.words import count, listed, plain, shortened
from checker.finding import Severity
from checker.report.report import NO_TRIAL, Cause, PackageReport, VerdictKind

_REASON_LIMIT = 600


class Sentence(Record):
    """A verdict in words.

    Attributes:
        lead: `Ready`, `Not ready` or `Incomplete`.
        rest: Why; empty or what follows the lead behind a colon.
        aside: What was left out, for the end in brackets; may be empty.
    """

    lead: str
    rest: str
    aside: str

    def __str__(self) -> str:
        """Give the whole sentence."""
        said = f"{self.lead}: {self.rest}"
        return f"{said} ({self.aside})" if self.aside else said


def sentence(package: PackageReport) -> Sentence:
    """Say whether a package can be accepted, and what is left to do."""
    errors, warnings = package.count(Severity.ERROR), package.count(Severity.WARNING)
    looks = f"{count(warnings, 'warning')} to look at" if warnings else ""
    match package.verdict:
        case VerdictKind.NOT_READY:
            said = [f"{count(errors, 'error')} to fix", looks]
            return Sentence("Not ready", ", ".join(filter(None, said)), _aside(package))
        case VerdictKind.INCOMPLETE:
            said = [f"no error, but {_unseen(package)}", looks]
            return Sentence("Incomplete", ", ".join(filter(None, said)), _aside(package))
        case _:
            return Sentence("Ready", looks or "nothing to fix", _aside(package))


def _unseen(package: PackageReport) -> str:
    blind = len({each.rule for each in package.blind_spots})
    reasons = list(dict.fromkeys(each.reason for each in package.blind_spots))
    shown = plain(shortened(listed(reasons[:3]), _REASON_LIMIT))
    return f"{count(blind, 'rule')} could not look: {shown}"


def _aside(package: PackageReport) -> str:
    off = [each.reason for each in package.not_checked if each.cause is Cause.SWITCHED_OFF]
    others = sum(reason != NO_TRIAL for reason in off)
    said = ["trial not run"] if NO_TRIAL in off else []
    said += [f"{count(others, 'rule')} switched off"] if others else []
    said += [_suppressed(package)] if package.suppressed else []
    return ", ".join(said)


def _suppressed(package: PackageReport) -> str:
    errors = sum(each.finding.severity is Severity.ERROR for each in package.suppressed)
    of_them = f", {errors} of them {'an error' if errors == 1 else 'errors'}" if errors else ""
    return f"{len(package.suppressed)} suppressed{of_them}"
