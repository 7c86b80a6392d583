"""`subt-check doctor`: one line for each thing, as soon as it is known."""

from __future__ import annotations

from collections.abc import Iterator

from checker.doctor.installation import installation
from checker.doctor.result import Result, State
from checker.doctor.surroundings import surroundings
from checker.output import EXIT_CLEAN, EXIT_FINDINGS, show


def doctor() -> int:
    """Look at everything, print what is found, and return the exit code."""
    well = True
    for result in _results():
        show(f"{result}\n")
        well = well and result.state is not State.PROBLEM
    show(f"{'everything that is needed works' if well else 'something needed does not work'}\n")
    return EXIT_CLEAN if well else EXIT_FINDINGS


def _results() -> Iterator[Result]:
    yield from installation()
    yield from surroundings()
    # It imports the whole checker, which fails where a library does.
    try:
        from checker.doctor.self_test import self_test
    except ImportError as error:
        advice = "install subt-check again, with its libraries"
        yield Result(State.PROBLEM, f"self-test cannot begin: {error}", advice)
    else:
        yield self_test()
