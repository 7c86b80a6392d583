"""A spawner that is not valid Ruby.

The launcher cannot load the file, and the robot cannot be started at all.

Fix: close what the message names.
Source: Ruby's grammar; only errors that cannot be anything else are reported. No accepted package
at hand shows the fault.
"""

from checker.expand.spawner.reader import Spawner
from checker.rule import Findings, Severity, finding, rule


@rule("SPW001", "not-valid-ruby", Severity.ERROR)
def check(spawner: Spawner) -> Findings:
    """Report syntax errors that are certain."""
    for span, message in spawner.syntax_faults:
        yield finding(span, message)


GOOD = [{"launch/spawner.rb": "def spawner(_name)\n  <<-SDF\n<spawn/>\n  SDF\nend\n"}]
BAD = [
    {"launch/spawner.rb": "def spawner(_name)\n  <<-SDF # ^ SPW001\n<spawn/>\nend\n"},
    {"launch/spawner.rb": "def spawner(_name)\n  'x'\nend\nend # ^ SPW001\n"},
]
