"""All packages of a run at a glance, and the verdict on each as one sentence."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence

from checker.base.record import Record
from checker.base.words import and_list, count, plain, shortened
from checker.finding import Concern, Severity
from checker.report.markdown_text import escaped, fitting
from checker.report.ownership import each_once, is_foreign
from checker.report.render_settings import Palette
from checker.report.report import (
    NO_PHYSICS,
    NO_TRIAL,
    ROBOT,
    Cause,
    PackageReport,
    Report,
    ReportedFinding,
    VerdictKind,
)
from checker.report.unseen import by_reason

# The verdict on a package as one sentence, the same in every report.


_REASON_LIMIT = 600
FILES = {"world": "world", "single_file": "file"}
"""Kinds that are no packages, and what they are called."""
_NOUNS = ("package", *FILES.values())


class Sentence(Record):
    """A verdict in words.

    Attributes:
        lead: The verdict, such as `Not ready`.
        rest: The reason; empty or what follows the lead behind a colon.
        aside: What was left out, for the end in brackets; may be empty.
    """

    lead: str
    rest: str
    aside: str

    def __str__(self) -> str:
        """Return the whole sentence."""
        text = f"{self.lead}: {self.rest}"
        return f"{text} ({self.aside})" if self.aside else text


def sentence(package: PackageReport, *, names_robots: bool = True) -> Sentence:
    """Return whether a package can be accepted, and what is left to do.

    Args:
        package: The report of the package.
        names_robots: Whether it says why no robot was read; a report that does, says it once.
    """
    warnings = package.count(Severity.WARNING)
    phrases = [_errors(package)] if package.errors else []
    if package.verdict is VerdictKind.INCOMPLETE:
        phrases.insert(0, f"{'' if phrases else 'no error, but '}{_unseen(package, names_robots)}")
    phrases += [count(warnings, "warning")] if warnings else []
    rest = ", ".join(phrases) or "nothing to fix"
    return Sentence(package.verdict.lead, rest, _aside(package))


def _errors(package: PackageReport) -> str:
    """Return `2 errors of the robot and 1 of the paperwork to fix, and 3 in base_robot`."""
    owners = [_owner(package, found) for found in package.errors]
    inherited = Counter(filter(None, owners))
    others = and_list([f"{number} in {plain(name)}" for name, number in sorted(inherited.items())])
    own = Counter(
        found.concern for found, owner in zip(package.errors, owners, strict=True) if not owner
    )
    if not own:
        where = f": {others}" if len(inherited) > 1 else f" in {plain(*inherited)}"
        return f"{count(inherited.total(), 'error')} to fix{where}"
    (first, number), *more = ((concern, own[concern]) for concern in Concern if own[concern])
    phrases = [f"{count(number, 'error')} of {first.label}"]
    phrases += [f"{number} of {concern.label}" for concern, number in more]
    return f"{and_list(phrases)} to fix" + (f", and {others}" if others else "")


def _owner(package: PackageReport, found: ReportedFinding) -> str:
    """Return the package that a finding is inherited from; empty for its own."""
    place = found.places[0]
    return package.neighbours.get(place.file, place.file.split("/")[1]) if is_foreign(place) else ""


def _unseen(package: PackageReport, names_robots: bool) -> str:
    unseen = [spot for spot in package.blind_spots if spot.may_hide_error]
    robots = list(dict.fromkeys(spot.reason for spot in unseen if spot.rule == ROBOT))
    others = [spot for spot in unseen if spot.rule != ROBOT]
    if robots and not names_robots:
        return "no robot was read"
    reasons = robots or list(dict.fromkeys(it.reason for it in by_reason(others)))
    shown = plain(shortened(and_list(reasons[:3]), _REASON_LIMIT))
    blind = len({spot.rule for spot in others})
    what = "no robot was read" if robots else f"{count(blind, 'rule')} for errors could not run"
    return f"{what}: {shown}"


def _aside(package: PackageReport) -> str:
    unseen = package.not_checked
    off = [skipped.reason for skipped in unseen if skipped.cause is Cause.SWITCHED_OFF]
    others = sum(reason not in (NO_TRIAL, NO_PHYSICS) for reason in off)
    without = any(it.rule == ROBOT and it.cause is Cause.NOT_APPLICABLE for it in unseen)
    phrases = ["no robot of its own"] if without else []
    phrases += ["trial not run"] if NO_TRIAL in off else []
    phrases += ["physics is not installed"] if NO_PHYSICS in off else []
    phrases += [f"{count(others, 'rule')} switched off"] if others else []
    phrases += [_suppressed(package)] if package.suppressed else []
    return ", ".join(phrases)


def _suppressed(package: PackageReport) -> str:
    errors = sum(item.finding.severity is Severity.ERROR for item in package.suppressed)
    of_them = f", {errors} of them {'an error' if errors == 1 else 'errors'}" if errors else ""
    return f"{len(package.suppressed)} suppressed{of_them}"


_NAME_LIMIT = 200


def summary_text(packages: Sequence[PackageReport], palette: Palette) -> str:
    """Return a table with a line for each package, and below it the counts of all.

    Packages of one name have their paths.
    """
    heads = ("package", "verdict", *_plurals(packages))
    of_name = Counter(package.name for package in packages)
    rows = [
        (
            plain(package.name if of_name[package.name] == 1 else package.path),
            verdict_word(package.verdict),
            *map(str, counts),
        )
        for package in packages
        for counts in [_counts(package)[: len(heads) - 2]]
    ]
    widths = [max(map(len, column)) for column in zip(heads, *rows, strict=True)]
    lines = [palette.bold(_line(heads, widths))]
    for package, row in zip(packages, rows, strict=True):
        name, verdict, *numbers = _cells(row, widths)
        lines.append("  ".join((name, palette.verdict(package.verdict, verdict), *numbers)))
    return "\n".join([*lines, ready_of_all(packages)]) + "\n"


def _line(row: Sequence[str], widths: Sequence[int]) -> str:
    return "  ".join(_cells(row, widths))


def _cells(row: Sequence[str], widths: Sequence[int]) -> list[str]:
    """Return cells of equal width: words start at the left, numbers end at the right."""
    return [
        f"{cell:<{width}}" if column < 2 else f"{cell:>{width}}"
        for column, (cell, width) in enumerate(zip(row, widths, strict=True))
    ]


def summary_markdown(packages: Sequence[PackageReport], room: int) -> tuple[str, int]:
    """Return a table of the first packages, and the number of those for which there is no room.

    Args:
        packages: A row each.
        room: Bytes.
    """
    heads = _plurals(packages)
    head = "| package | verdict | " + " | ".join(heads) + " |"
    rows, left = fitting(packages, lambda package: _row_in_markdown(package, len(heads)), room)
    return "\n".join([head, "|---|---|" + "---:|" * len(heads), *rows]), left


def has_suppressed(packages: Sequence[PackageReport]) -> bool:
    """Return whether something of any package was found and does not count."""
    return any(package.suppressed for package in packages)


def _plurals(packages: Sequence[PackageReport]) -> list[str]:
    """Return what is counted of each package, in words."""
    return [*(f"{word}s" for word in Severity), *["suppressed"] * has_suppressed(packages)]


def _counts(package: PackageReport) -> list[int]:
    return [*map(package.count, Severity), len(package.suppressed)]


def _row_in_markdown(package: PackageReport, columns: int) -> str:
    numbers = " | ".join(map(str, _counts(package)[:columns]))
    name = escaped(shortened(package.name, _NAME_LIMIT))
    return f"| {name} | {verdict_word(package.verdict)} | {numbers} |"


def ready_of_all(packages: Sequence[PackageReport]) -> str:
    """Return `11 packages and 1 world, 9 ready`."""
    ready = sum(package.verdict is VerdictKind.READY for package in packages)
    return f"{what_was_checked(package.kind for package in packages)}, {ready} ready"


def what_was_checked(kinds: Iterable[str]) -> str:
    """Return how many packages, worlds and other single files there are: `2 packages and 1 world`.

    Args:
        kinds: The kind of each, as in `PackageReport.kind`.
    """
    numbers = Counter(map(_noun, kinds))
    return (
        and_list([count(numbers[noun], noun) for noun in _NOUNS if numbers[noun]]) or "0 packages"
    )


def what_is_ready(verdicts: Iterable[tuple[str, str]]) -> str:
    """Return how many of all are ready: `1 of 2 packages and 1 of 1 world ready`.

    Args:
        verdicts: Kind of each, as `PackageReport.kind` has it, and its verdict.
    """
    numbers, ready = Counter[str](), Counter[str]()
    for kind, verdict in verdicts:
        numbers[_noun(kind)] += 1
        ready[_noun(kind)] += verdict == VerdictKind.READY
    phrases = [f"{ready[noun]} of {count(numbers[noun], noun)}" for noun in _NOUNS if numbers[noun]]
    return f"{and_list(phrases) or '0 packages'} ready"


def _noun(kind: str) -> str:
    return FILES.get(kind, "package")


def verdict_word(verdict: VerdictKind) -> str:
    """Return the verdict for a column of a table, such as `not ready`."""
    return verdict.replace("_", " ")


def statistics_text(report: Report) -> str:
    """Return how many findings each rule has, in how many packages; most findings first."""
    rows = [("rule", "severity", "findings", "packages", "name"), *_rows(report)]
    if len(rows) == 1:
        return "No findings.\n"
    widths = [max(len(row[column]) for row in rows) for column in range(4)]
    return "".join(
        f"{rule:<{widths[0]}}  {severity:<{widths[1]}}  {number:>{widths[2]}}  "
        f"{packages:>{widths[3]}}  {name}\n"
        for rule, severity, number, packages, name in rows
    )


def _rows(report: Report) -> Iterator[tuple[str, str, str, str, str]]:
    """Count a rule apart for each severity that it found something of."""
    packages: dict[tuple[str, Severity, str], list[str]] = {}
    for package, reported in each_once(report):
        packages.setdefault((reported.rule, reported.severity, reported.name), []).append(
            package.path
        )
    ordered = sorted(packages.items(), key=lambda row: (-len(row[1]), row[0][0], row[0][1].rank))
    for (rule, severity, name), found_in in ordered:
        yield rule, str(severity), str(len(found_in)), str(len(set(found_in))), plain(name)
