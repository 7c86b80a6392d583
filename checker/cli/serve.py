"""`subt-check serve`: starts the web service with its workers."""

from __future__ import annotations

import argparse

from checker.base.extras import PHYSICS, SERVICE
from checker.cli.arguments import add_data, count, networks, port


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    parser.description = (
        "Start the web service with its worker processes. On an address that other machines "
        "can reach, it needs SUBT_CHECK_TOKENS (separated by commas) or --public. It then also "
        "needs sandbox layers for uploads; `subt-check doctor` lists them."
    )
    parser.add_argument("--host", default="127.0.0.1", help="address (default: 127.0.0.1)")
    parser.add_argument(
        "--port", type=port, default=8000, help="port (default: 8000; 0: any free port)"
    )
    parser.add_argument(
        "--workers",
        type=count,
        metavar="N",
        help="number of worker processes; 0: none, they run elsewhere (default: 2 or fewer)",
    )
    parser.add_argument("--public", action="store_true", help="allow everybody to upload")
    parser.add_argument(
        "--without-sandbox",
        action="store_true",
        help=(
            "accept uploads although no sandbox layer hides files: a package that takes control of "
            "its reader can then read all files of this user"
        ),
    )
    add_data(parser)
    parser.add_argument(
        "--base-url",
        metavar="URL",
        default="",
        help="public address of the service, if it differs from its own",
    )
    parser.add_argument(
        "--behind-proxy",
        metavar="ADDRESSES",
        type=networks,
        nargs="?",
        const="127.0.0.1,::1",
        default="",
        help=(
            "trust the client addresses that proxies at these addresses or networks report; "
            "separated by commas (default: a proxy on this machine)"
        ),
    )


def run(options: argparse.Namespace) -> int:
    """Serve until SIGTERM or SIGINT."""
    for extra in (SERVICE, PHYSICS):
        extra.require_for("serve")
    from checker.service.processes.command import serve

    return serve(options)
