"""A roslaunch command without the robot's name or the world's.

The launch file then uses its default: the topics of another robot, or none. The topics of all
sensors contain the world's name.

Fix: append `world_name:=#{_worldName} name:=#{_name}` to the command.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from itertools import zip_longest

from checker.launch.ros1.launch_file import LaunchCommand
from checker.launch.spawner.emitted_xml import StartedXml
from checker.launch.spawner.reader import EXECUTABLES_ARGUMENTS, Spawner
from checker.rule import Concern, Findings, Severity, finding, rule

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
            )


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
