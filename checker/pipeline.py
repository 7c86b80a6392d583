"""The pipeline from paths to a report."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from itertools import chain
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from msgspec import field
from msgspec.structs import replace

from checker.base.allowance import Allowance, Exceeded
from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.errors import InvalidSettings, UnreadableInput, momentary_cause
from checker.base.extras import PHYSICS
from checker.base.garbage_collection import collect_between, collection_put_off
from checker.base.output import Say, say_nothing
from checker.base.record import Record
from checker.base.resources import versions
from checker.base.words import shortened
from checker.engine.report_cache import memory_key, recall_report, remember
from checker.finding import Safety
from checker.package.inputs import Opened, open_input, with_package_path
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.report.report import (
    NotOpened,
    PackageReport,
    Report,
)
from checker.settings import Settings, find_settings, folders_above

if TYPE_CHECKING:
    from checker.base.child_server import Server
    from checker.report.scene.processes import StartedProcesses


def check_package(path: str | Path, settings: Settings | None = None) -> Report:
    """Check a package, an archive, a folder of packages or a model file.

    Args:
        path: What to check.
        settings: What to judge; for None, those next to each package.

    Raises:
        UnreadableInput: There is nothing to check at the path.
        InvalidSettings: The settings name what does not exist; not raised for those in a package's
            own folder, which the report lists as not opened.
    """
    return join_reports([tuple(_opened_and_checked(Task(Path(path), settings=settings)))])


def check_paths(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    say: Say = say_nothing,
    mesh_server: Callable[[], Server] | None = None,
) -> Report:
    """Check several inputs; one that cannot be opened does not keep the others from it.

    Args:
        paths: What to check.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        say: Called with a message when a long step starts.
        mesh_server: See `Task`.

    Raises:
        InvalidSettings: The settings name what does not exist; not raised for those in a package's
            own folder, which the report lists as not opened.
    """
    return join_reports(check_tasks(tasks_of(paths, wishes, say, mesh_server), 1))


Checked = tuple[PackageReport | NotOpened, ...]
"""The result of one task."""
_PATCHED = 2000
"""Findings whose fixes a report's patch contains; `--fix` makes all."""
_PROBLEM_LIMIT = 600
"""Characters of what is wrong with settings."""


class Task(Record):
    """Work of one process at a time: one package, or an archive with all that it contains.

    Attributes:
        path: The path as the user gave it.
        package: The one to check there; None if it has to be opened first.
        settings: The settings to judge by, instead of those next to the package.
        wishes: Fields of the settings to replace.
        say: Called with a message when a long step starts.
        mesh_server: Starts the reader of the meshes of a package, if not the usual one.
        result: The result, if it is known from the start: the input cannot be opened.
        opening: Seconds that it took to open the folder of the package.
    """

    path: Path
    package: Package | None = None
    settings: Settings | None = None
    wishes: Mapping[str, Any] = field(default_factory=dict)
    say: Say = say_nothing
    mesh_server: Callable[[], Server] | None = None
    result: Checked = ()
    opening: float = 0.0

    @property
    def display_path(self) -> str:
        """The path of what is checked as the user would write it."""
        return self.display_path_of(self.package) if self.package else str(self.path)

    def settings_for(self, package: Package) -> Settings:
        """Return the settings that judge a package; no search leaves an unpacked archive."""
        if self.settings is not None:
            return self.settings
        path = self.path.resolve()
        folders = folders_above(package.root)
        if path.is_file() and not package.only:
            inside = folders_above(package.root, top=package.workspace.directories[0])
            folders = chain(inside, folders_above(path.parent))
        return find_settings(folders).with_overrides(**self.wishes)

    def display_path_of(self, package: Package) -> str:
        """Return the package's path as the user would write it."""
        path = self.path.resolve()
        if package.only and path.is_file():
            return str(self.path.parent)
        if package.root.is_relative_to(path):
            return str(self.path / package.root.relative_to(path))
        return str(self.path / package.name)


def tasks_of(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    say: Say = say_nothing,
    mesh_server: Callable[[], Server] | None = None,
) -> list[Task]:
    """Return what there is to do, in the order of the report; see `check_paths`."""
    tasks: dict[tuple[Path, str], Task] = {}
    for path in paths:
        for task in _tasks_at(Task(path, None, None, wishes, say, mesh_server)):
            unit = (task.package.root, task.package.only) if task.package else (task.path, "")
            tasks.setdefault(unit, task)
    return sorted(tasks.values(), key=_order)


def _order(task: Task) -> tuple[bool, bool, str, bool]:
    """Return a sort key: models come behind packages, those of copied repositories last."""
    copied = task.package is not None and bool(task.package.vendored_in)
    model = task.package is not None and task.package.kind is PackageKind.BASE_MODEL
    return copied, model, task.display_path, bool(task.result)


def _tasks_at(task: Task) -> Iterator[Task]:
    """Part the check of a folder into those of its packages; an archive is opened in its turn."""
    if not _is_folder(task.path):
        yield task
        return
    started = perf_counter()
    try:
        with open_input(task.path) as opened:
            opening = perf_counter() - started
            for package in opened.packages:
                yield replace(task, package=package, opening=opening)
            for skipped in _not_opened(task.path, opened):
                yield replace(task, path=Path(skipped.path), result=(skipped,))
    except UnreadableInput as error:
        yield replace(task, result=(_failed(task.path, error),))


def _is_folder(path: Path) -> bool:
    try:
        return path.is_dir()
    except OSError:  # such as a name that is too long: said in its turn
        return False


