"""`subt-check doctor`: one line for each thing, as soon as it is known."""

from __future__ import annotations

import argparse
from itertools import chain

from checker.base.output import EXIT_CLEAN, EXIT_FINDINGS, show
from checker.cli.doctor.installation import (
    INSTALL_AGAIN,
    Result,
    State,
    installation,
    sandbox,
    surroundings,
)


def add_arguments(_parser: argparse.ArgumentParser) -> None:
    """Add nothing: the command takes no arguments."""


def run(_options: argparse.Namespace) -> int:
    """Look at everything, print what is found, and return the exit code."""
    well = True
    for result in chain(installation(), sandbox(), surroundings()):
        show(f"{result}\n")
        well = well and result.state is not State.PROBLEM
    last = (
        _self_test()
        if well
        else Result(State.NOTE, "the self-test is skipped", "correct the above first")
    )
    show(f"{last}\n")
    well = well and last.state is not State.PROBLEM
    show(f"{'everything that is needed works' if well else 'something needed does not work'}\n")
    return EXIT_CLEAN if well else EXIT_FINDINGS


def _self_test() -> Result:
    # It imports the whole checker, which fails where a library does.
    try:
        from checker.cli.doctor.self_test import self_test
    except ImportError as error:
        return Result(State.PROBLEM, f"the self-test cannot start: {error}", INSTALL_AGAIN)
    return self_test()
