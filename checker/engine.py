"""Runs the rules over one package: selects, isolates, groups, sorts."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import product
from time import perf_counter
from typing import Any, Protocol

from checker.finding import Severity
from checker.page import parse_page
from checker.profiles import Profile
from checker.report.report import Cause, NotChecked, ReportedFinding
from checker.rule import Context, Finding, Rule, Unchecked
from checker.settings import Settings


@dataclass(frozen=True)
class NotAtHand:
    """A part of a package that a rule asks for and that cannot be had.

    Attributes:
        reason: Why, as the end of a sentence.
        applicable: False when the package has no such part and needs none.
    """

    reason: str
    applicable: bool = True


class Parts(Protocol):
    """Gives the parts of a package by their type."""

    def part(self, kind: type) -> Sequence[object] | NotAtHand:
        """Return the part; several when a file holds several robots."""
        ...


@dataclass(frozen=True)
class Outcome:
    """What the rules said.

    Attributes:
        seconds: Time spent in each rule, by id.
    """

    findings: tuple[ReportedFinding, ...]
    not_checked: tuple[NotChecked, ...]
    seconds: Mapping[str, float]


def run_rules(rules: Iterable[Rule], parts: Parts, profile: Profile, settings: Settings) -> Outcome:
    """Run the rules that profile and settings want; one that crashes stops no other."""
    findings: list[ReportedFinding] = []
    not_checked: list[NotChecked] = []
    seconds: dict[str, float] = {}
    for rule in rules:
        if not profile.includes(rule):
            continue
        if not settings.selects(rule):
            if not settings.select:
                not_checked.append(NotChecked(rule.id, "switched off", Cause.SWITCHED_OFF))
            continue
        started = perf_counter()
        said = _run_isolated(rule, parts, profile.context, settings)
        seconds[rule.id] = perf_counter() - started
        if isinstance(said, NotChecked):
            not_checked.append(said)
            continue
        findings += _report(
            rule, [each for each in said if isinstance(each, Finding)], profile, settings
        )
        reasons = dict.fromkeys(each.reason for each in said if isinstance(each, Unchecked))
        not_checked += [NotChecked(rule.id, reason, Cause.NOT_AT_HAND) for reason in reasons]
    return Outcome(_sorted(_distinct(findings)), tuple(not_checked), seconds)


def _run_isolated(
    rule: Rule, parts: Parts, context: Context, settings: Settings
) -> list[Finding | Unchecked] | NotChecked:
    """Run one rule; what goes wrong inside it is the checker's fault and says so."""
    try:
        arguments = _arguments(rule, parts, context)
        if isinstance(arguments, NotAtHand):
            cause = Cause.NOT_AT_HAND if arguments.applicable else Cause.NOT_APPLICABLE
            return NotChecked(rule.id, arguments.reason, cause)
        options = _options(rule, settings)
        return [found for each in arguments for found in rule.check(**each, **options)]
    except Exception as error:  # noqa: BLE001 - the other rules go on, the exit code says so
        reason = f"{rule.id} could not run ({type(error).__name__}: {error}); please report this"
        return NotChecked(rule.id, reason, Cause.CRASHED)


def _arguments(rule: Rule, parts: Parts, context: Context) -> list[dict[str, Any]] | NotAtHand:
    """Return one set of arguments for each combination of the parts that a rule asks for."""
    wanted: dict[str, Sequence[object]] = {}
    for name, kind in rule.needs.items():
        had = (context,) if kind is Context else parts.part(kind)
        if isinstance(had, NotAtHand):
            return had
        wanted[name] = had
    return [dict(zip(wanted, each, strict=True)) for each in product(*wanted.values())]


def _options(rule: Rule, settings: Settings) -> dict[str, Any]:
    chosen = settings.options.get(rule.id, {})
    return {k: tuple(v) if isinstance(v, list) else v for k, v in chosen.items()}


def _report(
    rule: Rule, found: list[Finding], profile: Profile, settings: Settings
) -> Iterator[ReportedFinding]:
    """Join findings that are one fault in many places, and add what the rule's page says."""
    page = parse_page(rule.page)
    groups: dict[tuple[Severity, str], list[Finding]] = {}
    for each in found:
        severity = _severity(rule, each, profile, settings)
        groups.setdefault((severity, each.key or each.message), []).append(each)
    for (severity, key), group in groups.items():
        first = group[0]
        places = tuple(dict.fromkeys(place for each in group for place in each.places))
        fix = first.fix
        if fix is not None and len(group) > 1:
            edits = [edit for each in group if each.fix for edit in each.fix.edits]
            fix = replace(fix, edits=tuple(dict.fromkeys(edits)))
        yield ReportedFinding(
            rule.id,
            rule.name,
            severity,
            first.message,
            _fingerprint(rule.id, places[0].file, places[0].element, key if first.key else ""),
            places,
            fix,
            page.reason,
            " ".join(page.fix.split()),
        )


def _severity(rule: Rule, found: Finding, profile: Profile, settings: Settings) -> Severity:
    """The user's word counts most, then the finding's, then the rule's; a profile can lower it."""
    if rule.id in settings.severity:
        return settings.severity[rule.id]
    severity = found.severity or rule.severity
    limit = profile.severity.get(rule.id)
    return max(severity, limit, key=lambda s: s.rank) if limit else severity


def _fingerprint(*parts: str) -> str:
    return hashlib.sha256("\0".join(parts).encode()).hexdigest()[:16]


def _distinct(findings: list[ReportedFinding]) -> list[ReportedFinding]:
    """Number findings that would have one fingerprint, in the order of their places."""
    seen: dict[str, int] = {}
    distinct = []
    for each in findings:
        number = seen.get(each.fingerprint, 0)
        seen[each.fingerprint] = number + 1
        fingerprint = _fingerprint(each.fingerprint, str(number)) if number else each.fingerprint
        distinct.append(replace(each, fingerprint=fingerprint))
    return distinct


def _sorted(findings: list[ReportedFinding]) -> tuple[ReportedFinding, ...]:
    def key(each: ReportedFinding) -> tuple[int, str, int, int, str]:
        place = each.places[0]
        return each.severity.rank, place.file, place.line, place.column, each.rule

    return tuple(sorted(findings, key=key))
