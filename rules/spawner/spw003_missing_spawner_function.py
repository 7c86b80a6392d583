"""A spawner without a function or parameter that the launcher uses.

The SubT launcher calls `spawner` with 9 and `rosExecutables` with 2 arguments, by position. The
launch stops if a function is missing or takes fewer; further parameters need defaults.

Fix: define `spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)` and
`rosExecutables(_name, _worldName)`.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from collections.abc import Iterator

from checker.finding import Fix
from checker.launch.spawner.reader import Spawner
from checker.launch.spawner.scope import Function
from checker.rule import Concern, Finding, Findings, Safety, Severity, finding, rule
from checker.source.text import Span

EXPECTED = {
    "spawner": ["_name", "_modelURI", "_worldName", "_x", "_y", "_z", "_roll", "_pitch", "_yaw"],
    "rosExecutables": ["_name", "_worldName"],
}


@rule("SPW003", "missing-spawner-function", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner) -> Findings:
    """Report functions that are missing or cannot be called with the launcher's arguments."""
    for name, expected in EXPECTED.items():
        function = spawner.functions.get(name)
        if function is not None and _is_whole(function, spawner):
            yield from _judge(function, expected)
        elif function is None and spawner.lacks(name):
            yield finding(
                spawner.entry.whole(),
                f"there is no function {name}({', '.join(expected)})",
            )


def _is_whole(function: Function, spawner: Spawner) -> bool:
    """Return whether a function has no syntax error, which could change its parameters."""
    whole = function.span
    faults = (*(span for span, _ in spawner.syntax_faults), *spawner.not_understood)
    return not any(
        span.source is whole.source and whole.start <= span.start < whole.end for span in faults
    )


def _judge(function: Function, expected: list[str]) -> Iterator[Finding]:
    takes, passed = function.most, len(expected)
    call = f"the launcher calls {function.name!r} with {passed} arguments"
    if takes is not None and takes < passed:
        missing = ", ".join(expected[takes:])
        yield finding(
            function,
            f"{call}, but it takes {takes}: {missing} is missing",
            fix=_completed(function, expected),
        )
    elif function.required > passed:
        yield finding(
            function, f"{call}, but it requires {function.required}: the last ones need defaults"
        )


def _completed(function: Function, expected: list[str]) -> Fix | None:
    """Return the fix that appends parameters, where those that are there have the usual names."""
    names, span = [parameter.name for parameter in function.parameters], function.span
    if not names or names != expected[: len(names)] or len(names) != function.required:
        return None
    end = span.end - span.text.endswith(")")
    more = "".join(f", {name}" for name in expected[len(names) :])
    return Fix(Safety.UNSAFE, (Span(span.source, end, end).replacement(more),))


_TEXTS = "  ''\nend\n"
_SPAWNER = "def spawner(_name, _uri, _world, _x, _y, _z, _roll, _pitch, _yaw"
_ROS = "def rosExecutables(_name, _worldName"

GOOD = [
    {"launch/spawner.rb": f"{_SPAWNER})\n{_TEXTS}{_ROS})\n{_TEXTS}"},
    {"launch/spawner.rb": f"{_SPAWNER}, _more = 1)\n{_TEXTS}{_ROS}, *_rest)\n{_TEXTS}"},
    {"launch/spawner.rb": f"{_SPAWNER})\n{_TEXTS}{_ROS.replace(',', '')})\n{_TEXTS}"},
]
BAD = [
    {"launch/spawner.rb": f"# ^ SPW003\n{_SPAWNER})\n{_TEXTS}"},
    {
        "launch/spawner.rb": f"{_SPAWNER}, _more) # ^ SPW003\n{_TEXTS}"
        f"def rosExecutables(_name) # ^ SPW003\n{_TEXTS}"
    },
]
