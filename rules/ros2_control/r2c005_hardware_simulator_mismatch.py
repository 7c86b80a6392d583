"""Hardware of Gazebo without Gazebo's plugin, or the other way round.

Hardware such as `gz_ros2_control/GazeboSimSystem` exists only in Gazebo, and a plugin in `<gazebo>`
starts the controller manager there: the robot needs both. With the plugin and other hardware, such
as `mock_components/GenericSystem`, the controllers run and the simulated robot does not move: an
error where a launch file spawns the robot and its files name no hardware of Gazebo at all.
Without any `<ros2_control>` tag the plugin stops, and there is no controller manager. The plugin's
`name` is the class that is loaded from the library; it cannot be chosen freely. An SDF model in the
workspace that has the plugin and the same joints takes the place of the URDF file in Gazebo. In a
description that launch files load and never spawn, where they spawn another one or give it to
ros2_control_node, nothing is an error, and hardware of a real robot is right. ros2_control_node
cannot load hardware of Gazebo: it loads no hardware at all, and no controller starts. What a xacro
file lacks that other files include and no launch file names may be in these: it is not reported.
What a macro that is not available may add is not checked.

Fix: write the plugin below `<gazebo>`, with `<parameters>`, and the hardware of the same simulator:
from Harmonic on `gz_ros2_control-system`, `gz_ros2_control::GazeboSimROS2ControlPlugin` and
`gz_ros2_control/GazeboSimSystem`; in Fortress `ign_ros2_control-system`,
`ign_ros2_control::IgnitionROS2ControlPlugin` and `ign_ros2_control/IgnitionSystem`; in Gazebo
Classic `libgazebo_ros2_control.so`, any name, and `gazebo_ros2_control/GazeboSystem`.
For ros2_control_node, leave the hardware of Gazebo out with an argument of xacro.
Source: gz_ros2_control, gz_hardware_plugins.xml and GZ_ADD_PLUGIN of each branch: the base class
is none of hardware_interface, which alone ros2_control_node loads.
"""

import posixpath
from collections.abc import Iterator, Mapping

from msgspec.structs import replace

from checker.formats.xacro.expanded import ExpandedText
from checker.package.package import Package
from checker.robots.candidates import is_included
from checker.ros.ros2_control.distributions import is_of_gazebo
from checker.ros.ros2_control.exported_hardware import is_exported_for_gazebo
from checker.ros.ros2_control.hardware import Hardware
from checker.ros.ros2_control.robot_control import GazeboManager, RobotControl
from checker.ros.ros2_control.sdf_managers import managed_by_sdf
from checker.ros.spawned import SpawnedReader
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Severity,
    Unchecked,
    finding,
    rename,
    rule,
    unchecked,
)
from checker.rulebook.example_parts import GAZEBO, MOCK, model_beside, ros2_control

_CLASSES: Mapping[str, tuple[str, ...]] = {
    "gz_ros2_control-system": (
        "gz_ros2_control::GazeboSimROS2ControlPlugin",
        "ign_ros2_control::IgnitionROS2ControlPlugin",
    ),
    "ign_ros2_control-system": ("ign_ros2_control::IgnitionROS2ControlPlugin",),
}
"""The names that a plugin of a library may have; the last one is that of Fortress."""
_PACKAGES: Mapping[str, tuple[str, ...]] = {
    "gz_ros2_control-system": ("gz_ros2_control", "ign_ros2_control"),
    "ign_ros2_control-system": ("ign_ros2_control",),
    "gazebo_ros2_control": ("gazebo_ros2_control",),
}
"""The packages whose hardware a plugin of a library loads."""
_HARDWARE: Mapping[str, str] = {
    "gz_ros2_control-system": "gz_ros2_control/GazeboSimSystem",
    "ign_ros2_control-system": "ign_ros2_control/IgnitionSystem",
    "gazebo_ros2_control": "gazebo_ros2_control/GazeboSystem",
}
"""The hardware that goes with a plugin's library."""
_FILES: Mapping[str, str] = {"gazebo_ros2_control": "libgazebo_ros2_control.so"}
"""Names of the files of libraries that are loaded by these alone."""
_OTHER_HARDWARE = "no hardware"
"""Key of findings about hardware that is not of Gazebo."""
_EVERY_PACKAGE = frozenset(name for names in _PACKAGES.values() for name in names)


