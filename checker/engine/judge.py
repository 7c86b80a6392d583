"""Selection of the rules to run over a package, and the severity of their findings."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from msgspec.structs import asdict, replace

from checker.base.parts import type_name
from checker.base.record import Record
from checker.finding import Severity
from checker.formats.urdf.second_reading import SecondReading
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial, SettledTrial
from checker.report.report import NO_TRIAL, Cause, NotChecked
from checker.rule import Context, Finding, Rule
from checker.rulebook.profiles import Profile
from checker.settings import Settings

_THOROUGH = frozenset(map(type_name, (RepeatedTrial, SecondReading)))
TRIALS = frozenset(map(type_name, (RobotTrial, SettledTrial, RepeatedTrial)))
"""Names of the types of parts for which the robot is driven."""


class GradedFinding(Finding):
    """A finding with its final severity."""

    severity: Severity = Severity.ERROR


class Judge(Record):
    """Selection and severities of rules, from a profile and the user's settings."""

    profile: Profile
    settings: Settings

    @classmethod
    def from_settings(cls, settings: Settings) -> Judge:
        """Return the judge with the profile that the settings name."""
        return cls(settings.judge_profile, settings)

    @property
    def context(self) -> Context:
        """Facts about the check that rules may use."""
        return replace(self.profile.context, payload=self.settings.payload)

    def is_selected(self, rule: Rule) -> bool:
        """Return whether a rule runs: it is in the profile, or the user names it."""
        needs_trial = not TRIALS.isdisjoint(rule.needs.values())
        return self._asked_for(rule) and (self.settings.trial or not needs_trial)

    def needed_parts(self, rules: Iterable[Rule]) -> set[str]:
        """Return the names of the types of parts that the selected rules need."""
        return {kind for rule in filter(self.is_selected, rules) for kind in rule.needs.values()}

    def switched_off(self, rule: Rule) -> Iterator[NotChecked]:
        """Yield why a rule that does not run was switched off; nothing if it was never selected."""
        selected, included = self.settings.selects(rule), self.profile.includes(rule)
        if self._asked_for(rule):
            yield NotChecked(rule.id, NO_TRIAL, Cause.SWITCHED_OFF)
        elif self.settings.select and selected and not included:
            reason = f"not in the profile {self.profile.name}; `--select {rule.id}` runs it"
            yield NotChecked(rule.id, reason, Cause.SWITCHED_OFF)
        elif not selected and included and not self.settings.select:
            yield NotChecked(rule.id, "switched off", Cause.SWITCHED_OFF)

    def _asked_for(self, rule: Rule) -> bool:
        settings = self.settings
        if not settings.thorough and not _THOROUGH.isdisjoint(rule.needs.values()):
            return False
        return settings.selects(rule) and (settings.names(rule) or self.profile.includes(rule))

    def grade(self, rule: Rule, finding: Finding) -> GradedFinding:
        """Return a finding of a rule with its final severity."""
        severity = self.severity(rule, finding.severity)
        return GradedFinding(**{**asdict(finding), "severity": severity})

    def severity(self, rule: Rule, own: Severity | None = None) -> Severity:
        """Return the severity of a finding of a rule.

        The user's settings come first, then the finding's own, then the rule's; a profile can
        lower the latter two.
        """
        if rule.id in self.settings.severity:
            return self.settings.severity[rule.id]
        severity = own or rule.severity
        limit = self.profile.severity.get(rule.id)
        return max(severity, limit, key=lambda each: each.rank) if limit else severity
