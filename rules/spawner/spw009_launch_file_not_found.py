"""A roslaunch command for a missing file, or a launch file that nothing starts.

A command fails if its file is missing, or if it is from a robot that is not installed next to this
one: the robot moves, but none of its topics reach ROS. If nothing starts description.launch or
vehicle_topics.launch, the robot's description or its bridges are missing. A command that names
another package for a file that this one has too starts the other file, and this one never starts.

Fix: name this package and an existing file; declare another robot's package in package.xml.
Source: Model Migration Guide, example spawner. No accepted package that we checked has this fault.
"""

from collections.abc import Iterator

from checker.base.record import Record
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.launch_file import LaunchCommand
from checker.launch.spawner.emitted_xml import StartedXml
from checker.launch.spawner.reader import Spawner
from checker.package.inheritance import SUBMISSION_NAME, Found
from checker.package.package import Package
from checker.package.references import PROVIDED, ReferenceKind
from checker.package.submissions import is_slip_for, robot_of
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import Located

USUAL = ("description.launch", "vehicle_topics.launch")


class _Start(Record, eq=False):
    """A command that starts a launch file.

    Attributes:
        package_name: The package that it names; empty if it names the file by its path.
        file: Name of the launch file, without folders.
        path: The expected path of the file, from the package of the spawner.
        where: The command.
    """

    package_name: str
    file: str
    path: str
    where: Located[str]


@rule("SPW009", "launch-file-not-found", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, spawner: Spawner, started: StartedXml, launch: LaunchGraph) -> Findings:
    """Report commands that fail, and launch files that nothing starts."""
    starts = list(_starts(package, started))
    paths = {start.path for start in starts} | {include.file for include in launch.includes}
    instead: set[str] = set()
    for start in filter(lambda start: start.package_name, starts):
        own = f"launch/{start.file}"
        said = list(_judge(package, start))
        is_fault = any(isinstance(item, Finding) for item in said)
        if not is_fault and own not in paths and package.exists(own):
            said.append(_another_file(package, start))
        instead.update([start.file] if said else [])
        yield from said
    function = spawner.functions.get("rosExecutables")
    for name in USUAL:
        part = package.part(f"launch/{name}")
        if isinstance(part, Found) and part.path not in paths and name not in instead:
            yield finding(
                function or spawner.entry.whole(),
                f"nothing starts {name}: start it in the spawner",
                severity=Severity.WARNING,
            )


def _starts(package: Package, started: StartedXml) -> Iterator[_Start]:
    for element in started.commands:
        command = LaunchCommand.parse(element.text.value)
        if command is None or not command.file:
            continue
        name, file = command.package, command.file.rsplit("/", 1)[-1]
        holder = package.workspace.package(name) if name else package
        is_own = holder is package or name == package.name
        folder = "" if is_own else f"../{holder.name if holder else name}/"
        yield _Start(name, file, f"{folder}launch/{file}", element.text)


def _another_file(package: Package, start: _Start) -> Finding:
    return finding(
        start.where,
        f"the command starts {start.file} of {start.package_name}; that of {package.name} is "
        "never started",
        severity=Severity.WARNING,
    )


def _judge(package: Package, start: _Start) -> Iterator[Finding | Unchecked]:
    """Report a command for another robot, and one for a file that is not there."""
    name = start.package_name
    holder = package if name == package.name else package.workspace.package(name)
    if SUBMISSION_NAME.search(name) and not _is_meant(package, name):
        if robot_of(name) != robot_of(package.name):
            yield finding(
                start.where,
                f"the command starts {start.file} of another robot, {name}, which package.xml does "
                "not declare",
            )
            return
        if holder is None:
            yield finding(
                start.where,
                f"the command starts {start.file} of {name}, which package.xml does not declare "
                "and which is not available",
                severity=Severity.WARNING,
            )
            return
    if holder is None and name in PROVIDED:
        return
    if holder is None and not _is_meant(package, name) and is_slip_for(name, package.name):
        yield finding(
            start.where,
            f"the command starts {start.file} of {name}, which is not available; did you mean "
            f"{package.name!r}?",
        )
    elif holder is None:
        yield unchecked(f"{name}, whose {start.file} is started, is not available")
    elif not any(
        entry.path.rsplit("/", 1)[-1] == start.file
        for entry in holder.index.with_suffix(start.file.lower())
    ):
        yield finding(
            start.where, f"the command starts {start.file}, which {holder.name} does not have"
        )


def _is_meant(package: Package, name: str) -> bool:
    """Return whether this package uses another on purpose.

    It inherits its model, declares it in package.xml, or is a configuration of the same robot whose
    Ruby files it loads.
    """
    if package.base is not None and package.base.package_name == name:
        return True
    same = robot_of(name) == robot_of(package.name)
    kinds = {ReferenceKind.DEPENDENCY} | ({ReferenceKind.REQUIRE} if same else set())
    return any(item.package_name == name and item.kind in kinds for item in package.references)


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

_FIRST = "acme_rover_sensor_config_1"
_SECOND = {
    "@name": "acme_rover_sensor_config_2",
    f"../{_FIRST}/package.xml": f"<package><name>{_FIRST}</name></package>",
    f"../{_FIRST}/launch/description.launch": "<launch/>",
    f"../{_FIRST}/launch/vehicle_topics.launch": "<launch/>",
}
_DECLARED = f"""<package format="2">
  <name>acme_rover_sensor_config_2</name>
  <exec_depend>{_FIRST}</exec_depend>
</package>
"""


def _of_first(mark: str = "") -> str:
    return _spawner(f"{_FIRST} description.launch{_END}{mark}", f"{_TOPICS}{mark}")


GOOD = [
    {"launch/spawner.rb": _spawner(f"{_NAME} description.launch{_END}")},
    {
        **_SECOND,
        "launch/spawner.rb": _of_first(),
        **dict.fromkeys(("model.sdf", *(f"launch/{name}" for name in USUAL))),
    },
    {
        **_SECOND,
        "package.xml": _DECLARED,
        "launch/spawner.rb": _of_first(),
        **dict.fromkeys(f"launch/{name}" for name in USUAL),
    },
]
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
    {"launch/spawner.rb": _spawner(f"acme_rover_sensorconfig_1 description.launch{_END}{_MARK}")},
    {"launch/spawner.rb": _spawner(_TOPICS, mark=f"# {_MARK}")},
    {**_SECOND, "package.xml": _DECLARED, "launch/spawner.rb": _of_first(_MARK)},
    {"launch/spawner.rb": _spawner(f"acme_rover_sensor_config_11 description.launch{_END}{_MARK}")},
]
