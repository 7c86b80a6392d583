"""The command `subt-check`. Every command is named in this file; each loads what it needs."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from io import TextIOWrapper

from checker.base.output import EXIT_CLEAN, EXIT_CRASH, EXIT_USAGE

COMMANDS = (
    *("check", "rule", "rules", "export", "migrate", "init", "doctor"),
    *("serve", "worker", "submit"),
)
PROFILES = ("subt", "sdf", "urdf", "gazebo-harmonic")
FORMATS = ("text", "json", "sarif", "github", "junit", "markdown", "html")

_EXITS = """exit codes:
  0  nothing at or above --fail-on
  1  findings at or above --fail-on
  2  wrong usage, or input that cannot be read
  3  a rule could not run because of the checker itself
"""


def build_parser() -> argparse.ArgumentParser:
    """Return the parser of all commands."""
    parser = argparse.ArgumentParser(
        prog="subt-check",
        description="Check robot model packages for simulation. "
        "`subt-check PATH` is short for `subt-check check PATH`.",
        epilog=_EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")
    _add_check(commands)
    _add_export(commands)
    _add_migrate(commands)
    _add_submit(commands)
    _add_serve(commands)
    _add_worker(commands)
    start = commands.add_parser("init", help="write a settings file, and a hook for pre-commit")
    folder = "of the packages (default: this one)"
    start.add_argument("path", metavar="FOLDER", nargs="?", default=".", help=folder)
    commands.add_parser("doctor", help="look whether all works here; exit code 1 if not")
    one = commands.add_parser("rule", help="explain a rule")
    one.add_argument("id", help="such as SEN005 or lidar-scan-resolution")
    every = commands.add_parser("rules", help="list all rules")
    every.add_argument("--format", choices=("text", "json"), default="text")
    return parser


def _add_check(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    check = commands.add_parser(
        "check",
        help="check packages",
        epilog=_EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    check.add_argument(
        "paths",
        nargs="+",
        metavar="PATH",
        help="a package folder, an archive (.zip, .tar.gz), a folder of packages, or a model file",
    )
    check.add_argument(
        "--files",
        action="store_true",
        help="each PATH is a changed file: check the packages that they belong to",
    )
    check.add_argument("--format", choices=FORMATS, default="text")
    check.add_argument("--output", metavar="FILE", help="write the result there, not to stdout")
    check.add_argument(
        "--report",
        metavar="DIR",
        help="also write report.html, report.json, report.sarif and robot.glb into this folder",
    )
    check.add_argument("--statistics", action="store_true", help="count the findings by rule")
    check.add_argument("--profile", choices=PROFILES, help="default: subt, or urdf for URDF")
    check.add_argument("--select", metavar="IDS", type=_ids, help="only these rules or groups")
    check.add_argument("--ignore", metavar="IDS", type=_ids, help="leave out rules or groups")
    check.add_argument("--fail-on", choices=("error", "warning"), help="(default: error)")
    check.add_argument("--fix", action="store_true", help="apply the safe fixes, then check")
    check.add_argument(
        "--unsafe",
        action="store_true",
        help="with --fix or --diff: also those that change behaviour",
    )
    check.add_argument("--diff", action="store_true", help="print the fixes as a patch, no more")
    check.add_argument(
        "--baseline", metavar="FILE", help="findings that are in this file do not count"
    )
    check.add_argument(
        "--write-baseline",
        action="store_true",
        help="write the findings of now there, no more (default: into the one that the settings "
        "name, else subt-check-baseline.json)",
    )
    check.add_argument("--no-trial", action="store_true", help="do not drive the robot")
    check.add_argument(
        "--thorough", action="store_true", help="drive it again at half the time step"
    )
    check.add_argument("--no-cache", action="store_true", help="keep no results, take none")
    check.add_argument("--jobs", type=_positive, default=1, metavar="N", help="processes")
    check.add_argument("--color", choices=("auto", "always", "never"), default="auto")


def _add_export(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    export = commands.add_parser("export", help="write a package's robot as URDF or MJCF")
    export.add_argument("path", metavar="PATH", help="a package, an archive or a model file")
    export.add_argument(
        "--format",
        choices=("urdf", "mjcf"),
        required=True,
        help="urdf: for RViz, with package:// meshes; mjcf: the scene of the trial, for MuJoCo",
    )
    export.add_argument(
        "--output",
        metavar="FILE",
        help="write it there; into a folder, an MJCF goes with its meshes beside it",
    )
    export.add_argument("--no-cache", action="store_true", help="keep no results, take none")


def _add_migrate(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    migrate = commands.add_parser(
        "migrate",
        help="make a package for SubT of a description for Gazebo 9",
        epilog=_EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    migrate.add_argument("source", metavar="SOURCE", help="a description package, or a URDF file")
    migrate.add_argument("destination", metavar="DEST", help="an empty folder, or a new one")
    migrate.add_argument("--organization", metavar="NAME", default="", help="who submits it")
    migrate.add_argument("--robot", metavar="NAME", default="", help="(default: the URDF's name)")
    migrate.add_argument("--config", type=int, default=1, metavar="N", help="number (default: 1)")
    for side in ("left", "right"):
        migrate.add_argument(
            f"--{side}-wheels",
            metavar="JOINTS",
            type=_ids,
            default=(),
            help=f"joints that drive on the {side}, with commas between (default: guessed)",
        )
    for limit, unit in (("velocity", "m/s"), ("acceleration", "m/s²")):
        migrate.add_argument(
            f"--max-{limit}",
            metavar="NUMBER",
            type=_above_zero,
            help=f"of the drive, {unit} (default: as the joints and SubT allow)",
        )
    migrate.add_argument("--urdf", metavar="FILE", default="", help="which file is the robot")
    migrate.add_argument(
        "--args", metavar="NAME:=VALUE", nargs="+", type=_argument, default=[], help="for xacro"
    )
    migrate.add_argument("--no-trial", action="store_true", help="do not drive the robot")
    migrate.add_argument("--no-cache", action="store_true", help="keep no results, take none")


def _add_submit(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    submit = commands.add_parser(
        "submit",
        help="have a service check a package",
        epilog=_EXITS,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    submit.add_argument(
        "package", metavar="PACKAGE", help="a package folder, an archive or a model file"
    )
    submit.add_argument(
        "--server", metavar="URL", required=True, help="of the service: https://check.example"
    )
    submit.add_argument(
        "--token", default="", help="that it wants (better: SUBT_CHECK_TOKEN, which none sees)"
    )
    submit.add_argument("--profile", choices=PROFILES, help="default: subt, or urdf for URDF")
    submit.add_argument("--format", choices=FORMATS, default="text")
    submit.add_argument("--output", metavar="FILE", help="write the result there, not to stdout")
    submit.add_argument(
        "--report",
        metavar="DIR",
        help="also write report.html, report.json, report.sarif and robot.glb into this folder",
    )
    submit.add_argument("--fail-on", choices=("error", "warning"), help="(default: error)")
    submit.add_argument("--color", choices=("auto", "always", "never"), default="auto")


def _add_serve(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    serve = commands.add_parser(
        "serve",
        help="start the web service with its workers",
        description="Start the web service with its workers. On another address than this "
        "machine's own it wants SUBT_CHECK_TOKENS, separated by commas, or --public; with either, "
        "layers around what others upload, of which `subt-check doctor` tells.",
    )
    serve.add_argument("--host", default="127.0.0.1", help="address (default: 127.0.0.1)")
    serve.add_argument(
        "--port", type=_port, default=8000, help="(default: 8000; 0 for any that is free)"
    )
    serve.add_argument(
        "--workers", type=_count, metavar="N", help="processes; 0: elsewhere (default: 2 or fewer)"
    )
    serve.add_argument("--public", action="store_true", help="let everybody upload")
    serve.add_argument(
        "--without-sandbox",
        action="store_true",
        help="take uploads of others where no layer hides files: a package that takes over its "
        "reader then reads all that this user can",
    )
    _add_data(serve)
    serve.add_argument(
        "--base-url", metavar="URL", default="", help="where people reach it, if not at its address"
    )
    serve.add_argument(
        "--behind-proxy",
        metavar="ADDRESSES",
        type=_networks,
        nargs="?",
        const="127.0.0.1,::1",
        default="",
        help="believe what the proxy at these addresses or networks, with commas between, says of "
        "its clients (default: one on this machine)",
    )


def _add_worker(commands: argparse._SubParsersAction[argparse.ArgumentParser]) -> None:
    worker = commands.add_parser("worker", help="start a further worker of a service")
    worker.add_argument(
        "--jobs", type=_positive, metavar="N", help="trials at once in each worker (at first: 1)"
    )
    worker.add_argument(
        "--name",
        default="",
        help="under which no other worker runs; started again under it, this one takes up at once "
        "what it had in hand (default: at random)",
    )
    _add_data(worker)


def _add_data(command: argparse.ArgumentParser) -> None:
    command.add_argument(
        "--data",
        metavar="DIR",
        default="",
        help="for uploads and reports (default: SUBT_CHECK_DATA, else the user's data folder)",
    )


def _argument(text: str) -> tuple[str, str]:
    name, assigned, value = text.partition(":=")
    if not name or not assigned:
        raise argparse.ArgumentTypeError(f"{text!r} is no argument, expected name:=value")
    return name, value


def _above_zero(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text!r} is no limit, expected a number above 0")
    return value


def _ids(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())


def _positive(text: str) -> int:
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of processes, expected 1 or more")
    return int(text)


def _count(text: str) -> int:
    if not text.isdecimal():
        raise argparse.ArgumentTypeError(f"{text!r} is no number of processes, expected 0 or more")
    return int(text)


def _networks(text: str) -> str:
    """Return addresses and networks as they are: one that is misspelt would never be met."""
    import ipaddress

    for each in text.split(",") if text else ():
        try:
            ipaddress.ip_network(each.strip())
        except ValueError:
            raise argparse.ArgumentTypeError(
                f"{each!r} is no address or network, expected such as 127.0.0.1 or 172.30.77.0/24"
            ) from None
    return text


def _port(text: str) -> int:
    if not (text.isascii() and text.isdecimal()) or int(text) > 65535:
        raise argparse.ArgumentTypeError(f"{text!r} is no port, expected a number up to 65535")
    return int(text)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command and return its exit code; no traceback ever reaches the user."""
    words = list(sys.argv[1:] if arguments is None else arguments)
    if words and words[0] not in (*COMMANDS, "-h", "--help", "--version"):
        words.insert(0, "check")
    _end_in_good_order()
    parser = build_parser()
    options = parser.parse_args(words)
    options.words = list(sys.argv[1:] if arguments is None else arguments)
    if options.version:
        from checker.base.resources import tool_version

        print(f"subt-check {tool_version()}")
        return EXIT_CLEAN
    if options.command is None:
        parser.print_help()
        return EXIT_USAGE
    return _guarded(options)


