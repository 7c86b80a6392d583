"""Judges one package: its parts, the rules over them, and what is known at the end."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from checker.cache import Cache
from checker.collection import collection_put_off
from checker.discovery import all_rules
from checker.display.early import NO_CHILDREN, EarlyChildren
from checker.engine import crashed, needed_parts
from checker.facts import facts_of
from checker.measured import measured
from checker.model.known_devices import known_devices
from checker.options import check_against_rules
from checker.package.package import Package
from checker.parts import NotAtHand
from checker.profiles import profile
from checker.report.report import (
    Cause,
    Display,
    InheritedPart,
    NotChecked,
    PackageReport,
    ReportedFinding,
)
from checker.saying import Say, Stages
from checker.settings import Settings
from checker.subject import Subject
from checker.suppressing import run_and_set_aside
from checker.trial.robot_trial import RobotTrial


def judged(
    package: Package,
    shown: str,
    settings: Settings,
    cache: Cache,
    say: Say,
    early: EarlyChildren = NO_CHILDREN,
) -> PackageReport:
    """Return the report of a package; what goes wrong with it is in it, and nothing is raised.

    Args:
        package: What to judge.
        shown: Its path as the user gave it.
        settings: By which rules, and how strictly.
        cache: Where results that take long are kept.
        say: Told what takes long when it begins.
        early: Children that wait for something to do; they are stopped in the end.

    Raises:
        InvalidSettings: The settings name a rule or option that does not exist.
    """
    settings = settings.suiting(urdf=package.is_urdf)
    stages = Stages(lambda words: say(f"{package.name}: {words}"))
    devices = known_devices(settings.devices)
    subject = Subject(package, cache, stages, devices, early)
    try:
        if not settings.select:
            # Whatever the rules are, some ask for the meshes: these are read while those load.
            subject.start_meshes()
        check_against_rules(settings, all_rules())
        return _report_or_crash(subject, shown, settings)
    finally:
        subject.close()


@collection_put_off()
def findings_of(package: Package, settings: Settings, cache: Cache) -> tuple[ReportedFinding, ...]:
    """Return what the rules find in a package; for what needs no more than that.

    Raises:
        InvalidSettings: The settings name a rule or option that does not exist.
    """
    settings = settings.suiting(urdf=package.is_urdf)
    subject = Subject(package, cache, devices=known_devices(settings.devices))
    try:
        check_against_rules(settings, all_rules())
        judge = profile(settings.profile)
        return run_and_set_aside(all_rules(), subject, judge, settings).findings
    finally:
        subject.close()


def _report_or_crash(subject: Subject, shown: str, settings: Settings) -> PackageReport:
    try:
        return _report(subject, shown, settings)
    except Exception as error:  # noqa: BLE001 - the other packages go on, the exit code says so
        broken = (crashed("check", error),)
        return PackageReport(subject.package.name, shown, "unknown", (), broken)


def _report(subject: Subject, shown: str, settings: Settings) -> PackageReport:
    package, judge = subject.package, profile(settings.profile)
    with subject.stages.stage("rules", "rules"):
        subject.start(needed_parts(all_rules(), judge, settings))
        if settings.display and not isinstance(subject.displaying, NotAtHand):
            subject.displaying.begin()
        outcome = run_and_set_aside(all_rules(), subject, judge, settings)
    blind = [
        NotChecked("PKG003", f"{fault.path} {fault.reason}", Cause.NOT_AT_HAND)
        for fault in package.index.faults
    ]
    facts, trouble = _facts(subject)
    driven = subject.provided(RobotTrial)
    display, undrawn = _display(subject) if settings.display else (None, ())
    return PackageReport(
        package.name,
        shown,
        str(package.kind),
        outcome.findings,
        (*outcome.not_checked, *blind, *trouble, *undrawn),
        tuple(
            InheritedPart(each.part, each.package_name, each.at_hand) for each in package.inherited
        ),
        facts,
        dict(subject.stages.seconds),
        settings.profile,
        settings.fail_on,
        settings.description,
        measured(driven[0], outcome) if driven else None,
        suppressed=outcome.suppressed,
        looked=tuple(outcome.looked),
        display=display,
    )


def _facts(subject: Subject) -> tuple[Mapping[str, Any], tuple[NotChecked, ...]]:
    try:
        return facts_of(subject), ()
    except Exception as error:  # noqa: BLE001 - a reader that fails takes no finding with it
        return {}, (crashed("facts", error),)


def _display(subject: Subject) -> tuple[Display | None, tuple[NotChecked, ...]]:
    if isinstance(subject.displaying, NotAtHand):
        return None, ()
    driven = subject.provided(RobotTrial)
    try:
        return subject.displaying.made(driven[0].trial if driven else None), ()
    except Exception as error:  # noqa: BLE001 - what cannot be drawn takes no finding with it
        return None, (crashed("display", error),)
