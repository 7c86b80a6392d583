"""The report for a person at a terminal."""

from __future__ import annotations

import posixpath
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

from checker.base.words import and_list, count, plain, shortened
from checker.finding import Safety, Severity
from checker.report.alike import Likeness, first_alike
from checker.report.concise_report import concise_text
from checker.report.figures import Row, facts_in_words, rows_of
from checker.report.finding_text import MESSAGE_LIMIT, finding_text, path_of
from checker.report.importance import by_rule, importance
from checker.report.ownership import Identity, foreign_findings, owned_by, share_of
from checker.report.render_settings import Palette, RenderSettings, is_shown, shown_findings
from checker.report.report import (
    IN_BASELINE,
    ROBOT,
    USUAL_PROFILE,
    Cause,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
    ReportedFinding,
    Suppressed,
    SuppressedBy,
)
from checker.report.robots import robots_of
from checker.report.summary import sentence, summary_text
from checker.report.unseen import by_reason

# The trial for a person at a terminal: one line for each figure that matters.


_TEXT_LIMIT = 300
_NOTES_SHOWN = 3


def trial_text(trial: Mapping[str, Any], palette: Palette) -> Iterator[str]:
    """Yield the lines of the table, and what was left out of the trial.

    Args:
        trial: The trial, as in `PackageReport.trial`.
        palette: Colours.
    """
    if trial["refused"]:
        yield plain(f"trial: MuJoCo refuses the model: {_short(trial['refused'])}")
        return
    yield plain(f"trial: {_course(trial)}")
    if trial.get("not_driven"):
        yield plain(f"    not driven: {_short(trial['not_driven'])}")
    yield from _table([row for row in rows_of(trial["measurements"]) if row.matters], palette)
    for note in trial["notes"][:_NOTES_SHOWN]:
        yield plain(f"    note: {_short(note)}")
    if trial["repairs"]:
        repaired = count(len(trial["repairs"]), "repair")
        first = trial["repairs"][0]
        made = _short(f"{first['part']} {first['what']}")
        yield plain(f"    {repaired} to make the trial possible: {made}")


def _table(rows: Sequence[Row], palette: Palette) -> Iterator[str]:
    columns = [(row.label, row.value, row.verdict) for row in rows]
    widths = [max(map(len, column)) for column in zip(*columns, strict=True)]
    for row, texts in zip(rows, columns, strict=True):
        label, value, verdict = (
            plain(text).ljust(width) for text, width in zip(texts, widths, strict=True)
        )
        limits = row.limits if row.is_fault else ""
        yield f"    {label}  {value}  {_coloured(verdict, palette)}  {limits}".rstrip()


def _course(trial: Mapping[str, Any]) -> str:
    seconds = max((leg["end"] for leg in trial["course"]), default=0.0)
    version = trial["versions"].get("mujoco", "")
    moved = trial.get("moved")
    what = f"moved joint by joint: {_short(moved)}" if moved else trial["drive"]
    return f"{what}, {seconds:g} s in MuJoCo {version}".rstrip()


def _coloured(verdict: str, palette: Palette) -> str:
    word = verdict.strip()
    if word not in list(Severity):
        return verdict
    return palette.severity(Severity(word)) + verdict[len(word) :]


def _short(text: str) -> str:
    return shortened(text, _TEXT_LIMIT)


# What was found and does not count, for a person at a terminal: by rule and reason.


LINES_LIMIT = 20
_REASON_LIMIT = 300
_WHO = {
    SuppressedBy.COMMENT: "a comment",
    SuppressedBy.SETTINGS: "settings",
    SuppressedBy.BASELINE: "the baseline",
}


def suppressed_text(suppressed: Sequence[Suppressed]) -> Iterator[str]:
    """Yield a line for each rule and reason, those with the most findings first."""
    groups = Counter(map(_words, suppressed)).most_common()
    for words, number in groups[:LINES_LIMIT]:
        yield f"suppressed: {count(number, 'finding')} {words}"
    if rest := sum(number for _, number in groups[LINES_LIMIT:]):
        yield f"suppressed: {count(rest, 'more finding')}"


def _words(suppressed: Suppressed) -> str:
    """Return by what and why a finding does not count; the baseline counts as one reason."""
    if suppressed.reason == IN_BASELINE:
        return f"by {_WHO[suppressed.by]}"
    reason = plain(shortened(suppressed.reason, _REASON_LIMIT))
    return f"of {suppressed.finding.rule} by {_WHO[suppressed.by]}: {reason}"


