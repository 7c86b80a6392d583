"""From paths to a report: the whole pipeline on one screen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import chain
from pathlib import Path
from time import perf_counter
from typing import Any

from checker.cache import NO_CACHE, Cache, cache_folder
from checker.collection import collection_put_off
from checker.discovery import all_rules
from checker.engine import crashed, needed_parts, run_rules
from checker.errors import UnreadableInput
from checker.facts import facts_of
from checker.measured import measured
from checker.options import check_against_rules
from checker.package.opening import open_input
from checker.package.package import Package
from checker.profiles import profile
from checker.recall import memory_key, recalled, remember
from checker.report.report import (
    Cause,
    InheritedPart,
    NotChecked,
    NotOpened,
    PackageReport,
    Report,
)
from checker.settings import Settings, find_settings, folders_above
from checker.stages import Say, Stages, say_nothing
from checker.subject import Subject
from checker.trial.robot_trial import RobotTrial
from checker.versions import versions


def check_package(path: Path, settings: Settings | None = None) -> Report:
    """Check a package, an archive, a folder of packages or a model file.

    Args:
        path: What to check.
        settings: What to judge; those found beside each package when None.

    Raises:
        UnreadableInput: There is nothing to check at the path.
        InvalidSettings: The settings name what does not exist.
    """
    return _report([list(_check_input(_Task(path, settings=settings)))])


def check_paths(
    paths: Sequence[Path], wishes: Mapping[str, Any], jobs: int = 1, say: Say = say_nothing
) -> Report:
    """Check several inputs; one that cannot be opened does not keep the others from it.

    Args:
        paths: What to check.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        jobs: Processes.
        say: Told what takes long when it begins; called in each of the processes.

    Raises:
        InvalidSettings: The settings name what does not exist.
    """
    tasks = [task for path in paths for task in _tasks(path, wishes, jobs, say)]
    if jobs > 1 and len(tasks) > 1:
        from concurrent.futures import ProcessPoolExecutor

        with ProcessPoolExecutor(jobs) as pool:
            return _report(list(pool.map(_check_or_say_why_not, tasks)))
    return _report([_check_or_say_why_not(task) for task in tasks])


@dataclass(frozen=True)
class _Task:
    """What one process does at a time.

    Attributes:
        path: As the user gave it.
        only: Name of the one package to check there; empty for all.
        settings: To judge by, instead of those beside the package.
        wishes: Fields of the settings to replace.
        say: Told what takes long.
    """

    path: Path
    only: str = ""
    settings: Settings | None = None
    wishes: Mapping[str, Any] = field(default_factory=dict)
    say: Say = say_nothing

    def settings_for(self, package: Package) -> Settings:
        """Return the settings that judge a package; no search leaves an unpacked archive."""
        if self.settings is not None:
            return self.settings
        given = self.path.resolve()
        folders = folders_above(package.root)
        if given.is_file() and not package.only:
            inside = folders_above(package.root, top=package.workspace.directories[0])
            folders = chain(inside, folders_above(given.parent))
        return find_settings(folders).overridden(**self.wishes)

    def shown(self, package: Package) -> str:
        """Return the package's path as the user would write it."""
        if package.only:
            return str(self.path.parent)
        given = self.path.resolve()
        if package.root.is_relative_to(given):
            return str(self.path / package.root.relative_to(given))
        return str(self.path / package.name)


def _tasks(path: Path, wishes: Mapping[str, Any], jobs: int, say: Say) -> list[_Task]:
    """Part a folder into its packages, so that processes can share them."""
    try:
        if jobs > 1 and path.is_dir():
            with open_input(path) as opened:
                names = [each.name for each in opened.packages]
            return [_Task(path, name, wishes=wishes, say=say) for name in names]
    except (UnreadableInput, OSError):
        pass  # the task that meets it again says so
    return [_Task(path, wishes=wishes, say=say)]


_Checked = list[PackageReport | NotOpened]


def _check_or_say_why_not(task: _Task) -> _Checked:
    try:
        return list(_check_input(task))
    except UnreadableInput as error:
        return [NotOpened(str(task.path), f"{error.reason}; {error.advice}", failed=True)]


def _check_input(task: _Task) -> Iterator[PackageReport | NotOpened]:
    started = perf_counter()
    with open_input(task.path) as opened:
        opening = perf_counter() - started
        for package in opened.packages:
            if task.only in ("", package.name):
                settings = task.settings_for(package)
                check_against_rules(settings, all_rules())
                report = _check_isolated(package, task.shown(package), settings, task.say)
                yield replace(report, timings={"open": opening, **report.timings})
        for each in opened.skipped:
            yield NotOpened(str(task.path / each.name), each.reason, failed=False)


def _check_isolated(package: Package, shown: str, settings: Settings, say: Say) -> PackageReport:
    """Check one package; what goes wrong with it is reported, and the others are checked."""
    try:
        with collection_put_off():
            return _check_or_recall(package, shown, settings, say)
    except Exception as error:  # noqa: BLE001 - the other packages go on, the exit code says so
        broken = (crashed("check", error),)
        return PackageReport(package.name, shown, "unknown", (), broken)


def _check_or_recall(package: Package, shown: str, settings: Settings, say: Say) -> PackageReport:
    """Check a package, or take the report of it from the cache while it is the same."""
    started = perf_counter()
    cache = Cache(cache_folder()) if settings.cache else NO_CACHE
    key = memory_key(package, settings) if settings.cache else ""
    known = recalled(cache, key, shown)
    if known is not None:
        return replace(known, timings={"recall": perf_counter() - started})
    stages = Stages(lambda words: say(f"{package.name}: {words}"))
    report = _check_one(Subject(package, cache, stages), shown, settings)
    remember(cache, key, report)
    return report


def _check_one(subject: Subject, shown: str, settings: Settings) -> PackageReport:
    package, judge = subject.package, profile(settings.profile)
    with subject.stages.stage("rules", "rules"):
        subject.start(needed_parts(all_rules(), judge, settings))
        outcome = run_rules(all_rules(), subject, judge, settings)
    blind = [
        NotChecked("PKG003", f"{fault.path} {fault.reason}", Cause.NOT_AT_HAND)
        for fault in package.index.faults
    ]
    facts, trouble = _facts(subject)
    driven = subject.provided(RobotTrial)
    return PackageReport(
        package.name,
        shown,
        str(package.kind),
        outcome.findings,
        (*outcome.not_checked, *blind, *trouble),
        tuple(
            InheritedPart(each.part, each.package_name, each.at_hand) for each in package.inherited
        ),
        facts,
        dict(subject.stages.seconds),
        settings.profile,
        settings.fail_on,
        settings.description,
        measured(driven[0], outcome) if driven else None,
    )


def _facts(subject: Subject) -> tuple[Mapping[str, Any], tuple[NotChecked, ...]]:
    try:
        return facts_of(subject), ()
    except Exception as error:  # noqa: BLE001 - a reader that fails takes no finding with it
        return {}, (crashed("facts", error),)


def _report(done: Sequence[_Checked]) -> Report:
    """Join what was checked; a package that was given twice is reported once."""
    packages: dict[tuple[Path, str], PackageReport] = {}
    not_opened: dict[NotOpened, None] = {}
    for each in chain.from_iterable(done):
        if isinstance(each, NotOpened):
            not_opened[each] = None
        else:
            packages.setdefault((Path(each.path).resolve(), each.name), each)
    ordered = sorted(packages.values(), key=lambda each: (each.name, each.path))
    return Report(tuple(ordered), versions(), tuple(not_opened))
