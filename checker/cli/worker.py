"""`subt-check worker`: starts a further worker of a service."""

from __future__ import annotations

import argparse

from checker.base.extras import PHYSICS, SERVICE
from checker.cli.arguments import add_data, positive


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.add_argument(
        "--jobs",
        type=positive,
        metavar="N",
        help=(
            "number of trials at the same time, plus one of another sender "
            "(default: 1); the processes of `serve` run 1 each"
        ),
    )
    parser.add_argument(
        "--name",
        default="",
        help=(
            "unique name of the worker process; after a restart with the same name it resumes its "
            "checks at once (default: random)"
        ),
    )
    add_data(parser)


def run(options: argparse.Namespace) -> int:
    """Work until SIGTERM or SIGINT."""
    for extra in (SERVICE, PHYSICS):
        extra.require_for("worker")
    from checker.service.processes.command import worker

    return worker(options)