SHOWN_LIMIT = 200
"""Findings of one package that are shown in full; the rest is counted."""
FIRST = 5
"""Errors, each of another rule, that are shown in front of all others."""
_RULES_NAMED = 5
"""Rules that were left out for one reason the user gave; of more the number states enough."""


class TextReport:
    """The report as it grows: each package is printed as soon as all its references are known."""

    def __init__(self, settings: RenderSettings, awaited: Iterable[str] = ()) -> None:
        """Begin the report.

        Args:
            settings: What to show.
            awaited: Paths of the packages that are to come. What another package reports of a
                file of theirs is stated there.
        """
        self._settings = settings
        self._owners: dict[Identity, str] = {}
        self._told: dict[str, str] = {}
        self._seen: dict[Likeness, str] = {}
        self._awaited = {posixpath.normpath(path) for path in awaited}
        self._waiting: list[PackageReport] = []
        self._is_first, self._after_line = True, False

    def add(self, packages: Iterable[PackageReport], done: str = "") -> Iterator[str]:
        """Yield the text that can be printed now that some packages are checked.

        Args:
            packages: The checked packages.
            done: The path that is no longer awaited.
        """
        self._awaited.discard(posixpath.normpath(done))
        for package in packages:
            self._owners |= owned_by(package)
            self._waiting.append(package)
        while self._waiting and not self._must_wait(self._waiting[0]):
            yield self._package_text(self._waiting.pop(0))

    def deferred_lines(self) -> Iterator[str]:
        """Yield what had to wait."""
        self._awaited.clear()
        yield from self.add(())

    def _must_wait(self, package: PackageReport) -> bool:
        """Return whether a package reports a file of one that is still to come."""
        if not self._awaited:
            return False
        paths = (path_of(found.places[0], package) for found in foreign_findings(package))
        return any(path.startswith(f"{awaited}/") for path in paths for awaited in self._awaited)

    def _package_text(self, package: PackageReport) -> str:
        if self._settings.concise:
            return concise_text(package, self._owners, self._settings)
        folds = not (self._settings.full or self._settings.quiet)
        first = first_alike(package, self._seen) if folds else ""
        text = (
            f"{verdict_text(package, self._settings.palette)}, the same as in {plain(first)}\n"
            if first
            else _package(package, self._owners, self._settings, self._told)
        )
        # Packages of one line follow each other without a gap.
        is_line = text.count("\n") == 1
        gap = "" if self._settings.quiet or (is_line and self._after_line) else "\n"
        self._after_line = is_line
        gap, self._is_first = "" if self._is_first else gap, False
        return gap + text


def to_text(report: Report, settings: RenderSettings) -> str:
    """Return the whole report."""
    text = TextReport(settings)
    return "".join((*text.add(report.packages), closing_text(report, settings)))


def closing_text(report: Report, settings: RenderSettings) -> str:
    """Return the text below all packages: a table of several, and the next steps."""
    if settings.quiet:
        return ""
    blocks = [summary_text(report.packages, settings.palette)] * (len(report.packages) > 1)
    if skipped := [*_skipped(item for item in report.not_opened if not item.failed)]:
        blocks.append("".join(skipped))
    blocks += [_first_of_all(report, settings), _hint(report, settings)]
    return "".join(f"\n{block}" for block in blocks if block)


def _first_of_all(report: Report, settings: RenderSettings) -> str:
    """Return the errors to correct first, where many packages have pushed them off the screen."""
    first: dict[str, tuple[ReportedFinding, PackageReport]] = {}
    for package in report.packages:
        for found in package.findings:
            if found.severity is Severity.ERROR:
                first.setdefault(found.rule, (found, package))
    if len(report.packages) <= FIRST or not first:
        return ""
    errors = sorted(first.values(), key=lambda pair: (*pair[1].lateness, *importance(pair[0])))
    lines = (next(finding_text(*pair, settings, explained=True)) for pair in errors[:FIRST])
    head = settings.palette.bold("Do first in all packages:")
    return "".join(f"{line}\n" for line in (head, *lines))


