"""A spawner that cannot be read without running it.

The checker never runs uploaded Ruby. It evaluates a small part of the language: definitions,
conditions, loops, strings, numbers, arrays, hashes and YAML files. The message names code outside
this part; rules that need what the spawner emits are then not checked.

Code that the grammar does not know is a warning, because Ruby probably refuses the file (SPW001
reports it where that is certain). An error that Ruby raises is a warning, too.

Fix: correct misspelt code, and build the XML from the function's parameters only, without other
programs, files or network.
Source: the Ruby evaluator of this checker. None of the accepted packages that we checked goes
beyond it.
"""

from collections.abc import Iterator

from checker.launch.spawner.reader import (
    EXECUTABLES_ARGUMENTS,
    SPAWNER_ARGUMENTS,
    Spawner,
)
from checker.rule import Concern, Findings, Severity, finding, rule

ARGUMENTS = {"spawner": SPAWNER_ARGUMENTS, "rosExecutables": EXECUTABLES_ARGUMENTS}


@rule("SPW002", "spawner-not-readable", Severity.INFO, Concern.INTERFACE)
def check(spawner: Spawner) -> Findings:
    """Report what stopped the evaluation; what Ruby itself refuses or raises are warnings."""
    if spawner.syntax_faults:
        return
    for span in spawner.not_understood:
        message = "the grammar does not know this Ruby, so what the spawner emits is not certain"
        yield finding(span, message, severity=Severity.WARNING)
    if spawner.not_understood:
        return
    for unread in spawner.unread:
        if unread in _not_to_be_called(spawner):
            continue
        raises = unread.reason.startswith("raises ")
        yield finding(
            unread.span,
            f"the spawner {unread.reason}, so what it emits is not known",
            severity=Severity.WARNING if raises else None,
        )


def _not_to_be_called(spawner: Spawner) -> Iterator[object]:
    """Yield the results of functions, except those that SPW003 reports."""
    for name, result in (("spawner", spawner.spawn), ("rosExecutables", spawner.executables)):
        function = spawner.functions.get(name)
        if spawner.lacks(name) or (function and function.required > len(ARGUMENTS[name])):
            yield result


def _spawner(line: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  {line}
  "<spawn name='#{{_name}}'>#{{noise}}</spawn>"
end

def rosExecutables(_name, _worldName)
  ""
end
"""


GOOD = [
    {"launch/spawner.rb": _spawner("noise = [1, 2].join(' ')")},
    {"launch/spawner.rb": _spawner("noise = Math::PI.round(2)")},
]
BAD = [
    {"launch/spawner.rb": _spawner("noise = Net::HTTP.get('a') # ^ SPW002")},
    {"launch/spawner.rb": _spawner("noise = nois + 1 # ^ SPW002")},
    {"launch/spawner.rb": _spawner("noise = 1 if noise = 2 then # ^ SPW002")},
]
