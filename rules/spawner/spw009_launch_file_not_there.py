"""A roslaunch command for a missing file, or a launch file that nothing starts.

A command fails if its file is missing, or if it is from a robot that is not installed next to this
one: the robot moves, but none of its topics reach ROS. If nothing starts description.launch or
vehicle_topics.launch, the robot's description or its bridges are missing.

Fix: name this package and an existing file; declare another robot's package in package.xml.
Source: Model Migration Guide, example spawner. None of the accepted packages that we checked shows
this.
"""

from collections.abc import Iterator

from checker.expand.launch.graph import LaunchGraph
from checker.expand.launch.launch_file import LaunchCommand
from checker.expand.spawner.emitted_xml import StartedXml
from checker.expand.spawner.reader import Spawner
from checker.package.inheritance import SUBMISSION_NAME, Found
from checker.package.package import Package
from checker.package.references import PROVIDED, ReferenceKind
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import Located

USUAL = ("description.launch", "vehicle_topics.launch")


@rule("SPW009", "launch-file-not-there", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, spawner: Spawner, started: StartedXml, launch: LaunchGraph) -> Findings:
    """Report commands that fail, and launch files that nothing starts."""
    names = {include.file.rsplit("/", 1)[-1] for include in launch.includes}
    for element in started.commands:
        command = LaunchCommand.parse(element.text.value)
        if command is None or not command.file:
            continue
        names.add(command.file.rsplit("/", 1)[-1])
        if command.package:
            yield from _judge(package, command, element.text)
    function = spawner.functions.get("rosExecutables")
    for name in USUAL:
        if name not in names and isinstance(package.part(f"launch/{name}"), Found):
            yield finding(
                function or spawner.entry.whole(),
                f"nothing starts {name}: start it in the spawner",
                severity=Severity.WARNING,
            )


def _judge(
    package: Package, command: LaunchCommand, where: Located[str]
) -> Iterator[Finding | Unchecked]:
    name, file = command.package, command.file.rsplit("/", 1)[-1]
    foreign = bool(SUBMISSION_NAME.search(name)) and _robot(name) != _robot(package.name)
    if foreign and not _is_meant(package, name):
        yield finding(
            where,
            f"the command starts {file} of another robot, {name}, which package.xml does not "
            "declare",
        )
        return
    holder = package if name == package.name else package.workspace.package(name)
    if holder is None and name in PROVIDED:
        return
    if holder is None:
        yield unchecked(f"{name}, whose {file} is started, is not available")
    elif not any(e.path.rsplit("/", 1)[-1] == file for e in holder.index.with_suffix(file.lower())):
        yield finding(where, f"the command starts {file}, which {holder.name} does not have")


def _robot(name: str) -> str:
    return SUBMISSION_NAME.sub("", name)


def _is_meant(package: Package, name: str) -> bool:
    """Whether this package inherits the model of another or declares it in package.xml."""
    if package.base is not None and package.base.package_name == name:
        return True
    declared = (
        reference for reference in package.references if reference.kind is ReferenceKind.DEPENDENCY
    )
    return name in (item.package_name for item in declared)


def _spawner(first: str, second: str = "", mark: str = "") -> str:
    return f"""def spawner(_name, _modelURI, _worldName, _x, _y, _z, _roll, _pitch, _yaw)
  ""
end

def rosExecutables(_name, _worldName) {mark}
  <<-HEREDOC
    <executable name="a"><command>roslaunch --wait {first}
    </executable>
    <executable name="b"><command>roslaunch --wait {second or _TOPICS}
    </executable>
  HEREDOC
end
"""


_NAME = "acme_rover_sensor_config_1"
_END = "</command>"
_TOPICS = f"{_NAME} vehicle_topics.launch{_END}"
_MARK = "<!-- ^ SPW009 -->"

GOOD = [{"launch/spawner.rb": _spawner(f"{_NAME} description.launch{_END}")}]
BAD = [
    {
        "launch/spawner.rb": _spawner(
            f"x1_sensor_config_6 description.launch{_END}{_MARK}",
        )
    },
    {
        "launch/spawner.rb": _spawner(
            f"{_NAME} description.launch{_END}", f"{_NAME} t.launch{_END}{_MARK}", f"# {_MARK}"
        )
    },
    {"launch/spawner.rb": _spawner(_TOPICS, mark=f"# {_MARK}")},
]
