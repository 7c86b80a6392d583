"""`subt-check admin`: what operators do on the machine of the service's database."""

from __future__ import annotations

import argparse

from checker.base.extras import SERVICE
from checker.cli.arguments import add_data

_KEY = (
    "key of a check, or its beginning, as `subt-check admin list` shows it, or the id in the "
    "check's address"
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Manage the checks and workers of a service. Run it as the user of the service, with "
        "its SUBT_CHECK_DATA, SUBT_CHECK_DATABASE_URL and SUBT_CHECK_STORE."
    )
    actions = parser.add_subparsers(dest="action", metavar="ACTION", required=True)
    listing = _action(actions, "list", "list waiting, running and failed checks")
    listing.add_argument("--json", action="store_true", help="as JSON, with whole keys")
    again = _action(actions, "requeue", "run failed checks again, under the same links")
    which = again.add_mutually_exclusive_group(required=True)
    which.add_argument("keys", nargs="*", default=[], metavar="KEY", help=_KEY)
    which.add_argument("--failed", action="store_true", help="all checks that have failed")
    cancel = _action(actions, "cancel", "cancel waiting or running checks; their pages remain")
    cancel.add_argument("keys", nargs="+", metavar="KEY", help=_KEY)
    drain = _action(actions, "drain", "let workers finish their current checks, then stop")
    drain.add_argument(
        "names", nargs="*", metavar="NAME", help="name of a worker (default: all workers)"
    )
    _action(actions, "retention", "delete expired data now, and print how much was deleted")


def _action(
    actions: argparse._SubParsersAction[argparse.ArgumentParser], name: str, summary: str
) -> argparse.ArgumentParser:
    parser = actions.add_parser(name, help=summary, description=f"{summary.capitalize()}.")
    add_data(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    SERVICE.require_for("admin")
    from checker.service.processes.admin import admin

    return admin(options)
