"""From paths to a report: the whole pipeline on one screen."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from concurrent.futures import ProcessPoolExecutor
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

from checker.discovery import all_rules
from checker.engine import run_rules
from checker.facts import facts_of
from checker.finding import Severity
from checker.package.opening import open_input
from checker.package.package import Package
from checker.profiles import profile
from checker.report.report import Cause, InheritedPart, NotChecked, PackageReport, Report
from checker.settings import Settings, check_against_rules, find_settings
from checker.subject import Subject
from checker.versions import versions


def check_package(path: Path, settings: Settings | None = None) -> Report:
    """Check a package, an archive, a folder of packages or a model file.

    Args:
        path: What to check.
        settings: What to judge; those found beside the package when None.

    Raises:
        UnreadableInput: There is nothing to check at the path.
        InvalidSettings: The settings name what does not exist.
    """
    return _report([_check_input(path, settings, {})], settings or Settings())


def check_paths(
    paths: Sequence[Path], wishes: Mapping[str, Any], jobs: int = 1
) -> tuple[Report, Severity]:
    """Check several inputs, in parallel processes when `jobs` is above 1.

    Args:
        paths: What to check.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        jobs: Processes.

    Returns:
        The report, and the severity that makes the run fail.

    Raises:
        UnreadableInput: There is nothing to check at one of the paths.
        InvalidSettings: The settings name what does not exist.
    """
    settings = find_settings(Path.cwd()).overridden(**wishes)
    inputs = [path for given in paths for path in _spread(given, jobs)]
    check = partial(_check_input, settings=None, wishes=wishes)
    if jobs > 1 and len(inputs) > 1:
        with ProcessPoolExecutor(jobs) as pool:
            done = list(pool.map(check, inputs))
    else:
        done = [check(path) for path in inputs]
    return _report(done, settings), settings.fail_on


def _spread(path: Path, jobs: int) -> list[Path]:
    """Return the packages below a folder one by one, so that processes can share them."""
    if jobs == 1 or not path.is_dir():
        return [path]
    with open_input(path) as opened:
        return [package.root for package in opened.packages]


def _report(done: Sequence[Sequence[PackageReport]], settings: Settings) -> Report:
    packages = {each.path: each for reports in done for each in reports}
    ordered = sorted(packages.values(), key=lambda each: (each.name, each.path))
    return Report(tuple(ordered), settings.profile, versions())


def _check_input(
    path: Path, settings: Settings | None, wishes: Mapping[str, Any]
) -> list[PackageReport]:
    started = perf_counter()
    with open_input(path) as opened:
        opening = perf_counter() - started
        alone = len(opened.packages) == 1
        return [
            _check_one(package, _shown(path, package, alone), settings, wishes, opening)
            for package in opened.packages
        ]


def _shown(path: Path, package: Package, alone: bool) -> str:
    """Return the package's path as the user would write it."""
    if package.only:
        return str(path.parent)
    if path.is_dir() and path.resolve() == package.root:
        return str(path)
    return f"{path}/{package.name}" if not alone or path.is_dir() else package.name


def _check_one(
    package: Package,
    shown: str,
    settings: Settings | None,
    wishes: Mapping[str, Any],
    opening: float,
) -> PackageReport:
    chosen = settings or find_settings(package.root).overridden(**wishes)
    rules = all_rules()
    check_against_rules(chosen, rules)
    subject = Subject(package)
    started = perf_counter()
    outcome = run_rules(rules, subject, profile(chosen.profile), chosen)
    blind = [
        NotChecked("PKG003", f"{fault.path} {fault.reason}", Cause.NOT_AT_HAND)
        for fault in package.index.faults
    ]
    return PackageReport(
        package.name,
        shown,
        package.kind.replace(" ", "_").lower(),
        outcome.findings,
        (*outcome.not_checked, *blind),
        tuple(
            InheritedPart(each.part, each.package_name, each.at_hand) for each in package.inherited
        ),
        facts_of(subject),
        {"open": opening, "rules": perf_counter() - started},
    )
