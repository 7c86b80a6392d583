"""The report for a person at a terminal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from checker.finding import Place, Severity
from checker.report.finding_text import MESSAGE_LIMIT, finding_text, path_of
from checker.report.palette import Palette
from checker.report.report import (
    NO_TRIAL,
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    VerdictKind,
)
from checker.report.trial_text import trial_text
from checker.report.wording import count, listed, plain, shortened

UNITS = {"kg": "kg", "m": "m", "deg": "°", "s": "s"}
"""Units by the ends of the names of facts: `mass_kg`."""


def to_text(report: Report, palette: Palette) -> str:
    """Return the whole report."""
    said_by_owner = {
        _identity(package, each): package.name
        for package in report.packages
        for each in package.findings
        if not _is_foreign(each.places[0])
    }
    explained: set[str] = set()
    blocks = [_package(package, said_by_owner, explained, palette) for package in report.packages]
    if len(report.packages) > 1:
        blocks.append(_summary(report.packages, palette))
    if skipped := [_skipped(each) for each in report.not_opened if not each.failed]:
        blocks.append("".join(skipped))
    return "\n".join(blocks)


_Identity = tuple[str, int, str, str]


def _identity(package: PackageReport, finding: ReportedFinding) -> _Identity:
    place = finding.places[0]
    return path_of(place, package), place.line, finding.rule, finding.message


def _package(
    package: PackageReport,
    said_by_owner: Mapping[_Identity, str],
    explained: set[str],
    palette: Palette,
) -> str:
    own, elsewhere = _split_by_owner(package, said_by_owner)
    kind = package.kind.replace("_", " ") + _profile(package)
    lines = [palette.bold(plain(package.name)) + palette.dim(f"  {kind}"), ""]
    for finding in own:
        lines += [*finding_text(finding, package, palette, finding.rule in explained), ""]
        explained.add(finding.rule)
    lines += [f"{count(n, 'finding')} in {name}: see there" for name, n in elsewhere.items()]
    lines += [f"settings: {plain(shortened(package.settings, MESSAGE_LIMIT))}"] * bool(
        package.settings
    )
    lines += _inherited(package)
    lines += _not_checked(package.not_checked)
    lines += trial_text(package.trial, palette) if package.trial else []
    lines += _facts(package.facts)
    lines.append(_verdict(package, palette))
    return "\n".join(lines) + "\n"


def _profile(package: PackageReport) -> str:
    """Name the profile where it is not the usual one: what is checked may have chosen it."""
    return "" if package.profile == PackageReport.profile else f", profile {package.profile}"


def _split_by_owner(
    package: PackageReport, said_by_owner: Mapping[_Identity, str]
) -> tuple[list[ReportedFinding], Mapping[str, int]]:
    """Set apart the findings in another package's files that its own report holds too."""
    own: list[ReportedFinding] = []
    elsewhere: dict[str, int] = {}
    for finding in package.findings:
        owner = said_by_owner.get(_identity(package, finding))
        if owner is not None and _is_foreign(finding.places[0]):
            elsewhere[owner] = elsewhere.get(owner, 0) + 1
        else:
            own.append(finding)
    return own, elsewhere


def _is_foreign(place: Place) -> bool:
    return place.file.startswith("../")


def _inherited(package: PackageReport) -> Iterator[str]:
    by_source: dict[str, list[str]] = {}
    for part in package.inherited:
        source = part.package + ("" if part.at_hand else " (not at hand)")
        by_source.setdefault(source, []).append(part.part)
    for source, parts in by_source.items():
        yield f"inherited from {plain(source)}: {plain(listed(parts))}"


def _not_checked(not_checked: Sequence[NotChecked]) -> Iterator[str]:
    by_reason: dict[tuple[str, bool], list[str]] = {}
    for each in not_checked:
        applies = each.cause is not Cause.NOT_APPLICABLE
        by_reason.setdefault((each.reason, applies), []).append(each.rule)
    for (reason, applies), rules in by_reason.items():
        said = plain(shortened(reason, MESSAGE_LIMIT))
        if applies:
            yield f"not checked: {', '.join(rules)}: {said}"
        else:
            yield f"not applicable: {count(len(rules), 'rule')}: {said}"


def _facts(facts: Mapping[str, object]) -> Iterator[str]:
    """Show figures in one line: numbers of parts, quantities with their units, and words."""
    shown = []
    for name, value in facts.items():
        words, _, unit = name.rpartition("_")
        if unit in UNITS and isinstance(value, float | list):
            shown.append(f"{words.replace('_', ' ')} {_quantity(words, value)} {UNITS[unit]}")
        elif isinstance(value, float):
            shown.append(f"{name.replace('_', ' ')} {value:.3g}")
        elif isinstance(value, int):
            shown.append(count(value, name.replace("_", " ").removesuffix("s")))
        elif isinstance(value, str):
            shown.append(f"{name.replace('_', ' ')} {value}")
    if shown:
        yield plain(", ".join(shown))


def _quantity(name: str, value: float | list[float]) -> str:
    if isinstance(value, float):
        return f"{value:.4g}"
    numbers = [f"{round(each, 3) + 0.0:g}" for each in value]
    return " × ".join(numbers) if name == "size" else f"({', '.join(numbers)})"


def _verdict(package: PackageReport, palette: Palette) -> str:
    errors, warnings = package.count(Severity.ERROR), package.count(Severity.WARNING)
    looks = f"{count(warnings, 'warning')} to look at" if warnings else ""
    match package.verdict:
        case VerdictKind.NOT_READY:
            said = [f"{count(errors, 'error')} to fix", looks]
            sentence = "Not ready: " + ", ".join(filter(None, said))
        case VerdictKind.INCOMPLETE:
            blind = len({each.rule for each in package.blind_spots})
            different = list(dict.fromkeys(n.reason for n in package.blind_spots))
            reasons = plain(shortened(listed(different[:3]), MESSAGE_LIMIT))
            said = [f"{count(blind, 'rule')} could not look: {reasons}", looks]
            sentence = "Incomplete: no error, but " + ", ".join(filter(None, said))
        case _:
            sentence = "Ready" + (f": {looks}" if looks else ": nothing to fix")
    off = [n.reason for n in package.not_checked if n.cause is Cause.SWITCHED_OFF]
    said = ["trial not run"] if NO_TRIAL in off else []
    others = sum(reason != NO_TRIAL for reason in off)
    said += [f"{count(others, 'rule')} switched off"] if others else []
    if said:
        sentence += f" ({', '.join(said)})"
    return palette.verdict(package.verdict, f"{plain(package.name)}: {sentence}")


def _summary(packages: Sequence[PackageReport], palette: Palette) -> str:
    """One line a package, then the counts of all."""
    width = max(len(plain(package.name)) for package in packages)
    lines = []
    for package in packages:
        numbers = "  ".join(f"{package.count(level):4d} {level}" for level in Severity)
        verdict = palette.verdict(package.verdict, f"{_word(package.verdict):<10}")
        lines.append(f"{plain(package.name):<{width}}  {verdict}  {numbers}")
    ready = sum(package.verdict is VerdictKind.READY for package in packages)
    lines.append(f"{count(len(packages), 'package')}, {ready} ready")
    return "\n".join(lines) + "\n"


def _word(verdict: VerdictKind) -> str:
    return verdict.replace("_", " ")


def _skipped(each: NotOpened) -> str:
    return f"not looked at: {plain(each.path)} {plain(each.reason)}\n"
