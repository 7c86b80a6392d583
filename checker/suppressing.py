"""Runs the rules, and judges at the end how their findings were set aside.

Rules about suppressions need to know what all others found; those about the baseline, which of its
entries nothing was found of.
"""

from __future__ import annotations

from collections.abc import Sequence

from checker.discovery import all_rules
from checker.engine import Outcome, joined, run_rules
from checker.parts import NotAtHand, Parts
from checker.profiles import Profile
from checker.record import record
from checker.rule import Rule
from checker.settings import Settings
from checker.subject import Subject
from checker.suppression.parts import BaselineUse, Suppressions
from checker.suppression.silencing import Silencer


@record()
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

    held = settings.baseline.packages.get(subject.package.name, ())
    silencer = Silencer(subject.package, settings.suppress, all_rules(), held)
    outcome = run_rules(first, subject, profile, settings, silencer)
    used = silencer.suppressions(_looked(outcome), settings.source)
    said = run_rules(of_suppressions, _With(subject, used), profile, settings, silencer)
    outcome = joined(outcome, said)
    stale = _stale(silencer, outcome, settings)
    said = run_rules(of_baseline, _With(subject, stale), profile, settings, silencer)
    return joined(outcome, said)


def _looked(outcome: Outcome) -> set[str]:
    """Return the rules that looked at all they ask for, so that their silence tells something."""
    return set(outcome.looked) - {each.rule for each in outcome.not_checked}


def _stale(silencer: Silencer, outcome: Outcome, settings: Settings) -> BaselineUse:
    """Return what of the baseline is gone."""
    path = settings.baseline.path
    ids = {rule.id for rule in all_rules()}
    return BaselineUse(silencer.held.stale(ids, _looked(outcome), path.name if path else ""))