def check_tasks(tasks: Sequence[Task], jobs: int) -> Iterator[Checked]:
    """Yield the result of each task, in their order.

    Args:
        tasks: The tasks as `tasks_of` returns them.
        jobs: Processes.

    Raises:
        InvalidSettings: See `check_paths`.
    """
    if min(jobs, len(tasks)) < 2:
        yield from map(_checked, collect_between(tasks))
        return
    from checker.base.process_pool import map_in_processes

    # What shows a message stays here: it is told what the other processes say.
    silent = [replace(task, say=say_nothing) for task in tasks]
    yield from map_in_processes(_checked_aloud, silent, jobs, tasks[0].say)


def _checked_aloud(task: Task, say: Say) -> Checked:
    return _checked(replace(task, say=say))


def _checked(task: Task) -> Checked:
    """Return the reports of a task, or why there is none."""
    if task.result:
        return task.result
    try:
        return tuple(_opened_and_checked(task))
    except UnreadableInput as error:
        return (_failed(task.path, error),)


def _opened_and_checked(task: Task) -> Iterator[PackageReport | NotOpened]:
    """Open what a task is about and check each package in it."""
    if task.package is not None:
        yield _report_of(task.package, task)
        return
    started = perf_counter()
    with open_input(task.path) as opened:
        task = replace(task, opening=perf_counter() - started)
        for package in collect_between(opened.packages):
            yield _report_of(package, task)
        yield from _not_opened(task.path, opened)


def _report_of(package: Package, task: Task) -> PackageReport | NotOpened:
    """Return the report of a package: the remembered one while nothing has changed."""
    started, shown = perf_counter(), task.display_path_of(package)
    try:
        settings = task.settings_for(package)
        package = with_package_path(package, settings.package_path)
        cache = Cache(cache_folder()) if settings.cache else NO_CACHE
        # An archive is unpacked into another folder each time.
        lasts = settings.cache and task.path.is_dir()
        key = memory_key(package, settings) if lasts else ""
        report = recall_report(cache, key, shown)
        if report is None:
            report = _judged(package, shown, settings, cache, task)
            remember(cache, key, report)
        else:
            report = replace(report, timings={"recall": perf_counter() - started})
    except InvalidSettings as error:
        if task.settings or error.path is None or not error.path.is_relative_to(package.root):
            raise
        return _unusable(error.path.relative_to(package.root), error, shown)
    return replace(report, timings={"open": task.opening, **report.timings})


def _judged(
    package: Package, shown: str, settings: Settings, cache: Cache, task: Task
) -> PackageReport:
    """Run the rules, which are loaded only now, as readers and engines are."""
    processes = _started_processes(package, settings, cache, task.mesh_server)
    with collection_put_off():
        from checker.engine.review import judge_package

        report = judge_package(package, shown, settings, cache, task.say, processes)
        return _with_patch(report, package) if settings.display else report


def _failed(path: Path, error: UnreadableInput) -> NotOpened:
    reason, disturbed = f"{error.reason}; {error.advice}", momentary_cause(error)
    return NotOpened(str(path), reason, failed=True, disturbed=disturbed)


def _not_opened(path: Path, opened: Opened) -> Iterator[NotOpened]:
    for skipped in opened.skipped:
        yield NotOpened(str(path / skipped.name), skipped.reason, failed=False)


def _unusable(file: Path, error: InvalidSettings, shown: str) -> NotOpened:
    """Return a package whose own settings are at fault; the others are checked anyway."""
    problem = shortened(error.problem, _PROBLEM_LIMIT)
    reason = f"is not checked, because its settings cannot be used: {file}: {problem}"
    return NotOpened(shown, reason, failed=True)


def _started_processes(
    package: Package, settings: Settings, cache: Cache, start: Callable[[], Server] | None
) -> StartedProcesses:
    """Start what loads its libraries while this process loads its own."""
    from checker.physics.mesh.process import are_new, mesh_server
    from checker.report.scene.processes import NO_PROCESSES, StartedProcesses, drawing_process

    if not PHYSICS.is_installed:
        return NO_PROCESSES
    reads = settings.display or (not settings.select and are_new(package, cache))
    return StartedProcesses(
        (start or mesh_server)().start() if reads else None,
        drawing_process() if settings.display else None,
    )


def _with_patch(report: PackageReport, package: Package) -> PackageReport:
    """Add the patch of the safe fixes, where it was requested."""
    from checker.fix.rounds import one_round, patch

    started = perf_counter()
    changes = ""
    # A request for a patch that cannot be made raises the reason.
    with suppress(Exception, Exceeded), Allowance().piece():
        changes = patch(one_round(package, report.findings[:_PATCHED], (Safety.SAFE,)))
    timings = {**report.timings, "patch": perf_counter() - started}
    return replace(report, patch=changes, timings=timings)


def settings_of(path: Path) -> Iterator[Settings]:
    """Yield the settings of each package at a path, except those that cannot be used.

    For packages in an archive these are the defaults: nothing that they name lasts.

    Raises:
        UnreadableInput: There is nothing to check at the path.
    """
    task = Task(path)
    with open_input(path) as opened:
        for package in opened.packages:
            lasts = package.only or path.is_dir()
            with suppress(InvalidSettings):
                yield task.settings_for(package) if lasts else Settings()


def join_reports(done: Iterable[Checked]) -> Report:
    """Join what was checked; a package that was given twice is reported once."""
    packages: dict[tuple[Path, str], PackageReport] = {}
    not_opened: dict[NotOpened, None] = {}
    for result in chain.from_iterable(done):
        if isinstance(result, NotOpened):
            not_opened[result] = None
        else:
            packages.setdefault((Path(result.path).resolve(), result.name), result)
    ordered = sorted(packages.values(), key=lambda it: (*it.lateness, it.path, it.name))
    return Report(tuple(ordered), versions(), tuple(not_opened))
