"""A check of a package while it is written: by the rules that need neither weights nor a trial."""

from __future__ import annotations

from functools import cached_property

from checker.base.cache import Cache
from checker.base.parts import type_name
from checker.engine.judge import TRIALS, Judge
from checker.engine.options import check_against_rules
from checker.engine.review import run_and_set_aside
from checker.engine.run import Outcome
from checker.engine.subject import Subject
from checker.model.devices.known import known_devices
from checker.model.sensing.view import SensorViews
from checker.package.package import Package
from checker.physics.mass.mass_properties import MassProperties
from checker.report.report import Cause, NotChecked, ReportedFinding
from checker.report.scene.processes import StartedProcesses
from checker.rule import Rule
from checker.rulebook.rule_index import rules
from checker.settings import Settings

MEASURED = TRIALS.union(map(type_name, (MassProperties, SensorViews)))
"""Names of the types of parts that take long: what Pinocchio weighs, what sensors see, trials."""


class Checked:
    """Results of a check of a package in one state of its texts.

    Attributes:
        package: The package in this state.
        subject: Its parts, each read on the first request.
        settings: The settings of the check.
        outcome: The results of the rules.
    """

    def __init__(
        self, package: Package, settings: Settings, cache: Cache, processes: StartedProcesses
    ) -> None:
        """Check it.

        Args:
            package: The package with the texts of the editor.
            settings: The user's.
            cache: The cache of results.
            processes: The processes that expand xacro files and read meshes; they keep running.

        Raises:
            InvalidSettings: The settings name a rule or option that does not exist.
        """
        known = rules(cache)
        check_against_rules(settings, known)
        self.package = package
        self.settings = settings.with_overrides(trial=False).for_package(package)
        devices, args = known_devices(settings.devices), settings.xacro_args
        self.subject = Subject(
            package, cache, devices=devices, processes=processes, xacro_args=args
        )
        self.outcome = self._outcome(known)

    def _outcome(self, known: tuple[Rule, ...]) -> Outcome:
        chosen = [rule for rule in known if not is_measured(rule)]
        return run_and_set_aside(chosen, known, self.subject, Judge.from_settings(self.settings))

    @property
    def findings(self) -> tuple[ReportedFinding, ...]:
        """Findings of the rules."""
        return self.outcome.findings

    @cached_property
    def blind_spots(self) -> tuple[NotChecked, ...]:
        """Rules that could not run, each with its reason."""
        causes = (Cause.NOT_AT_HAND, Cause.CRASHED)
        return tuple(each for each in self.outcome.not_checked if each.cause in causes)


def is_measured(rule: Rule) -> bool:
    """Return whether a rule needs slow parts."""
    return not MEASURED.isdisjoint(rule.needs.values())
