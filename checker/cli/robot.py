"""`subt-check robot`: prints the facts of the robots of a package."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from checker.base.cache import NO_CACHE, Cache, cache_folder
from checker.base.errors import CheckerError
from checker.base.output import EXIT_CLEAN, show, write
from checker.base.words import and_list
from checker.cli.arguments import add_distro, add_profile, add_search_options
from checker.engine.robot_facts import package_facts
from checker.engine.subject import Subject
from checker.model.devices.known import known_devices
from checker.package.inputs import open_input, with_package_path
from checker.package.package import Package
from checker.pipeline import Task
from checker.report.robot_facts import PackageFacts, facts_json
from checker.report.robot_mermaid import robots_mermaid
from checker.report.robot_text import robots_text

FORMATS = {"text": robots_text, "json": facts_json, "mermaid": robots_mermaid}
_NAMED = 8
"""Robots that a message names."""


def facts_at(path: Path, wishes: Mapping[str, Any], robot: str = "") -> tuple[PackageFacts, ...]:
    """Return the facts of all packages at a path.

    Args:
        path: A package, a folder of packages, an archive or a model file.
        wishes: Fields of `Settings` that the command line sets; None leaves them.
        robot: Name or file of the only robot that is wanted; empty for all.

    Raises:
        CheckerError: There is no package, or no such robot.
    """
    task = Task(path, wishes=wishes)
    with open_input(path) as opened:
        found = tuple(_facts(package, task) for package in opened.packages)
    return _with_robot(found, robot) if robot else found


def _facts(package: Package, task: Task) -> PackageFacts:
    settings = task.settings_for(package)
    package = with_package_path(package, settings.package_path)
    settings = settings.for_package(package)
    subject = Subject(
        package,
        Cache(cache_folder()) if settings.cache else NO_CACHE,
        devices=known_devices(settings.devices),
        xacro_args=settings.xacro_args,
    )
    try:
        return package_facts(subject, task.display_path_of(package), settings)
    finally:
        subject.close()


def _with_robot(found: tuple[PackageFacts, ...], robot: str) -> tuple[PackageFacts, ...]:
    chosen = tuple(_chosen(found, robot))
    if chosen:
        return chosen
    names = [f"{it.name} ({it.file})" for package in found for it in package.robots]
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    there = f"{and_list(names[:_NAMED])}{more}" if names else "none"
    reasons = [each.reason for package in found for each in package.not_read]
    why = f"; not read: {reasons[0]}" if reasons else ""
    raise CheckerError(f"no robot is called or described by {robot!r}; there is {there}{why}")


def _chosen(found: tuple[PackageFacts, ...], robot: str) -> Iterator[PackageFacts]:
    for package in found:
        robots = tuple(it for it in package.robots if robot in (it.name, it.file))
        if robots:
            yield replace(package, robots=robots)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Print what the files state about the robots of a package: links, joints, masses, "
        "sensors, drive, controllers, topics and frames. Nothing is judged. What could not be "
        "read is printed as `not read`, with the reason."
    )
    parser.add_argument(
        "path",
        metavar="PATH",
        help="a package, a folder of packages, an archive or a model file",
    )
    parser.add_argument(
        "--format",
        choices=tuple(FORMATS),
        default="text",
        help="mermaid: the graph of links and joints (default: text)",
    )
    parser.add_argument("--robot", metavar="NAME", help="only the robot of this name or file")
    parser.add_argument(
        "--output", metavar="FILE", help="write the result to this file instead of stdout"
    )
    add_profile(parser)
    add_distro(parser)
    add_search_options(parser)
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")


def run(options: argparse.Namespace) -> int:
    """Print the facts."""
    wishes = {
        "package_path": tuple(options.package_path) if options.package_path else None,
        "xacro_args": dict(options.xacro_arg) if options.xacro_arg else None,
        "profile": options.profile,
        "distro": options.distro,
        "cache": False if options.no_cache else None,
    }
    text = FORMATS[options.format](facts_at(Path(options.path), wishes, options.robot or ""))
    if options.output:
        write(Path(options.output), text)
    else:
        show(text)
    return EXIT_CLEAN