def _end_in_good_order() -> None:
    """Let a request to terminate unwind, so that children and temporary folders go as well."""
    import atexit
    import gc
    import signal

    # What is left then goes with the process: to look through it takes a tenth of a short check.
    atexit.register(gc.freeze)
    with suppress(ValueError):  # not the main thread: whoever runs it handles signals
        signal.signal(signal.SIGTERM, lambda number, _: sys.exit(128 + number))


def _guarded(options: argparse.Namespace) -> int:
    from checker.base.errors import CheckerError
    from checker.base.words import plain, shortened

    # A terminal without some character shows a question mark; it is no reason to fail.
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="replace")
    try:
        return _run(options)
    except CheckerError as error:
        print(f"subt-check: {plain(shortened(str(error), 900))}", file=sys.stderr)
        return EXIT_USAGE
    except KeyboardInterrupt:
        print("subt-check: interrupted", file=sys.stderr)
        return EXIT_USAGE
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


def _run(options: argparse.Namespace) -> int:
    if options.command == "doctor":
        # It works where a library is missing that the other commands import.
        from checker.cli.doctor.command import doctor

        return doctor()
    if options.command in ("serve", "worker"):
        # They wait; the checker's own readers would only take memory from those who work.
        from checker.service.processes.command import serve, worker

        return serve(options) if options.command == "serve" else worker(options)
    from checker.cli import commands

    actions: dict[str, Callable[[], int]] = {
        "check": lambda: commands.check(options),
        "export": lambda: commands.export(options),
        "migrate": lambda: commands.migrate(options),
        "submit": lambda: commands.submit(options),
        "init": lambda: commands.init(options),
        "rule": lambda: commands.explain_rule(options.id),
        "rules": lambda: commands.list_rules(options.format),
    }
    return actions[options.command]()
