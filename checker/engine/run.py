"""Runs the rules over one package: selects, isolates, groups, sorts."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import product
from typing import Any

from msgspec import field
from msgspec.structs import replace

from checker.base.allowance import Allowance, Exceeded
from checker.base.errors import is_momentary
from checker.base.extras import MissingExtra
from checker.base.parts import NotAvailable, Parts, type_name
from checker.base.record import Record
from checker.base.words import shortened
from checker.engine.covered import Cover, Said, SplitFindings, split_covered
from checker.engine.grouping import (
    TEXT_LIMIT,
    bounded_places,
    group_findings,
    joined_fix,
    joined_places,
)
from checker.engine.judge import GradedFinding, Judge
from checker.engine.options import options_of
from checker.engine.unloaded import OF_COPIES, less_of_unloaded, unloaded_in
from checker.finding import (
    Severity,
    fingerprint,
    numbered,
    without_line_numbers,
)
from checker.formats.xacro.files import as_written
from checker.package.index import is_of_tests, is_retired
from checker.report.report import Cause, NotChecked, Repeat, ReportedFinding, Suppressed
from checker.rule import Context, Finding, Rule, Unchecked
from checker.rulebook.pages import parse_page
from checker.rulebook.suppression.finding_places import Spot, spot
from checker.rulebook.suppression.matcher import SuppressionMatcher, split_suppressed


class Outcome(Record):
    """Findings of the rules, and the rules that could not run.

    Attributes:
        looked: Ids of the rules that ran on complete data, each with the options it used.
        suppressed: Findings that do not count.
        covered: Findings that repeat one of a more precise rule.
    """

    findings: tuple[ReportedFinding, ...]
    not_checked: tuple[NotChecked, ...]
    looked: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    suppressed: tuple[Suppressed, ...] = ()
    covered: tuple[ReportedFinding, ...] = ()


def run_rules(
    rules: Iterable[Rule],
    parts: Parts,
    judge: Judge,
    matcher: SuppressionMatcher | None = None,
    unloaded: Collection[str] = (),
    *,
    unstarted: str = "",
    copied: str = "",
    allowance: Allowance | None = None,
) -> Outcome:
    """Run the rules of profile and settings; one that crashes stops no other.

    Args:
        rules: The rules to choose from; the selected ones run.
        parts: The parts that they need.
        judge: The selection of rules, and the severities of findings.
        matcher: The matcher of findings that do not count.
        unloaded: Files that nothing loads: what is found in them is information.
        unstarted: That nothing starts the whole, as a clause: what is found is less severe.
        copied: That it was copied, as a clause: what some rules find is less severe.
        allowance: What each rule may use; the usual when None.
    """
    allowance = allowance or Allowance()
    said: list[Said] = []
    not_checked: list[NotChecked] = []
    looked: dict[str, Mapping[str, Any]] = {}
    for rule in rules:
        if not judge.is_selected(rule):
            not_checked += judge.switched_off(rule)
            continue
        clause = unstarted or (copied if rule.id in OF_COPIES else "")
        result = _run_isolated(rule, parts, judge, allowance, clause)
        severity = judge.severity(rule)
        if isinstance(result, NotChecked):
            not_checked.append(replace(result, severity=severity, concern=rule.concern))
            continue
        looked[rule.id] = {**rule.options, **options_of(rule, judge.settings)}
        found = (_weighed(item, severity, unloaded) for item in result if isinstance(item, Finding))
        said.append((rule, [judge.grade(rule, _with_written_paths(each)) for each in found]))
        reasons: dict[str, Severity | None] = {}
        for item in result:
            if isinstance(item, Unchecked):  # of loaded robots first: those count
                reason = shortened(as_written(item.reason), TEXT_LIMIT)
                reasons.setdefault(reason, item.severity)
        not_checked += [
            NotChecked(rule.id, reason, Cause.NOT_AT_HAND, own or severity, rule.concern)
            for reason, own in reasons.items()
        ]
    return _reported(said, matcher, not_checked, looked)


def _reported(
    said: list[Said],
    matcher: SuppressionMatcher | None,
    not_checked: list[NotChecked],
    looked: Mapping[str, Mapping[str, Any]],
) -> Outcome:
    """Return what rules stated as it is reported, what counts of it and what does not."""
    findings: list[ReportedFinding] = []
    suppressed: list[Suppressed] = []
    covered: list[ReportedFinding] = []
    shares = split_covered(said)
    repeats = _repeats(shares)
    for each in shares:
        rule = each.rule
        covered += _report(rule, [found for found, _ in each.covered], {})
        for suppression, group in split_suppressed(
            rule.id, each.reported, matcher, partial(_spot, rule)
        ).items():
            reported = _report(rule, group, repeats)
            if suppression is None:
                findings += reported
            else:
                suppressed += [
                    Suppressed(finding, suppression.by, suppression.reason, suppression.place)
                    for finding in reported
                ]
    outcome = _outcome(_sorted(findings), suppressed, not_checked, looked)
    return replace(outcome, covered=tuple(covered))


def _repeats(shares: Sequence[SplitFindings]) -> dict[Cover, list[Repeat]]:
    """Return the findings of less precise rules, by the finding reported in their place."""
    covers = {(each.rule.id, found): cover for each in shares for found, cover in each.covered}
    repeats: dict[Cover, list[Repeat]] = {}
    for each in shares:
        for found, cover in each.covered:
            kept = cover
            while kept in covers:
                kept = covers[kept]
            message = shortened(found.message, TEXT_LIMIT)
            repeat = Repeat(
                each.rule.id, each.rule.name, found.severity, message, bounded_places(found.places)
            )
            repeats.setdefault(kept, []).append(repeat)
    return repeats


def _weighed(finding: Finding, severity: Severity, unloaded: Collection[str]) -> Finding:
    """Return a finding; less severe of tests and old files, information on what nothing loads."""
    file = finding.places[0].file
    if file in unloaded:
        return replace(finding, severity=Severity.INFO)
    if is_of_tests(file) or is_retired(file):
        return replace(finding, severity=(finding.severity or severity).weaker)
    return finding


def _with_written_paths(finding: Finding) -> Finding:
    """Return a finding whose message names files as xacro files do."""
    message = as_written(finding.message)
    return finding if message == finding.message else replace(finding, message=message)


def _outcome(
    findings: list[ReportedFinding],
    suppressed: list[Suppressed],
    not_checked: list[NotChecked],
    looked: Mapping[str, Mapping[str, Any]],
) -> Outcome:
    """Number findings that would have one fingerprint: those that count first."""
    aside = [item.finding for item in suppressed]
    prints = numbered(finding.fingerprint for finding in (*findings, *aside))
    distinct = [
        replace(finding, fingerprint=own)
        for finding, own in zip((*findings, *aside), prints, strict=True)
    ]
    counting, others = distinct[: len(findings)], distinct[len(findings) :]
    set_aside = (
        replace(item, finding=finding) for item, finding in zip(suppressed, others, strict=True)
    )
    return Outcome(tuple(counting), tuple(not_checked), looked, tuple(set_aside))


def join_outcomes(*outcomes: Outcome) -> Outcome:
    """Return what different rules stated together."""
    looked: dict[str, Mapping[str, Any]] = {}
    for outcome in outcomes:
        looked.update(outcome.looked)
    return Outcome(
        tuple(_sorted([finding for outcome in outcomes for finding in outcome.findings])),
        tuple(unseen for outcome in outcomes for unseen in outcome.not_checked),
        looked,
        tuple(aside for outcome in outcomes for aside in outcome.suppressed),
        tuple(found for outcome in outcomes for found in outcome.covered),
    )


def _run_isolated(
    rule: Rule, parts: Parts, judge: Judge, allowance: Allowance, clause: str
) -> list[Finding | Unchecked] | NotChecked:
    """Run one rule; what goes wrong inside it is the checker's fault and states it."""
    try:
        arguments = _arguments(rule, parts, judge.context)
        if isinstance(arguments, NotAvailable):
            cause = Cause.NOT_AT_HAND if arguments.applicable else Cause.NOT_APPLICABLE
            return NotChecked(rule.id, shortened(arguments.reason, TEXT_LIMIT), cause)
        options = options_of(rule, judge.settings)
        with allowance.piece():
            said = [
                (unloaded_in(each, rule.id) or clause, [*rule.check(**each, **options)])
                for each in arguments
            ]
            return [*less_of_unloaded(said, rule.severity)]
    except MissingExtra as missing:
        return NotChecked(rule.id, missing.extra.missing_message, Cause.SWITCHED_OFF)
    except (Exceeded, Exception) as error:  # noqa: BLE001 - the others continue, the exit code says so
        return unfinished(rule.id, error)


