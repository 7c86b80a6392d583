"""Fixes the packages that the user names: on disk, or only as a patch."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from checker.cache import NO_CACHE, Cache, cache_folder
from checker.check import Task
from checker.errors import UnreadableInput
from checker.finding import Safety
from checker.fixing.writing import write_files
from checker.judging import findings_of
from checker.package.opening import open_input
from checker.patching.rounds import Fixed, Judge, fix_package
from checker.record import record
from checker.settings import Settings

_ARCHIVES_STAY = "unpack it first; --diff shows what would change"


@record()
class FixedPackage:
    """A package and what fixing it comes to; `shown` is its path as the user would write it."""

    name: str
    shown: str
    fixed: Fixed


def fix_paths(
    paths: Sequence[Path],
    wishes: Mapping[str, Any],
    allowed: Collection[Safety],
    *,
    write: bool,
) -> list[FixedPackage]:
    """Fix every package at the paths, one after the other.

    Args:
        paths: What to fix.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        allowed: Fixes that may be made.
        write: Whether files are changed; else it is only found out what would change.

    Raises:
        UnreadableInput: There is nothing to fix at a path, or it is an archive; then nothing was
            written at any.
        NotWritten: A file cannot be written.
        InvalidSettings: The settings name what does not exist.
    """
    for path in paths if write else ():
        _refuse_archives(path)
    return [
        each for path in paths for each in _fix_input(Task(path, wishes=wishes), allowed, write)
    ]


def _refuse_archives(path: Path) -> None:
    """Raise for what cannot be fixed, before anything is."""
    with open_input(path) as opened:
        if path.is_file() and any(not package.only for package in opened.packages):
            raise UnreadableInput(path, "is an archive; archives are not changed", _ARCHIVES_STAY)


def _fix_input(task: Task, allowed: Collection[Safety], write: bool) -> Iterator[FixedPackage]:
    with open_input(task.path) as opened:
        for package in opened.packages:
            fixed = fix_package(package, _judge(task.settings_for(package)), allowed)
            if write:
                write_files(package, fixed.files)
            yield FixedPackage(package.name, task.shown(package), fixed)


def _judge(settings: Settings) -> Judge:
    """Return how a package is checked between rounds: without a trial, which mends nothing."""
    still = settings.overridden(trial=False, thorough=False)
    cache = Cache(cache_folder()) if settings.cache else NO_CACHE
    return lambda package: findings_of(package, still, cache)
