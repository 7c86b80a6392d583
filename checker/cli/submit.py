"""`subt-check submit`: has a service check a package."""

from __future__ import annotations

import argparse

from checker.base.output import EXIT_CRASH
from checker.cli.arguments import FORMAT_NAMES, PROFILES, add_exit_codes
from checker.cli.exit_code import exit_code


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_exit_codes(parser)
    parser.add_argument(
        "package", metavar="PACKAGE", help="a package folder, an archive or a model file"
    )
    parser.add_argument(
        "--server",
        metavar="URL",
        required=True,
        help="address of the service, such as https://check.example",
    )
    parser.add_argument(
        "--token",
        default="",
        help="access token (safer: the variable SUBT_CHECK_TOKEN, which other users cannot see)",
    )
    parser.add_argument(
        "--profile", choices=PROFILES, help="set of rules (default: subt, or urdf for URDF)"
    )
    parser.add_argument("--format", choices=FORMAT_NAMES, default="text")
    parser.add_argument(
        "--output", metavar="FILE", help="write the result to this file instead of stdout"
    )
    parser.add_argument(
        "--report",
        metavar="DIR",
        help="also write report.html, report.json, report.sarif and robot.glb into this folder",
    )
    parser.add_argument(
        "--fail-on",
        choices=("error", "warning"),
        help="lowest severity that fails (default: error)",
    )
    parser.add_argument("--color", choices=("auto", "always", "never"), default="auto")


def run(options: argparse.Namespace) -> int:
    """Have a service check a package, and print the report."""
    from checker.service.client.command import submit

    report = submit(options)
    return EXIT_CRASH if report is None else exit_code(report)
