"""A spawner that is not valid Ruby.

The SubT launcher cannot load the file, so it cannot start the robot.

Only certain errors are reported: code that Ruby never accepts, such as a heredoc whose end is
followed by blanks, and a missing `end`, quote, bracket or comma that would make the whole file
valid. SPW002 reports likely errors as warnings.

Fix: correct the code that the message names; run `ruby -c launch/spawner.rb` to find further
errors.
Source: Ruby's grammar. No accepted package that we checked has this fault.
"""

from checker.launch.spawner.reader import Spawner
from checker.rule import Concern, Findings, Severity, finding, rule


@rule("SPW001", "not-valid-ruby", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner) -> Findings:
    """Report syntax errors that are certain."""
    for span, message in spawner.syntax_faults:
        yield finding(span, message)


_SPAWNER = "def spawner(_name)\n  <<-SDF\n<spawn/>\n  SDF\nend\n"
_NODES = """
def rosExecutables(_name, _worldName)
  nodes = ['a', 'b']
  nodes.map do |node|
    "<executable name='#{node}'/>\\n"
  end.join
end
"""
_MARK = " # ^ SPW001"

GOOD = [{"launch/spawner.rb": _SPAWNER}, {"launch/spawner.rb": _SPAWNER + _NODES}]
BAD = [
    {"launch/spawner.rb": f"def spawner(_name)\n  <<-SDF{_MARK}\n<spawn/>\nend\n"},
    {"launch/spawner.rb": f"def spawner(_name)\n  <<-SDF{_MARK}\n<spawn/>\n  SDF \nend\n"},
    {"launch/spawner.rb": f"def spawner(_name)\n  'x'\nend\nend{_MARK}\n"},
    {"launch/spawner.rb": f"def spawner(_name){_MARK}\n  'x'\n{_NODES}"},
    {"launch/spawner.rb": _SPAWNER + _NODES.replace("'b']", f"'b]{_MARK}")},
    {"launch/spawner.rb": _SPAWNER + _NODES.replace("'b']", f"'b'{_MARK}")},
    {"launch/spawner.rb": _SPAWNER + _NODES.replace("_name, _worldName)", f"_name _world){_MARK}")},
]
