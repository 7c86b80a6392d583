"""A spawner that is not valid Ruby.

The SubT launcher cannot load the file, so it cannot start the robot.

Fix: correct the code that the message names.
Source: Ruby's grammar; only errors that cannot be anything else are reported. None of the accepted
packages that we checked shows this.
"""

from checker.expand.spawner.reader import Spawner
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("SPW001", "not-valid-ruby", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner) -> Findings:
    """Report syntax errors that are certain."""
    for span, message in spawner.syntax_faults:
        yield finding(span, message)


GOOD = [{"launch/spawner.rb": "def spawner(_name)\n  <<-SDF\n<spawn/>\n  SDF\nend\n"}]
BAD = [
    {"launch/spawner.rb": "def spawner(_name)\n  <<-SDF # ^ SPW001\n<spawn/>\nend\n"},
    {"launch/spawner.rb": "def spawner(_name)\n  'x'\nend\nend # ^ SPW001\n"},
]
