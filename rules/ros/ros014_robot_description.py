"""The robot's description cannot be loaded, or has the wrong parameter name.

Tools look for `/<robot's name>/robot_description`. If xacro does not find its file, roslaunch stops
and starts no node of the file. Without `name:=` all robots of a team get the same frames. A shell
or Python script in the command is read, not run: it must pass its arguments to xacro (`"$@"`,
`sys.argv`), or `name:=` with the value of an argument.

Fix: `<param name="$(arg name)/robot_description" command="$(find xacro)/xacro '$(find
<package>)/urdf/robot_from_sdf.xacro' name:=$(arg name)"/>`.
Source: Model Migration Guide, description.launch.
"""

from collections.abc import Iterator

from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.substitution import is_known
from checker.package.inheritance import SUBMISSION_NAME, Found
from checker.package.package import Package
from checker.ros.description_script import DescriptionScript, read_description_script
from checker.ros.robot_description import (
    NAME,
    DescriptionFile,
    RobotDescription,
    robot_descriptions,
)
from checker.rule import Concern, Finding, Findings, Severity, Unchecked, finding, rule, unchecked
from checker.source.text import SourceText
from checker.source.xml import XmlDocument

_LAUNCH = "launch/description.launch"
_NEEDED = "$(arg name)"
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
    holder = _holder(package, file)
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
    held = [(file.path, _holder(package, file)) for file in description.files]
    scripts = [
        (script, holder)
        for path, holder in held
        if holder is not None and (script := read_description_script(holder, path)) is not None
    ]
    script = scripts[0][0] if scripts else None
    if _is_given(description, robot, script):
        return
    held += [(path, holder) for script, holder in scripts for path in script.files]
    for path, holder in dict.fromkeys(held):
        source = holder.read(path) if holder is not None else None
        if isinstance(source, SourceText) and _NEEDED in source.text:
            yield finding(
                description,
                f"{path} needs the robot's name, but {_argument_phrase(description, script)}",
            )


def _holder(package: Package, file: DescriptionFile) -> Package | None:
    return package.named(file.package) if file.package else package


def _is_given(description: RobotDescription, robot: str, script: DescriptionScript | None) -> bool:
    """Return whether xacro gets the robot's name, as far as known."""
    if script is not None:
        if "name" in script.arguments:
            return script.arguments["name"] is None
        # What a script makes of a word alone is its own affair.
        if script.learns_more or robot in description.param.value.split():
            return True
        if not script.takes_arguments:
            return False
    name = description.arguments.get("name")
    return name == robot or (name is not None and not is_known(name))


def _argument_phrase(description: RobotDescription, script: DescriptionScript | None) -> str:
    """Return what xacro gets instead of the robot's name, and what is expected."""
    if script is not None and "name" in script.arguments:
        given = f"name:={script.arguments['name']}"
        return f"{script.path} gives it {given}: expected the name from the launch file"
    if script is not None and not script.takes_arguments:
        return f"{script.path} does not pass its arguments to xacro"
    name = description.arguments.get("name")
    gets = f"gets {'no name:=' if name is None else f'name:={name}'}"
    gets = f"{script.path} {gets}" if script is not None else gets
    return f"{gets}: expected name:=$(arg name)"


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


def _script(text: str, args: str = " name:=$(arg name)", mark: str = "") -> dict[str, str]:
    command = f"$(find {_HERE})/scripts/describe{args}"
    return {**_description(command, mark), "scripts/describe": text}


_SHELL = f"""#!/bin/sh
# Prints the robot.
exec rosrun xacro xacro "$(rospack find {_HERE})/urdf/robot_from_sdf.xacro" mast:=1"""
_PYTHON = """#!/usr/bin/env python
import subprocess
import sys
subprocess.call(["xacro", FOLDER + "/urdf/robot_from_sdf.xacro"] + sys.argv[1:])
"""

GOOD = [
    _script(f'{_SHELL} "$@"\n'),
    _script(f"{_SHELL} name:=$1\n", args=" $(arg name)"),
    _script(_PYTHON),
    _script(_PYTHON.replace("sys.argv[1:]", 'rospy.get_param("~args")'), args=""),
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)"),
    _description("xacro $(dirname)/../urdf/robot_from_sdf.xacro name:=$(arg name)"),
    _description(f"$(find xacro)/xacro '$(find {_HERE})/urdf/plain.xacro'"),
    _description("$(find rover_description)/scripts/describe name:=$(arg name)"),
    _description(f"$(find {_HERE})/urdf/plain.xacro", kind="textfile"),
]
BAD = [
    _script(f'{_SHELL} "$@"\n', args="", mark=_MARK),
    _script(f'{_SHELL} "$@"\n', args=" name:=rover", mark=_MARK),
    _script(f"{_SHELL}\n", mark=_MARK),
    _script(f"{_SHELL} name:=rover\n", mark=_MARK),
    _script(_PYTHON, args="", mark=_MARK),
    _description(f"$(find xacro)/xacro {_FILE}", _MARK),
    _description(f"$(find xacro)/xacro {_FILE} name:=rover", _MARK),
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)", _MARK, NAME),
    _description(f"$(find xacro)/xacro {_FILE} name:=$(arg name)", _MARK, f"X1/{NAME}"),
    _description(
        f"$(find xacro)/xacro '$(find {_HERE})/urdf/model.xacro' name:=$(arg name)", _MARK
    ),
    {_LAUNCH: f"<launch>{_MARK}\n</launch>\n"},
]