def _hint(report: Report, settings: RenderSettings) -> str:
    """Return the next commands: how a rule is explained, by the first that was shown, and fixes."""
    shown = [found for package in report.packages for found in shown_findings(package, settings)]
    if not shown or settings.concise:
        return ""
    more = "" if settings.full else ", `--full` shows source lines and reasons"
    lines = [f"`subt-check rule {min(shown, key=importance).rule}` explains a rule{more}"]
    fixes = [found.fix or found.fixes[0] for found in shown if found.fix or found.fixes]
    safe = sum(fix.safety is Safety.SAFE for fix in fixes)
    lines += [f"`--fix` corrects {count(safe, 'finding')}"] if safe else []
    lines += (
        [f"`--fix --unsafe` corrects {count(len(fixes), 'finding')}"] if len(fixes) > safe else []
    )
    return "".join(settings.palette.dim(line) + "\n" for line in lines)


def _package(
    package: PackageReport,
    owner_of: Mapping[Identity, str],
    settings: RenderSettings,
    told: dict[str, str],
) -> str:
    """Return the text of a package.

    Args:
        package: The report of the package.
        owner_of: The package in which each finding is listed.
        settings: How it is shown.
        told: Why no robot was read, and the first package of which it is told; is added to.
    """
    palette = settings.palette
    share = share_of(package, owner_of)
    own = [found for found in share.own if is_shown(found, settings)]
    lines = list(_findings(own[:SHOWN_LIMIT], package, settings))
    lines += _counted(own[SHOWN_LIMIT:])
    if settings.quiet:
        return "".join(f"{line}\n" for line in lines)
    if not (share.own or share.elsewhere or settings.full or _has_more(package)):
        return verdict_text(package, palette) + "\n"
    kind = package.kind.replace("_", " ") + _profile(package)
    head = [
        palette.bold(plain(package.name)) + palette.dim(f"  {kind}"),
        *_unread_robots(package, told),
    ]
    verdict = sentence(package, names_robots=False)
    if lines:
        head.append(palette.verdict(package.verdict, str(verdict)))
    lines[:0] = [*head, ""]
    lines += _infos(len(share.own) - len(own))
    lines += [
        f"{count(n, 'finding')} in {plain(name)}: listed there"
        for name, n in share.elsewhere.items()
    ]
    lines += [f"judged for {plain(package.target_reason)}"] * bool(package.target_reason)
    lines += [f"settings: {plain(shortened(package.settings, MESSAGE_LIMIT))}"] * bool(
        package.settings
    )
    lines += suppressed_text(package.suppressed)
    lines += _inherited(package)
    others = [unseen for unseen in package.not_checked if unseen.rule != ROBOT]
    lines += _not_checked(others, settings)
    lines += _without_robot(package, told)
    lines += _robots(package, palette)
    lines.append(palette.verdict(package.verdict, f"{plain(package.name)}: {verdict}"))
    return "\n".join(lines) + "\n"


def _has_more(package: PackageReport) -> bool:
    """Return whether there is more to state than the verdict, as of a package with a robot."""
    unseen = any(each.cause is not Cause.NOT_APPLICABLE for each in package.not_checked)
    shown = any(robot.facts or robot.trial for robot in robots_of(package))
    return bool(unseen or shown or package.suppressed or package.inherited or package.settings)


def _findings(
    findings: Sequence[ReportedFinding], package: PackageReport, settings: RenderSettings
) -> Iterator[str]:
    """Yield the lines of findings, those to correct first in front."""
    explained: set[str] = set()
    for head, group in _groups(findings):
        if not settings.quiet:
            yield settings.palette.bold(head)
        for finding in group:
            yield from finding_text(finding, package, settings, finding.rule in explained)
            explained.add(finding.rule)
            if settings.full:
                yield ""
        if not settings.full:
            yield ""


def _groups(
    findings: Sequence[ReportedFinding],
) -> Iterator[tuple[str, Sequence[ReportedFinding]]]:
    """Yield findings under the heads of the report: errors of five rules, then the rest."""
    ordered = sorted(findings, key=importance)
    errors = [found for found in ordered if found.severity is Severity.ERROR]
    causes = [first for first, *_ in by_rule(errors)[:FIRST]]
    groups = {
        "Do first:": causes,
        "Other errors:": [found for found in errors if not any(found is each for each in causes)],
        "Warnings:": [found for found in ordered if found.severity is Severity.WARNING],
        "Infos:": [found for found in ordered if found.severity is Severity.INFO],
    }
    yield from ((head, group) for head, group in groups.items() if group)


def _infos(number: int) -> Iterator[str]:
    if number:
        yield f"{count(number, 'info')}, show with --info"