def unfinished(what: str, error: Exception | Exceeded) -> NotChecked:
    """Return the reason why a part of the check did not come to its end.

    It may need more than it may use, and the disk or the system may have failed; all else is the
    checker's own fault.
    """
    if isinstance(error, Exceeded):
        return NotChecked(what, f"{what} {error.reason}", Cause.NOT_AT_HAND)
    if is_momentary(error):
        reason = f"{what} could not run because the system failed ({error}); check again"
        return NotChecked(what, shortened(reason, TEXT_LIMIT), Cause.NOT_AT_HAND, momentary=True)
    problem = shortened(f"{type(error).__name__}: {error}", TEXT_LIMIT)
    reason = f"{what} could not run ({problem}); please report this"
    return NotChecked(what, reason, Cause.CRASHED)


def _arguments(rule: Rule, parts: Parts, context: Context) -> list[dict[str, Any]] | NotAvailable:
    """Return one set of arguments for each combination of the parts that a rule needs.

    None represents a part that the package has not and the rule can do without; one that only
    cannot be had is missed anyway.
    """
    wanted: dict[str, Sequence[object]] = {}
    for name, kind in rule.needs.items():
        had = (context,) if kind == type_name(Context) else parts.part(kind)
        if not isinstance(had, NotAvailable):
            wanted[name] = had
        elif name in rule.optional_parts and not had.applicable:
            wanted[name] = (None,)
        else:
            return had
    return [dict(zip(wanted, choice, strict=True)) for choice in product(*wanted.values())]