@rule("R2C005", "hardware-simulator-mismatch", Severity.ERROR, Concern.INTERFACE)
def check(
    control: RobotControl,
    package: Package,
    context: Context,
    spawned: SpawnedFiles,
    reader: SpawnedReader,
) -> Findings:
    """Report plugins of a wrong name, or that cannot load the hardware.

    Gazebo's hardware without a plugin, and a plugin with other hardware, are warnings, except for
    hardware that Gazebo gets whatever its launch files are given. In what Gazebo never gets nothing
    is an error but its hardware for ros2_control_node, and other hardware is none of its faults.
    """
    outside = next(_outside(control, package, spawned, reader), None)
    if outside is not None:
        yield outside
        return
    found = [*_found(control, package, context)]
    clause = spawned.without(control.robot) if found else ""
    for each in found:
        if isinstance(each, Unchecked):
            yield each
        elif not clause:
            grave = each.key == _OTHER_HARDWARE and _is_certain(control)
            certain = grave and spawned.is_spawned(control.robot)
            yield replace(each, severity=None) if certain else each
        elif each.key != _OTHER_HARDWARE:
            message = f"{each.message} ({clause})"
            yield replace(each, message=message, severity=Severity.WARNING)


def _outside(
    control: RobotControl, package: Package, spawned: SpawnedFiles, reader: SpawnedReader
) -> Iterator[Finding]:
    """Yield hardware of Gazebo at the ros2_control_node that gets it, if the package has that.

    The arguments of xacro there decide which hardware it gets.
    """
    may_be = control.by_default and _simulated(control, package)
    for manager in spawned.managers_outside(control.robot) if may_be else ():
        given = reader.control(manager.load)
        for hardware in _simulated(given, package)[:1] if given is not None else ():
            places = [
                (manager.place, "ros2_control_node gets it here"),
                (hardware.plugin.span.place(), "the hardware"),
            ]
            if manager.place.file.startswith("../"):
                places.reverse()
            (place, _), other = places
            yield finding(
                place,
                f"ros2_control_node cannot load hardware {hardware.plugin.value!r}, which exists "
                "only in Gazebo: no hardware of the robot is loaded, and no controller starts; "
                "leave the tag out of what ros2_control_node gets",
                key="outside of Gazebo",
                related=[other],
            )


def _simulated(control: RobotControl, package: Package) -> list[Hardware]:
    return [
        each
        for each in control.hardware
        if is_of_gazebo(each.plugin.value) or is_exported_for_gazebo(each.plugin.value, package)
    ]


def _is_certain(control: RobotControl) -> bool:
    """Return whether the files of a robot name its hardware in full, and none of Gazebo."""
    source = control.robot.document.source
    files = source.gathered.sources.values() if isinstance(source, ExpandedText) else (source,)
    texts = [it.text for it in files]
    names = [it.plugin.value for it in control.hardware]
    return all(any(name in text for text in texts) for name in names) and not any(
        f"{package}/" in text for text in texts for package in _EVERY_PACKAGE
    )


def _found(control: RobotControl, package: Package, context: Context) -> Findings:
    for manager in control.managers:
        yield from _names(manager, context.release)
        yield from _another_library(control, manager)
    # With another value of an argument the robot may be the real one, and no Gazebo runs.
    if control.by_default and not _is_part(package, control.robot.document.source.file):
        yield from _disagreement(control, package)


def _is_part(package: Package, file: str) -> bool:
    """Return whether a file is a part of other robots, and none that a launch file loads."""
    launched = package.workspace.launches_file(posixpath.basename(file))
    return not launched and is_included(package, file)


def _another_library(control: RobotControl, manager: GazeboManager) -> Iterator[Finding]:
    packages = _PACKAGES.get(manager.library)
    for hardware in control.hardware:
        owner = hardware.plugin.value.partition("/")[0]
        if packages is not None and owner in _EVERY_PACKAGE and owner not in packages:
            meant = _HARDWARE[manager.library]
            yield finding(
                manager,
                f"{manager.plugin.filename.value} cannot load hardware "
                f"{hardware.plugin.value!r}, which is for another simulator: expected "
                f"{meant!r}",
                key=f"{manager.library} {owner}",
                related=[(hardware.plugin, "the hardware")],
                fix=None if manager.library in _FILES else rename(hardware.plugin, meant),
            )


def _names(manager: GazeboManager, release: str) -> Iterator[Finding]:
    name, classes = manager.plugin.name, _CLASSES.get(manager.library)
    if classes is not None and name.value not in classes:
        meant = classes[-1 if release == "fortress" else 0]
        yield finding(
            name,
            f"plugin of {manager.plugin.filename.value} is named {name.value!r}, which is not a "
            f"class of it: expected {meant}",
            fix=rename(name, meant),
        )


def _disagreement(control: RobotControl, package: Package) -> Findings:
    simulated = _simulated(control, package)
    others = [each for each in control.hardware if each not in simulated and each.plugin.value]
    lacks_tag = control.managers and not control.hardware
    lacks_plugin = simulated and not control.managers and not managed_by_sdf(package, control)
    if (lacks_tag or lacks_plugin) and control.robot.missing_parts:
        yield unchecked(control.robot.missing_parts)
    elif lacks_tag:
        yield finding(
            control.managers[0],
            f"plugin {control.managers[0].plugin.name.value!r} runs a controller manager, but the "
            "robot has no <ros2_control> tag",
            key="no tag",
        )
    elif lacks_plugin:
        missing = _plugin_for(simulated[0].plugin.value)
        yield finding(
            simulated[0].plugin,
            f"hardware {simulated[0].plugin.value!r} needs a plugin of Gazebo that runs the "
            f"controller manager, but the robot has none{missing}",
            severity=Severity.WARNING,
            key="no plugin",
        )
    elif control.managers and others and not simulated:
        plugin = control.managers[0]
        yield finding(
            others[0].plugin,
            f"Gazebo runs the controller manager, but the hardware is {others[0].plugin.value!r}: "
            f"the simulated robot does not move{_hardware_for(plugin)}",
            severity=Severity.WARNING,
            key=_OTHER_HARDWARE,
            related=[(plugin, "the plugin of Gazebo")],
        )


