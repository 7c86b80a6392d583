"""A parameter file of Gazebo's plugin that is missing, not installed, or not valid YAML.

The plugin gives the file of `<parameters>` to the controller manager that it starts. Without it the
manager does not start, or knows no controller. When a package is renamed, `$(find …)` is often
forgotten. A file that is left to an argument of xacro is not checked where a launch file names that
argument, or where there is no launch file, and none is where a launch file in Python contains
`<parameters>`: it rewrites the tag. Plugins in SDF models are checked too.

Fix: correct the path, and install the file: `$(find package)/config/controllers.yaml`.
Source: gz_ros2_control, `GazeboSimROS2ControlPlugin::Configure`.
"""

import re

from checker.formats.xacro.files import ROOT
from checker.package.containers import container_with
from checker.package.installed import left_out, resolve_listed
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.package.uris import is_on_one_machine
from checker.ros.ros2_control.robot_control import GazeboManager, ParametersFile, PluginFiles
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    lessened,
    replace_text,
    rule,
    unchecked,
)
from checker.rulebook.example_parts import GAZEBO, gazebo_control, ros2_control

_TAG = "<parameters>"
_ARGUMENT = re.compile(r"\$[({](?:arg\s{1,8})?(\w{1,100})[)}]")


@rule("R2C006", "parameter-file-not-found", Severity.ERROR, Concern.INTERFACE)
def check(
    files: PluginFiles, package: Package, papers: Paperwork, spawned: SpawnedFiles | None
) -> Findings:
    """Report files that do not exist, and packages that nothing says to be needed.

    A package that package.xml does not name either is a warning; if the file is in this package
    under the same path, it is an error. So is an absolute path, but for one below the `WORKDIR` of
    a Dockerfile: a warning, because its container has it. A plugin without `<parameters>` is
    a warning. In a description for ros2_control of hardware alone it weighs less.
    """
    found = [*_found(files, package, papers)]
    has_any = any(isinstance(each, Finding) for each in found)
    clause = spawned.of_hardware(files.robot) if has_any and spawned is not None else ""
    for each in found:
        yield lessened(each, clause) if clause and isinstance(each, Finding) else each


def _found(files: PluginFiles, package: Package, papers: Paperwork) -> Findings:
    for fault in files.faults:
        yield finding(fault.span, f"the parameter file cannot be read: {fault.message}")
    for reason in files.unread:
        yield unchecked(reason)
    if files.managers and package.workspace.launches_with(_TAG):
        yield unchecked(f"a launch file rewrites {_TAG} of the description")
        return
    for manager in files.managers:
        if not manager.files:
            yield from _without_file(manager, package)
        for file in manager.files:
            yield from _file(file, package, papers)


def _file(file: ParametersFile, package: Package, papers: Paperwork) -> Findings:
    if is_on_one_machine(file.text.value):
        yield _on_one_machine(file, package)
    elif file.path is None and file.package:
        yield from _elsewhere(file, package, papers)
    elif file.path is not None and not file.exists:
        is_folder = file.text.value.endswith("/")
        hint = "remove the slash at its end" if is_folder else f"looked for {file.path}"
        yield finding(file.text, f"{_label(file)} does not exist ({hint})")
    elif file.path is not None and file.package:
        holder, path = resolve_listed(package, file.path)
        # Under another path than in the source it was found because it is installed there.
        left = left_out(package, holder, path) if path == _path_below_share(file) else None
        if left is not None:
            message = f"{_label(file)} is not installed: {left.instead}"
            yield finding(file.text, message, key=left.around)


def _on_one_machine(file: ParametersFile, package: Package) -> Finding:
    absent = file.path is not None and not file.exists
    container = container_with(package, file.text.value) if not absent else ""
    where = f"in the container of {container}" if container else "on its author's machine"
    near = ""
    if file.path is not None and file.exists:
        near = f"$(find {file.package})/{resolve_listed(package, file.path)[1]}"
    is_xacro = file.text.span.source.file.endswith(".xacro")
    expanded = "" if is_xacro else " in a xacro file, and expand that at launch"
    return finding(
        file.text,
        f"{file.text.value} is {where}, and Gazebo finds it nowhere else: write "
        f"{near or '$(find PACKAGE)/…'}{expanded}",
        severity=Severity.WARNING if container else None,
        fix=replace_text(file.text, near, Safety.UNSAFE) if near and is_xacro else None,
    )


def _without_file(manager: GazeboManager, package: Package) -> Findings:
    if name := _given_at_launch(manager, package):
        yield unchecked(
            f"{manager.plugin.label} gets its parameters by {name}, which is empty by default"
        )
        return
    yield finding(
        manager,
        f"{manager.plugin.label} has no <parameters>: the controller manager that it starts has no "
        "parameters",
        severity=Severity.WARNING,
    )


def _given_at_launch(manager: GazeboManager, package: Package) -> str:
    """Return what the xacro writes as the file, if a launch file may give it; else nothing."""
    stated = manager.plugin.element.child("parameters")
    written = stated.written.text.value if stated is not None else ""
    named, words = _ARGUMENT.fullmatch(written), package.workspace.launch_words
    return written if named and (not words or named[1] in words) else ""