def _report(
    rule: Rule,
    findings: list[GradedFinding],
    repeats: Mapping[Cover, Sequence[Repeat]],
) -> Iterator[ReportedFinding]:
    """Join findings that are one fault in many places, and add what the rule's page states."""
    page = parse_page(rule.page)
    for group in group_findings(findings):
        first = group[0]
        places = joined_places(group)
        fixes = tuple(finding.fix for finding in group if finding.fix)
        yield ReportedFinding(
            rule.id,
            rule.name,
            first.severity,
            rule.concern,
            shortened(first.message, TEXT_LIMIT),
            fingerprint(rule.id, places[0].file, places[0].element, _identity(first)),
            places,
            joined_fix(fixes),
            page.reason,
            " ".join(page.fix.split()),
            first.key,
            page.title,
            " ".join(page.source.split()),
            fixes if len(group) > 1 else (),
            tuple(dict.fromkeys(each for own in group for each in repeats.get((rule.id, own), ()))),
        )


def _spot(rule: Rule, finding: GradedFinding) -> Spot:
    """Return how the baseline knows a finding, in the words of the report."""
    message = shortened(finding.message, TEXT_LIMIT)
    return spot(rule.id, finding.severity, finding.places[0], finding.key, message)


def _identity(finding: Finding) -> str:
    """Return what distinguishes a fault from others of its rule in the same element or file.

    An element's path stays when its value changes, the message does not; elsewhere the message
    has to do, without the numbers of lines in it.
    """
    message = "" if finding.places[0].element else finding.message
    return without_line_numbers(finding.key or message)


def _sorted(findings: list[ReportedFinding]) -> list[ReportedFinding]:
    def key(reported: ReportedFinding) -> tuple[int, str, int, int, str]:
        place = reported.places[0]
        return reported.severity.rank, place.file, place.line, place.column, reported.rule

    return sorted(findings, key=key)
