"""Many one-line cases in one test: a test for each would take longer to report than to run."""

from __future__ import annotations

import functools
import inspect
from collections.abc import Callable, Iterable
from typing import Any

Test = Callable[..., None]


def of_each(
    name: str, values: Iterable[Any], ids: Callable[[Any], str] = str
) -> Callable[[Test], Test]:
    """Run a test with each of some values as an argument, and name those that it fails for.

    Args:
        name: Of the argument.
        values: All of them are tried.
        ids: How a value is called.
    """
    values = list(values)
    assert values

    def of_all(test: Test) -> Test:
        @functools.wraps(test)
        def run(**fixtures: Any) -> None:
            failed = {}
            for value in values:
                try:
                    test(**fixtures, **{name: value})
                except AssertionError as error:
                    failed[ids(value)] = str(error)
            assert not failed, "\n".join(f"{each}: {said}" for each, said in failed.items())

        signature = inspect.signature(test)
        others = [each for each in signature.parameters.values() if each.name != name]
        run.__signature__ = signature.replace(parameters=others)  # type: ignore[attr-defined]
        return run

    return of_all
