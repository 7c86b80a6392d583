"""The robot's description cannot be loaded, or has the wrong parameter name.

Tools look for `/<robot's name>/robot_description`. If xacro does not find its file, roslaunch stops
and starts no node of the file. Without `name:=` all robots of a team get the same frames.

Fix: `<param name="$(arg name)/robot_description" command="$(find xacro)/xacro '$(find
<package>)/urdf/robot_from_sdf.xacro' name:=$(arg name)"/>`.
Source: Model Migration Guide, description.launch.
"""

from collections.abc import Iterator

from checker.expand.launch.graph import LaunchGraph
from checker.expand.launch.substitution import is_known
from checker.model.ros.robot_description import (
    NAME,
    DescriptionFile,
    RobotDescription,
    robot_descriptions,
)
from checker.package.inheritance import SUBMISSION_NAME, Found
from checker.package.package import Package
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_LAUNCH = "launch/description.launch"
_PROGRAMS = ("scripts/", "bin/", "src/", "nodes/")
"""Folders of programs that a package builds or installs, which are not in its sources."""


@rule("ROS014", "robot-description", Severity.ERROR, Concern.INTERFACE)
def check(package: Package, launch: LaunchGraph) -> Findings:
    """Check the parameters named robot_description in the started files."""
    descriptions = robot_descriptions(launch)
    if not descriptions:
        yield from _absent(package, launch)
    named = launch.arguments.get("name")
    robot = named.value if named else ""
    for description in descriptions:
        yield from _namespace(description, robot)
        for file in description.files:
            yield from _file(package, description, file)
        yield from _argument(package, description, robot)


def _absent(package: Package, launch: LaunchGraph) -> Findings:
    for reason in launch.unread:
        yield unchecked(reason)
    part = package.part(_LAUNCH)
    document = package.xml(part.path) if isinstance(part, Found) else None
    if isinstance(document, XmlDocument) and not launch.unread:
        yield finding(document.root, f"{_LAUNCH} sets no {NAME}")


def _namespace(description: RobotDescription, robot: str) -> Iterator[Finding]:
    wanted = f"/{robot}" if robot else "/<the robot's name>"
    if is_known(description.param.name) and description.namespace != wanted:
        yield finding(
            description,
            f"the description is set as {description.param.name}, expected {wanted}/{NAME}",
        )


def _file(
    package: Package, description: RobotDescription, file: DescriptionFile
) -> Iterator[Finding | Unchecked]:
    name, path = file.package, file.path
    holder = package if name in ("", package.name) else package.workspace.package(name)
    if holder is None:
        if SUBMISSION_NAME.search(name):
            yield unchecked(f"package {name}, which contains {path}, is not available")
    elif holder.exists(path):
        return
    elif path.startswith(_PROGRAMS) and not holder.exists(path.partition("/")[0]):
        yield unchecked(f"{path}, which generates the description, is not available")
    else:
        yield finding(description, f"{path} of {holder.name} does not exist, so {NAME} is not set")


def _argument(package: Package, description: RobotDescription, robot: str) -> Iterator[Finding]:
    """Report a xacro file that needs the robot's name, but does not get it."""
    name = description.arguments.get("name")
    if name == robot or (name is not None and not is_known(name)):
        return
    for file in description.files:
        prefix = f"../{file.package}/" if file.package not in ("", package.name) else ""
        source = package.read(f"{prefix}{file.path}")
        if isinstance(source, SourceText) and "$(arg name)" in source.text:
            what = "no name:=" if name is None else f"name:={name}"
            yield finding(
                description,
                f"{file.path} needs the robot's name, but gets {what}: expected name:=$(arg name)",
            )


_XACRO = (
    '<robot name="rover" xmlns:xacro="http://ros.org/wiki/xacro">\n'
    '<xacro:arg name="name" default="rover"/>\n<link name="$(arg name)/base_link"/>\n</robot>\n'
)
_HERE = "acme_rover_sensor_config_1"
_MARK = "  <!-- ^ ROS014 -->"
_FILE = f"'$(find {_HERE})/urdf/robot_from_sdf.xacro'"


def _description(
    command: str, mark: str = "", name: str = f"$(arg name)/{NAME}", kind: str = "command"
) -> dict[str, str]:
    return {
        "urdf/robot_from_sdf.xacro": _XACRO,
        "urdf/plain.xacro": '<robot name="rover"/>\n',
        _LAUNCH: f"""<launch>
<arg name="name"/>
<param name="{name}" {kind}="{command}"/>{mark}
</launch>
""",
    }


GOOD = [
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)"),
    _description("xacro $(dirname)/../urdf/robot_from_sdf.xacro name:=$(arg name)"),
    _description(f"$(find xacro)/xacro '$(find {_HERE})/urdf/plain.xacro'"),
    _description("$(find rover_description)/scripts/describe name:=$(arg name)"),
    _description(f"$(find {_HERE})/urdf/plain.xacro", kind="textfile"),
]
BAD = [
    _description(f"$(find xacro)/xacro {_FILE}", _MARK),
    _description(f"$(find xacro)/xacro {_FILE} name:=rover", _MARK),
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)", _MARK, NAME),
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)", _MARK, f"X1/{NAME}"),
    _description(
        f"$(find xacro)/xacro '$(find {_HERE})/urdf/model.xacro' name:=$(arg name)", _MARK
    ),
    {_LAUNCH: f"<launch>{_MARK}\n</launch>\n"},
]