def _profile(package: PackageReport) -> str:
    """Name the profile where it is not the usual one: what is checked may have chosen it."""
    return "" if package.profile == USUAL_PROFILE else f", profile {package.profile}"


def _counted(findings: Sequence[ReportedFinding]) -> Iterator[str]:
    """Count by rule what is too much to be read in full."""
    if findings:
        by_rule = Counter(finding.rule for finding in findings).most_common()
        rules = ", ".join(f"{number} {rule}" for rule, number in by_rule)
        yield f"… and {count(len(findings), 'more finding')}: {rules}; --format json lists all"


def _inherited(package: PackageReport) -> Iterator[str]:
    by_source: dict[str, list[str]] = {}
    for part in package.inherited:
        source = part.package + ("" if part.at_hand else " (not found)")
        by_source.setdefault(source, []).append(part.part)
    for source, parts in by_source.items():
        yield f"inherited from {plain(source)}: {plain(and_list(parts))}"


def _unread_robots(package: PackageReport, told: dict[str, str]) -> Iterator[str]:
    """Yield why no robot was read; what several packages share, of the first alone."""
    for unseen in package.blind_spots:
        if unseen.rule == ROBOT:
            first = told.setdefault(unseen.reason, package.name)
            if first == package.name:
                yield f"no robot was read: {plain(shortened(unseen.reason, MESSAGE_LIMIT))}"
            else:
                yield f"no robot was read, for the reason given at {plain(first)}"


def _without_robot(package: PackageReport, told: dict[str, str]) -> Iterator[str]:
    """Yield why a package that needs no robot has none, once of all packages."""
    for unseen in package.not_checked:
        is_robot = unseen.rule == ROBOT and unseen.cause is Cause.NOT_APPLICABLE
        if is_robot and told.setdefault(unseen.reason, package.name) == package.name:
            yield f"not checked: robot: {plain(shortened(unseen.reason, MESSAGE_LIMIT))}"


def _not_checked(not_checked: Sequence[NotChecked], settings: RenderSettings) -> Iterator[str]:
    """Name the rules that could not look; those that the user or the package leaves out count."""
    for unseen in by_reason(not_checked):
        rules, text = unseen.rules, plain(shortened(unseen.reason, MESSAGE_LIMIT))
        match unseen.cause:
            case Cause.NOT_APPLICABLE:
                if settings.infos:
                    yield f"not applicable: {count(len(rules), 'rule')}: {text}"
            case _ if len(rules) > _RULES_NAMED and not settings.full:
                groups = and_list(sorted({rule.rstrip("0123456789") for rule in rules}))
                yield f"not checked: {count(len(rules), 'rule')} ({groups}): {text}"
            case _:
                yield f"not checked: {', '.join(rules)}: {text}"


def _robots(package: PackageReport, palette: Palette) -> Iterator[str]:
    """Show the trial of the robot and what is known of it; of several robots, each in short."""
    robots = robots_of(package)
    objects = [it.name for it in robots if it.is_object] if len(robots) > 1 else []
    for robot in robots:
        if objects and robot.is_object:
            continue
        facts = [fact.phrase for fact in facts_in_words(robot.facts)]
        if len(robots) == 1 and robot.trial:
            yield from trial_text(robot.trial, palette)
        elif verdict := str(robot.verdict):
            facts.append(f"trial {shortened(verdict, _TEXT_LIMIT)}")
        if facts:
            yield plain(", ".join(facts))
        if len(robots) > 1 and robot.trial:
            rows = rows_of(robot.trial["measurements"])
            yield from _table([row for row in rows if row.is_fault], palette)
    if objects:
        names = shortened(and_list(objects), _TEXT_LIMIT)
        yield plain(f"{count(len(objects), 'object')} without joints, sensors and plugins: {names}")


def verdict_text(package: PackageReport, palette: Palette) -> str:
    """Return the last line about a package."""
    return palette.verdict(package.verdict, f"{plain(package.name)}: {sentence(package)}")


def _skipped(items: Iterable[NotOpened]) -> Iterator[str]:
    """Name what was not opened, folders with one reason together."""
    by_reason: dict[str, list[str]] = {}
    for item in items:
        by_reason.setdefault(item.reason, []).append(item.path)
    for reason, (first, *others) in by_reason.items():
        more = f" and {count(len(others), 'more folder')}:" if others else ""
        yield f"not opened: {plain(first)}{more} {plain(reason)}\n"