def _plugin_for(hardware: str) -> str:
    """Return what to write for hardware of Gazebo that has no plugin."""
    library = next((it for it, known in _HARDWARE.items() if known == hardware), "")
    name = next(iter(_CLASSES.get(library, ())), library)
    return (
        f': write <plugin filename="{_FILES.get(library, library)}" name="{name}">'
        if library
        else ""
    )


def _hardware_for(manager: GazeboManager) -> str:
    """Return what to write as hardware for a plugin of Gazebo."""
    known = _HARDWARE.get(manager.library)
    return f": write {known}" if known else ""


def _arm(plugin: str, hardware: str = GAZEBO) -> dict[str, str]:
    return {"@urdf": ros2_control(hardware=hardware) + plugin}


def _plugin(library: str, name: str, mark: str = "") -> str:
    return f'<gazebo>\n<plugin filename="{library}" name="{name}"/>{mark}\n</gazebo>'


def _managed(mark: str, spawn: str = "") -> dict[str, str]:
    """Return an arm with hardware of Gazebo that is given to ros2_control_node."""
    return {
        "@ros2": f"""        Node(
             package='robot_state_publisher', executable='robot_state_publisher',
             parameters=[{{'robot_description': ParameterValue(robot, value_type=str)}}]),
        Node(package='controller_manager', executable='ros2_control_node'),{mark}
{spawn}""",
        "urdf/arm.urdf.xacro": f"""<robot name="arm">
<link name="base_link"/>
<link name="upper_arm"/>
<joint name="shoulder" type="revolute">
  <parent link="base_link"/><child link="upper_arm"/>
  <limit lower="-1" upper="1" effort="1" velocity="1"/>
</joint>
{ros2_control(hardware=GAZEBO)}
{_plugin(*_GZ)}
</robot>
""",
    }


_SPAWN = """        Node(package='ros_gz_sim', executable='create',
             arguments=['-topic', 'robot_description']),"""
_GZ = ("gz_ros2_control-system", "gz_ros2_control::GazeboSimROS2ControlPlugin")
_IGNITION = "<plugin>ign_ros2_control/IgnitionSystem</plugin>"
_MARK = "  <!-- ^ R2C005 -->"
_EXPORTED = """<library path="acme">
  <class name="acme_gazebo/Arm" base_class_type="gz_ros2_control::GazeboSimSystemInterface"/>
</library>
"""
_INCLUDING = """<robot name="cell" xmlns:xacro="http://ros.org/wiki/xacro">
<xacro:include filename="$(find acme_arm_description)/urdf/arm.urdf"/>
</robot>
"""
GOOD = [
    _managed("", _SPAWN),
    _arm(_plugin(*_GZ)),
    _arm(_plugin("libgz_ros2_control-system.so", _GZ[1])),
    _arm(_plugin("libacme_gz_ros2_control-system.so", "acme::Control")),
    _arm("", MOCK),
    {**_arm("", GAZEBO), **model_beside("shoulder")},
    {
        **_arm(_plugin(*_GZ), "<plugin>acme_gazebo/Arm</plugin>"),
        "../acme_gazebo/package.xml": "<package><name>acme_gazebo</name></package>",
        "../acme_gazebo/plugins.xml": _EXPORTED,
    },
    {
        "@urdf": _plugin(*_GZ),
        "launch/spawn.launch": None,
        "../acme_cell/package.xml": "<package><name>acme_cell</name></package>",
        "../acme_cell/urdf/cell.urdf.xacro": _INCLUDING,
    },
]
BAD = [
    _managed(_MARK.replace("<!--", "#").replace(" -->", "")),
    _arm(_plugin(_GZ[0], "gz_ros2_control", _MARK)),
    _arm(_plugin("ign_ros2_control-system", "ros2_control", _MARK), _IGNITION),
    _arm("", GAZEBO + _MARK),
    {**_arm("", GAZEBO + _MARK), **model_beside("elbow")},
    {**_arm("", GAZEBO + _MARK), **model_beside("shoulder", "")},
    _arm(_plugin(*_GZ), MOCK + _MARK),
    _arm(_plugin("libgazebo_ros2_control.so", "gazebo_ros2_control", _MARK)),
    {"@urdf": _plugin(*_GZ, _MARK)},
]
