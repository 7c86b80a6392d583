"""Judges one package: its parts, the rules, and the results."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from functools import partial
from typing import TypeVar

from msgspec.structs import replace

from checker.base.allowance import Exceeded
from checker.base.cache import Cache
from checker.base.extras import PHYSICS
from checker.base.files import NotReadable
from checker.base.garbage_collection import collection_put_off
from checker.base.output import Say, Stages
from checker.base.parts import NotAvailable, type_name
from checker.engine.early_parts import begin, begin_display, begin_meshes
from checker.engine.facts import facts_of, trials_of
from checker.engine.judge import Judge
from checker.engine.launched import launched_files_of
from checker.engine.options import check_against_rules
from checker.engine.other_robots import (
    new_findings,
    other_descriptions,
    rules_of_one_robot,
    with_only_robot,
)
from checker.engine.real_paths import neighbours_of, with_real_paths
from checker.engine.run import Outcome, join_outcomes, run_rules, unfinished
from checker.engine.subject import Subject
from checker.engine.unread_robots import unread_robots
from checker.model.devices.known import known_devices
from checker.model.robot import Robot
from checker.package.package import Package
from checker.physics.trial.robot_trial import RobotTrial
from checker.report.report import (
    FILES,
    NO_PHYSICS,
    ROBOT,
    Cause,
    Display,
    InheritedPart,
    NotChecked,
    PackageReport,
    ReportedFinding,
)
from checker.report.scene.processes import NO_PROCESSES, StartedProcesses
from checker.robots.unspawned import unstarted_world
from checker.rule import Rule
from checker.rulebook.rule_index import rules
from checker.rulebook.suppression.matcher import SuppressionMatcher
from checker.rulebook.suppression.parts import BaselineUse, Suppressions
from checker.settings import Settings

T = TypeVar("T")

_LAUNCH = (".launch", "launch.py", "launch.xml", "launch.yaml", "launch.yml")
"""How the names of launch files end."""
_SHOWN = 10
"""XML files that are too large, by their names."""

# Rules about suppressions need to know what all others found; those about the baseline, which of
# its entries nothing was found of.


def run_and_set_aside(
    chosen: Sequence[Rule],
    every: Sequence[Rule],
    subject: Subject,
    judge: Judge,
) -> Outcome:
    """Run rules over a package and part what they find from what does not count.

    Args:
        chosen: The rules to choose from; the selected ones run.
        every: All that there are, which suppressions may name.
        subject: The package.
        judge: States which are wanted, and how severe their findings are.
    """
    settings = judge.settings
    of_suppressions = [rule for rule in chosen if type_name(Suppressions) in rule.needs.values()]
    of_baseline = [rule for rule in chosen if type_name(BaselineUse) in rule.needs.values()]
    first = [rule for rule in chosen if rule not in (*of_suppressions, *of_baseline)]

    held = settings.baseline.packages.get(subject.package.name, ())
    matcher = SuppressionMatcher(subject.package, settings.suppress, every, held)
    unloaded = subject.package.unloaded_files
    unstarted = unstarted_world(subject.package)
    folder = subject.package.vendored_in
    copied = f"in {folder}/, a copied repository that nothing else uses" if folder else ""
    run = partial(run_rules, unstarted=unstarted, copied=copied, allowance=subject.allowance)
    outcome = run(first, subject, judge, matcher, unloaded)
    for description in other_descriptions(subject):
        other = with_only_robot(subject, description)
        added = run(rules_of_one_robot(first), other, judge, matcher, unloaded)
        outcome = join_outcomes(outcome, new_findings(added, outcome, description))
    used = matcher.suppressions(_looked(outcome), settings.source)
    added = run(of_suppressions, subject.with_part(used), judge, matcher)
    outcome = join_outcomes(outcome, added)
    stale = _stale(matcher, outcome, settings, {rule.id for rule in every})
    added = run(of_baseline, subject.with_part(stale), judge, matcher)
    return join_outcomes(outcome, added)


def _looked(outcome: Outcome) -> set[str]:
    """Return the ids of rules that ran on complete data."""
    return set(outcome.looked) - {skipped.rule for skipped in outcome.not_checked}


def _stale(
    matcher: SuppressionMatcher, outcome: Outcome, settings: Settings, ids: set[str]
) -> BaselineUse:
    """Return what of the baseline is gone."""
    path = settings.baseline.path
    return BaselineUse(matcher.held.stale(ids, _looked(outcome), path.name if path else ""))


def judge_package(
    package: Package,
    shown: str,
    settings: Settings,
    cache: Cache,
    say: Say,
    processes: StartedProcesses = NO_PROCESSES,
) -> PackageReport:
    """Return the report of a package; what goes wrong with it is in it, and nothing is raised.

    Args:
        package: What to judge.
        shown: Its path as the user gave it.
        settings: The selected rules and their severities.
        cache: The cache of results that take long.
        say: Called with a message when a long step starts.
        processes: Processes that wait for something to do; they are stopped in the end.

    Raises:
        InvalidSettings: The settings name a rule or option that does not exist.
    """
    settings = settings.for_package(package)
    stages = Stages(lambda words: say(f"{package.name}: {words}"))
    devices = known_devices(settings.devices)
    subject = Subject(package, cache, stages, devices, processes, settings.xacro_args)
    try:
        if not settings.select:
            # Some rules always need the meshes: these are read while those load.
            begin_meshes(subject)
        known = rules(cache)
        check_against_rules(settings, known)
        report = _report_or_crash(subject, shown, settings, known)
        momentary = (unseen.reason for unseen in report.not_checked if unseen.momentary)
        return replace(report, disturbed=cache.disturbed or next(momentary, ""))
    finally:
        subject.close()


@collection_put_off()
def findings_of(package: Package, settings: Settings, cache: Cache) -> tuple[ReportedFinding, ...]:
    """Return what the rules find in a package; for what needs no more than that.

    Raises:
        InvalidSettings: The settings name a rule or option that does not exist.
    """
    settings = settings.for_package(package)
    devices = known_devices(settings.devices)
    subject = Subject(package, cache, devices=devices, xacro_args=settings.xacro_args)
    try:
        known = rules(cache)
        check_against_rules(settings, known)
        return run_and_set_aside(known, known, subject, Judge.from_settings(settings)).findings
    finally:
        subject.close()


def _report_or_crash(
    subject: Subject, shown: str, settings: Settings, known: Sequence[Rule]
) -> PackageReport:
    try:
        return _report(subject, shown, settings, known)
    except (Exception, Exceeded) as error:  # noqa: BLE001 - the others continue, the exit code says so
        broken = (unfinished("check", error),)
        return PackageReport(subject.package.name, shown, "unknown", (), broken)


def _report(
    subject: Subject, shown: str, settings: Settings, known: Sequence[Rule]
) -> PackageReport:
    package, judge = subject.package, Judge.from_settings(settings)
    with subject.stages.stage("rules", "rules"):
        # A part that exceeds its limits fails again when a rule requests it.
        with suppress(Exceeded), subject.allowance.piece():
            begin(subject, judge.needed_parts(known))
            if settings.display:
                begin_display(subject)
        outcome = run_and_set_aside(known, known, subject, judge)
    unread = what_is_unread(subject)
    robots, trouble = _piece(subject, "facts", lambda: facts_of(subject))
    trials = trials_of(subject, outcome, known)
    launched, unwired = _piece(subject, "launched", lambda: launched_files_of(subject))
    display, undrawn = _display(subject) if settings.display else (None, ())
    return PackageReport(
        package.name,
        shown,
        str(package.kind),
        tuple(with_real_paths(package, outcome.findings)),
        (*outcome.not_checked, *unread, *trouble, *unwired, *undrawn),
        tuple(
            InheritedPart(part.part, part.package_name, part.at_hand) for part in package.inherited
        ),
        robots[0] if robots else {},
        dict(subject.stages.seconds),
        settings.profile,
        settings.fail_on,
        settings.description,
        trials[0] if trials else None,
        suppressed=outcome.suppressed,
        looked=tuple(outcome.looked),
        display=display,
        other_robots=robots[1:],
        other_trials=trials[1:],
        target_reason=settings.target_reason,
        neighbours=neighbours_of(package, outcome.findings),
        vendored=package.vendored_in,
        launched=launched,
    )


def what_is_unread(subject: Subject) -> tuple[NotChecked, ...]:
    """Return which files, folders and robots of a package could not be read, and why."""
    blind = (NotChecked(FILES, why, Cause.NOT_AT_HAND) for why in _unread(subject.package))
    unread, undone = _piece(subject, ROBOT, lambda: tuple(unread_robots(subject)))
    return (*blind, *unread, *undone)


def _unread(package: Package) -> Iterator[str]:
    """Yield which files and folders could not be read, and why."""
    yield from (f"{fault.path} {fault.reason}" for fault in package.index.faults)
    for path in package.index.entries:
        is_own = path.endswith(_LAUNCH) and not package.lies_in_unit(path)
        source = package.read(path) if is_own else None
        if isinstance(source, NotReadable):
            yield f"{path} {source.reason}"
    large = package.too_large
    yield from (f"{file.path} {file.reason}" for file in large[:_SHOWN])
    if len(large) > _SHOWN:
        yield f"{len(large) - _SHOWN} more XML files are too large to be checked"


def _piece(
    subject: Subject, name: str, make: Callable[[], tuple[T, ...]]
) -> tuple[tuple[T, ...], tuple[NotChecked, ...]]:
    """Return what is made of a subject besides its findings, which a failure leaves as they are."""
    try:
        with subject.allowance.piece():
            return make(), ()
    except (Exception, Exceeded) as error:  # noqa: BLE001 - a reader that fails takes no finding with it
        return (), (unfinished(name, error),)


def _display(subject: Subject) -> tuple[Display | None, tuple[NotChecked, ...]]:
    robot = subject.one(Robot)
    if isinstance(robot, NotAvailable):
        return None, ()
    if not PHYSICS.is_installed:
        return None, (NotChecked("display", NO_PHYSICS, Cause.SWITCHED_OFF),)
    from checker.engine.display import RobotDisplay

    display = subject.one(RobotDisplay)
    if isinstance(display, NotAvailable):
        return None, ()
    trials = (each.trial for each in subject.cached_parts(RobotTrial) if each.robot is robot)
    try:
        with subject.allowance.piece():
            return display.build(next(trials, None)), ()
    except (Exception, Exceeded) as error:  # noqa: BLE001 - what cannot be drawn takes no finding with it
        return None, (unfinished("display", error),)