def _elsewhere(file: ParametersFile, package: Package, papers: Paperwork) -> Findings:
    """Judge a file of a package that is not available."""
    manifest = papers.manifest
    if manifest is None or manifest.depends_on(file.package):
        yield unchecked(f"package {file.package} is not available")
        return
    path = _path_below_share(file)
    here = bool(path) and package.exists(path)
    yield finding(
        file.text,
        f"{_label(file)} is in package {file.package!r}, which is not available and which "
        f"package.xml does not depend on{f'; {path} is in this package' if here else ''}",
        severity=None if here else Severity.WARNING,
    )


def _path_below_share(file: ParametersFile) -> str:
    """Return the path below the folder of the installed package."""
    return file.text.value.partition(file.package)[2].lstrip(")/")


def _label(file: ParametersFile) -> str:
    return file.text.value.removeprefix(f"{ROOT}/")


def _arm(parameters: str) -> dict[str, str]:
    return {"@urdf": ros2_control(hardware=GAZEBO) + gazebo_control(parameters)}


def _model(parameters: str) -> dict[str, object]:
    plugin = gazebo_control(parameters).replace("<gazebo>", "").replace("</gazebo>", "")
    return {"@robot": "rover", "@change": {"</model>": f"{plugin}</model>"}}


_MARK = "  <!-- ^ R2C006 -->"
_HERE = "$(find acme_arm_description)/config/control.yaml"
_OWN = "acme_arm_description/config/arm.yaml"
_SELDOM = "$(find other_arm)/config"
_BUILD = """project(acme_arm_description)
install(DIRECTORY config/other urdf DESTINATION share/${PROJECT_NAME}/config)
ament_package()
"""
_GIVEN = """<robot xmlns:xacro="http://wiki.ros.org/xacro" name="arm">
<xacro:arg name="control_file" default=""/>
<link name="base_link"/>
<gazebo>
<plugin filename="gz_ros2_control-system" name="gz_ros2_control::GazeboSimROS2ControlPlugin">%
<parameters>$(arg control_file)</parameters>
</plugin>
</gazebo>
</robot>
"""


_LAUNCH = """<launch><node pkg="robot_state_publisher" exec="robot_state_publisher">
<param name="robot_description"
  value="$(command 'xacro $(find-pkg-share acme_arm_description)/urdf/arm.urdf.xacro %')"/>
</node></launch>
"""


def given(argument: str, mark: str = "") -> dict[str, object]:
    """Return an example whose launch file gives an argument of its xacro, or none."""
    return {
        "@urdf": "",
        "urdf/arm.urdf": None,
        "urdf/arm.urdf.xacro": _GIVEN.replace("%", mark),
        "launch/arm.launch.xml": _LAUNCH.replace("%", argument),
    }


_MOVED = "install(DIRECTORY bringup/config urdf DESTINATION share/${PROJECT_NAME})"
GOOD = [
    _arm(f"<parameters>{_HERE}</parameters>"),
    {
        **_arm(f"<parameters>{_HERE.replace('control', 'arm')}</parameters>"),
        "CMakeLists.txt": f"project(acme_arm_description)\n{_MOVED}\nament_package()\n",
        "bringup/config/arm.yaml": "a: 1\n",
    },
]
BAD = [
    _model(f"<parameters>{_MARK}/home/ann/ws/src/arm/control.yaml\n    </parameters>"),
    given("", _MARK),
    {
        **_arm(f"<parameters>{_HERE}</parameters>{_MARK}"),
        "CMakeLists.txt": _BUILD,
        "config/other/a.yaml": "a: 1\n",
    },
    _arm(f"<parameters>$(find acme_arm_description)/config/none.yaml</parameters>{_MARK}"),
    _arm(f"<parameters>{_HERE}/</parameters>{_MARK}"),
    _arm(f"<parameters>{_SELDOM}/control.yaml</parameters>{_MARK}"),
    _arm(f"<parameters>/home/ann/ws/install/share/arm/control.yaml</parameters>{_MARK}"),
    {
        "@urdf": "",
        "urdf/arm.urdf": None,
        "urdf/arm.urdf.xacro": _GIVEN.replace("%", "").replace(
            "$(arg control_file)</parameters>", f"/home/ann/ws/src/{_OWN}</parameters>{_MARK}"
        ),
        "config/arm.yaml": "controller_manager:\n  ros__parameters: {}\n",
    },
    # A warning: the container has it.
    {
        **_arm(f"<parameters>/ws/install/arm/share/arm/config/control.yaml</parameters>{_MARK}"),
        "Dockerfile": "FROM ros:jazzy\nWORKDIR /ws\n",
    },
    _arm(f"<parameters>{_SELDOM}/other.yaml</parameters>{_MARK}"),
    {
        **_arm("<parameters>$(find acme_arm_description)/config/arm.yaml</parameters>"),
        "config/arm.yaml": "controller_manager:\n\tros__parameters:  # ^ R2C006\n",
    },
]
