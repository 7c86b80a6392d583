"""The arguments of `subt-check check`, and which of them contradict each other."""

from __future__ import annotations

import argparse

from checker.base.errors import CheckerError
from checker.cli.arguments import (
    above_zero,
    add_distro,
    add_exit_codes,
    add_report_options,
    add_search_options,
    ids,
    positive,
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add what the command takes."""
    add_exit_codes(parser)
    parser.add_argument(
        "paths",
        nargs="+",
        metavar="PATH",
        help="a package folder, an archive (.zip, .tar.gz), a folder of packages, or a model file",
    )
    parser.add_argument(
        "--files",
        action="store_true",
        help="each PATH is a changed file: check the packages of these files",
    )
    add_report_options(parser)
    parser.add_argument(
        "--open", action="store_true", help="with --report: open the HTML report in the browser"
    )
    parser.add_argument("--info", action="store_true", help="text and concise: show infos too")
    parser.add_argument(
        "-q", "--quiet", action="store_true", help="text and concise: print only findings"
    )
    parser.add_argument(
        "--full", action="store_true", help="text: show source lines and reasons too"
    )
    parser.add_argument(
        "--statistics", action="store_true", help="print the number of findings of each rule"
    )
    add_distro(parser)
    parser.add_argument(
        "--select", metavar="IDS", type=ids, help="run only these rules, groups, or concern:robot"
    )
    parser.add_argument(
        "--ignore", metavar="IDS", type=ids, help="do not run these rules or groups"
    )
    add_search_options(parser)
    parser.add_argument(
        "--payload",
        metavar="KG",
        type=above_zero,
        help="mass at the end of an arm: check that its motors hold it in every pose",
    )
    parser.add_argument("--fix", action="store_true", help="apply safe fixes, then check")
    parser.add_argument(
        "--unsafe",
        action="store_true",
        help="with --fix or --diff: also fixes that change behaviour",
    )
    parser.add_argument(
        "--prove",
        action="store_true",
        help="with --fix or --diff: keep a fix only if it brings no error, in the trial neither",
    )
    parser.add_argument(
        "--diff",
        action="store_true",
        help="print the fixes as a patch and do nothing else; exit code 1 if there are any",
    )
    parser.add_argument(
        "--allow-dirty",
        action="store_true",
        help="with --fix: also change files that have uncommitted changes in git",
    )
    parser.add_argument("--baseline", metavar="FILE", help="ignore findings that are in this file")
    parser.add_argument(
        "--write-baseline",
        action="store_true",
        help=(
            "write the current findings to a baseline file and do nothing else (default: the file "
            "in the settings, else subt-check-baseline.json)"
        ),
    )
    parser.add_argument("--no-trial", action="store_true", help="skip the trial")
    parser.add_argument(
        "--thorough",
        action="store_true",
        help="repeat the trial at half the time step, and read URDF with a second library",
    )
    parser.add_argument("--no-cache", action="store_true", help="do not use the cache")
    parser.add_argument(
        "--jobs",
        type=positive,
        metavar="N",
        help="number of processes (default: one per package, up to the number of processors)",
    )


_APART = {
    # A hook writes nothing, whatever files of a commit are named.
    "files": ("fix", "output", "report", "write_baseline"),
    # It writes one file.
    "write_baseline": ("fix", "diff", "output", "report", "statistics"),
    "thorough": ("no_trial",),
    "fix": ("diff",),
    "quiet": ("info", "statistics"),
}
"""Options, and those that do not go with them."""
_NEEDS = {
    "unsafe": ("fix", "diff"),
    "prove": ("fix", "diff"),
    "allow_dirty": ("fix",),
    "open": ("report",),
}
"""Options, and those of which they need one."""


def refuse_contradictions(options: argparse.Namespace) -> None:
    """Refuse options that contradict each other.

    Raises:
        CheckerError: There are such options.
    """
    for option, others in _APART.items():
        for other in others if getattr(options, option) else ():
            if getattr(options, other):
                message = f"{_flag(option)} and {_flag(other)} cannot be used together"
                raise CheckerError(f"{message}; leave out one of them")
    for option, others in _NEEDS.items():
        if getattr(options, option) and not any(getattr(options, other) for other in others):
            raise CheckerError(f"{_flag(option)} needs {' or '.join(map(_flag, others))}")
    if options.write_baseline and options.format != "text":
        raise CheckerError("--write-baseline only writes the baseline; leave out --output-format")


def _flag(option: str) -> str:
    return f"--{option.replace('_', '-')}"
