"""A roslaunch command without the robot's name or the world's.

The launch file then uses its default: the topics of another robot, or none. The topics of all
sensors contain the world's name.

Fix: append `world_name:=#{_worldName} name:=#{_name}` to the command.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from collections.abc import Sequence
from itertools import zip_longest

from checker.finding import Fix
from checker.launch.ros1.launch_file import LaunchCommand
from checker.launch.spawner.emitted_xml import StartedXml
from checker.launch.spawner.reader import EXECUTABLES_ARGUMENTS, Spawner
from checker.rule import Concern, Findings, Safety, Severity, finding, rule
from checker.source.text import Span

ARGUMENTS = (
    ("name", "_name", Severity.ERROR),
    ("world_name", "_worldName", Severity.WARNING),
)
"""Arguments of launch files and the parameters of `rosExecutables` that belong to them."""


@rule("SPW013", "roslaunch-without-name", Severity.ERROR, Concern.INTERFACE)
def check(spawner: Spawner, started: StartedXml) -> Findings:
    """Report commands whose `name:=` or `world_name:=` is missing or a constant."""
    function = spawner.functions.get("rosExecutables")
    parameters = [parameter.name for parameter in function.parameters] if function else []
    for element in started.commands:
        command = LaunchCommand.parse(element.text.value)
        if command is None:
            continue
        words = started.words_of(element.text.span)
        what = f"roslaunch {command.package} {command.file}".replace("  ", " ")
        for (argument, usual, severity), sample, wanted in zip_longest(
            ARGUMENTS, EXECUTABLES_ARGUMENTS, parameters[: len(ARGUMENTS)]
        ):
            value = command.arguments.get(argument)
            if value is not None and str(sample) in value:
                continue
            had = "has no" if value is None else f"has {argument}:={value}, expected"
            yield finding(
                element.text,
                f"{what} {had} {argument}:=#{{{wanted or usual}}}",
                severity=severity,
                fix=_passing(words, command, argument, wanted) if wanted else None,
            )


def _passing(
    words: Sequence[Span], command: LaunchCommand, argument: str, parameter: str
) -> Fix | None:
    """Return the fix that passes a parameter: over the constant, else behind the file."""
    value = f"{argument}:=#{{{parameter}}}"
    for word in words:
        if word.text.startswith(f"{argument}:="):
            return Fix(Safety.UNSAFE, (word.replacement(value),))
        if word.text == command.file and argument not in command.arguments:
            end = Span(word.source, word.end, word.end)
            return Fix(Safety.UNSAFE, (end.replacement(f" {value}"),))
    return None


def _spawner(arguments: str) -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  ""
end

def rosExecutables(_name, _worldName)
  <<-HEREDOC
    <executable name="topics">
      <command>roslaunch --wait rover vehicle_topics.launch {arguments}
    </executable>
  HEREDOC
end
"""


_END = "</command>"
_MARK = "<!-- ^ SPW013 -->"

GOOD = [{"launch/spawner.rb": _spawner("world_name:=#{_worldName} name:=#{_name}" + _END)}]
BAD = [
    {"launch/spawner.rb": _spawner(_END + _MARK)},
    {"launch/spawner.rb": _spawner("world_name:=#{_worldName} name:=rover" + _END + _MARK)},
    {"launch/spawner.rb": _spawner("name:=#{_name}" + _END + _MARK)},
]
