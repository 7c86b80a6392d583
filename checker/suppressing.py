"""Runs the rules, and judges at the end how their findings were set aside.

Rules about suppressions need to know what all others found; those about the baseline, what is
left after the suppressions.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from checker.discovery import all_rules
from checker.engine import Outcome, joined, run_rules
from checker.parts import NotAtHand, Parts
from checker.profiles import Profile
from checker.rule import Rule
from checker.settings import Settings
from checker.subject import Subject
from checker.suppression.baseline import BaselineEntry
from checker.suppression.matching import matched, stale_by_rule
from checker.suppression.parts import BaselineUse, Suppressions
from checker.suppression.silencing import Silencer


@dataclass(frozen=True)
class _With:
    """The parts of a package, and one that is known only at the end."""

    parts: Parts
    last: object

    def part(self, kind: type) -> Sequence[object] | NotAtHand:
        """Return the part."""
        return (self.last,) if isinstance(self.last, kind) else self.parts.part(kind)


def run_and_set_aside(
    rules: Sequence[Rule], subject: Subject, profile: Profile, settings: Settings
) -> Outcome:
    """Run rules over a package and part what they find from what does not count."""
    of_suppressions = [rule for rule in rules if Suppressions in rule.needs.values()]
    of_baseline = [rule for rule in rules if BaselineUse in rule.needs.values()]
    first = [rule for rule in rules if rule not in (*of_suppressions, *of_baseline)]

    silencer = Silencer(subject.package, settings.suppress, all_rules())
    outcome = run_rules(first, subject, profile, settings, silencer)
    used = silencer.suppressions(_looked(outcome), settings.source)
    said = run_rules(of_suppressions, _With(subject, used), profile, settings, silencer)
    outcome, stale = _without_baseline(joined(outcome, said), subject.package.name, settings)
    said = run_rules(of_baseline, _With(subject, stale), profile, settings, silencer)
    return joined(outcome, said)


def _looked(outcome: Outcome) -> set[str]:
    """Return the rules that looked at all they ask for, so that their silence tells something."""
    return set(outcome.looked) - {each.rule for each in outcome.not_checked}


def _without_baseline(
    outcome: Outcome, package: str, settings: Settings
) -> tuple[Outcome, BaselineUse]:
    """Set aside what the baseline holds, and return what of it is stale."""
    baseline = settings.baseline
    known: Mapping[str, Sequence[BaselineEntry]] = baseline.packages
    found = matched(outcome.findings, known.get(package, ()))
    left = replace(
        outcome, findings=found.left, suppressed=(*outcome.suppressed, *found.suppressed)
    )
    file = baseline.path.name if baseline.path else ""
    ids = {rule.id for rule in all_rules()}
    return left, BaselineUse(stale_by_rule(found.stale, ids, _looked(outcome), file))
