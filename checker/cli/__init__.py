"""The command `subt-check`: one module per command, which names its arguments and runs."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Collection, Sequence
from contextlib import suppress
from importlib import import_module
from io import TextIOWrapper
from pathlib import Path
from types import ModuleType

from checker.base.output import EXIT_CLEAN, EXIT_CRASH, EXIT_INTERRUPTED, EXIT_USAGE
from checker.base.words import Suggestions
from checker.cli.arguments import EXITS
from checker.cli.parser import Parser

COMMANDS = {
    "check": "check packages",
    "robot": "print links, joints, sensors, drive and topics of a package's robots",
    "export": "write a package's robot as URDF or MJCF",
    "migrate": "convert a description for Gazebo 9 to a package for SubT",
    "submit": "check a package remotely, print locally",
    "server": "start the language server for editors",
    "mcp": "start the server for assistants (Model Context Protocol)",
    "serve": "start the web service with its worker processes",
    "worker": "start another worker process of a service",
    "admin": "list, rerun and cancel checks of a service, drain workers, delete expired data",
    "init": "write a settings file and a pre-commit hook",
    "doctor": "check the installation; exit code 1 if something does not work",
    "rule": "explain a rule",
    "rules": "list all rules",
    "completion": "print the completion script for bash, zsh or fish",
}
"""Help text of each command; its module has the same name."""
_MODULES = {name: f"{name}.command" for name in ("check", "doctor", "mcp")}
_PRODUCTS = {
    "migrate": "migrate",
    "server": "editor",
    **dict.fromkeys(("submit", "serve", "worker", "admin"), "service"),
}
"""The package of the checker that a command starts; without it, there is no such command."""


def installed_commands() -> dict[str, str]:
    """Return the commands whose packages are there, and what each does."""
    root = Path(__file__).parents[1]
    return {
        name: summary
        for name, summary in COMMANDS.items()
        if name not in _PRODUCTS or (root / _PRODUCTS[name]).is_dir()
    }


def build_parser(wanted: Collection[str] = tuple(COMMANDS)) -> Parser:
    """Return the parser.

    Args:
        wanted: The commands of which arguments are known; the modules of others are not loaded.
    """
    parser = Parser(
        prog="subt-check",
        description="Check robot model packages for simulation. "
        "`subt-check PATH` is short for `subt-check check PATH`.",
        epilog=EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    for name, summary in installed_commands().items():
        command = commands.add_parser(name, help=summary)
        if name in wanted:
            _module(name).add_arguments(command)
    return parser


def _module(command: str) -> ModuleType:
    """Load what a command needs, and no more: a doctor works where a library is missing."""
    return import_module(f"{__name__}.{_MODULES.get(command, command)}")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code; no traceback ever reaches the user."""
    try:
        return _run(arguments)
    except KeyboardInterrupt:
        print("subt-check: interrupted", file=sys.stderr)
        return EXIT_INTERRUPTED


def _run(arguments: Sequence[str] | None) -> int:
    given = list(sys.argv[1:] if arguments is None else arguments)
    words = [*given]
    if words and words[0] not in (*installed_commands(), "-h", "--help", "--version"):
        words.insert(0, "check")
    _end_in_good_order()
    parser = build_parser(words[:1])
    if words[:1] == ["check"] != given[:1]:
        _refuse_misspelt_command(parser, given[0])
    options = parser.parse_args(words)
    options.words = given
    if options.version:
        from checker.base.resources import tool_version

        print(f"subt-check {tool_version()}")
        return EXIT_CLEAN
    if options.command is None:
        parser.print_help()
        return EXIT_USAGE
    return _guarded(options)


def _refuse_misspelt_command(parser: Parser, word: str) -> None:
    near = Suggestions(installed_commands()).closest(word)
    if near is not None and not Path(word).exists():
        parser.error(f"{word!r} is neither a command nor a path; did you mean {near!r}?")


def _end_in_good_order() -> None:
    """Let a request to terminate unwind, so that children and temporary folders go too."""
    import atexit
    import gc
    import signal

    # What is left then goes with the process: to look through it takes a tenth of a short check.
    atexit.register(gc.freeze)
    with suppress(ValueError):  # not the main thread: its caller handles signals
        signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))


def _guarded(options: argparse.Namespace) -> int:
    from checker.base.errors import CheckerError, Unreachable
    from checker.base.words import plain, shortened

    # A terminal without some character shows a question mark; it is no reason to fail.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        return int(_module(options.command).run(options))
    except CheckerError as error:
        print(f"subt-check: {plain(shortened(str(error), 900))}", file=sys.stderr)
        return EXIT_CRASH if isinstance(error, Unreachable) else EXIT_USAGE
    except Exception as error:
        if os.environ.get("SUBT_CHECK_DEBUG"):
            raise
        problem = plain(shortened(f"{type(error).__name__}: {error}", 300))
        print(
            f"subt-check: internal error ({problem}); please report it "
            "with the output of the same command under SUBT_CHECK_DEBUG=1",
            file=sys.stderr,
        )
        return EXIT_CRASH
