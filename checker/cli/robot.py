"""`subt-check robot`: prints the facts of the robots of a package."""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from checker.base.errors import CheckerError
from checker.base.output import EXIT_CLEAN, show, write
from checker.base.words import and_list
from checker.cli.arguments import add_distro, add_profile, add_search_options, search_wishes
from checker.cli.subjects import subject_of
from checker.engine.robot_facts import package_facts
from checker.package.inputs import open_input
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
    with subject_of(package, task) as (subject, settings):
        return package_facts(subject, task.display_path_of(package), settings)


def _with_robot(found: tuple[PackageFacts, ...], robot: str) -> tuple[PackageFacts, ...]:
    chosen = tuple(_chosen(found, robot))
    if chosen:
        return chosen
    there = named_robots([(it.name, it.file) for package in found for it in package.robots])
    reasons = [each.reason for package in found for each in package.not_read]
    why = f"; not read: {reasons[0]}" if reasons else ""
    raise CheckerError(f"no robot is called or described by {robot!r}; there is {there}{why}")


def named_robots(robots: Sequence[tuple[str, str]]) -> str:
    """Return the names and files of robots as a list in words."""
    names = [f"{name} ({file})" for name, file in robots]
    more = f" and {len(names) - _NAMED} more" if len(names) > _NAMED else ""
    return f"{and_list(names[:_NAMED])}{more}" if names else "none"


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
        **search_wishes(options),
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
