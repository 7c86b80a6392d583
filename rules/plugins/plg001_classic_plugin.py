"""A plugin of Gazebo Classic in a model or world for Gazebo.

Gazebo, since it was called Ignition, cannot load plugins built for Gazebo Classic: it prints one
line and continues without the drive, the sensor or the light that the plugin provides.

In a URDF that no launch file spawns into Gazebo it is a warning: RViz, MoveIt and other simulators
do not read it, and the file may be kept for Gazebo Classic. In one that launch files spawn into
Gazebo Classic alone (`gazebo_ros`, `spawn_entity.py`) the plugins are right. Where there is no
launch file at all, it stays an error. Where launch files spawn it into both simulators, a plugin
whose replacement is beside it is right for Classic, and is not reported. If all its plugins are for
Classic, and no more launch files spawn it into Gazebo than into Classic, those are reported that
spawn it into Gazebo.

A xacro file may support several simulators by an argument: if its default chooses Gazebo Classic,
the plugins for later releases are not expanded, and no plugin is reported.

No accepted package that we checked has this fault.

Fix: remove the plugin and use what the message names: a sensor in the model, or a system plugin (in
a submission, in `launch/spawner.rb`). Where a launch file is reported, start Gazebo Classic in it,
or choose the plugins by a xacro argument.
Source: Model Migration Guide, "Remove/replace unsupported plugins".
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from checker.finding import Fix
from checker.launch.ros2.graph import Ros2Launch
from checker.launch.ros2.package_launch import launches_naming
from checker.model.components import Plugin
from checker.model.plugin_host import PluginHost
from checker.model.plugin_library import classic_plugin, library_stem, newer_name
from checker.model.robot import Robot
from checker.package.package import Package
from checker.robots.simulator import classic_by_default
from checker.ros.simulation import Simulations
from checker.ros.spawned import may_spawn
from checker.ros.spawned_files import SpawnedFiles
from checker.rule import (
    Concern,
    Context,
    Finding,
    Findings,
    Safety,
    Severity,
    finding,
    rule,
    unchecked,
)
from checker.source.xml_insertion import removal


@rule("PLG001", "classic-plugin", Severity.ERROR, Concern.INTERFACE)
def check(
    host: PluginHost,
    package: Package,
    context: Context,
    launch: Ros2Launch | None,
    simulations: Simulations | None,
    spawned: SpawnedFiles,
) -> Findings:
    """Report plugins whose library belongs to Gazebo Classic.

    One of a world that nothing takes the place of is a warning: the world works without it.
    """
    if context.is_classic:
        return
    if host.unread:
        yield unchecked(host.unread)
    if host.robot is not None and (reason := classic_by_default(host.robot, package)):
        yield unchecked(reason)
        return
    named = [(plugin, classic_plugin(plugin.filename.value)) for plugin in host.plugins]
    found = [(plugin, known) for plugin, known in named if known is not None]
    if found and host.robot is not None and spawned.is_in_classic(host.robot):
        return
    misplaced = [*_misplaced(host.robot, spawned, found)] if host.robot is not None else []
    if misplaced and len(found) == len(host.plugins):
        yield from misplaced
        return
    if host.robot is not None and spawned.is_in_both(host.robot):
        found = [(plugin, known) for plugin, known in found if not _is_replaced(known, host)]
    loaded = (
        not found
        or host.robot is None
        or context.is_gazebo_alone
        or (
            _is_loaded(host.robot, package, launch, simulations) and not spawned.without(host.robot)
        )
    )
    for plugin, known in found:
        needless = host.robot is None and known.get("action") == "remove"
        entry = _for_its_sensor(plugin, known)
        advice = _advice(entry) if context.is_subt else _later_advice(entry)
        yield finding(
            plugin.filename,
            f"{plugin.filename.value} is a plugin of Gazebo {_whose(context)}: {advice}",
            severity=Severity.WARNING if needless or not loaded else None,
            key=library_stem(plugin.filename.value),
            fix=Fix(Safety.UNSAFE, (removal(plugin.element),)) if _in_vain(plugin, known) else None,
        )


def _misplaced(
    robot: Robot, spawned: SpawnedFiles, found: Sequence[tuple[Plugin, dict[str, Any]]]
) -> Iterator[Finding]:
    """Yield the nodes that put a robot of Classic into Gazebo, where others do into Classic."""
    file, classic = robot.document.source.file, spawned.classic_spawn(robot)
    other = classic.file if classic is not None else ""
    for node in spawned.misplaced(robot) if found else ():
        yield finding(
            node.executable,
            f"Gazebo Sim gets {file} here and loads none of its plugins ({len(found)}), which are "
            f"of Gazebo Classic: spawn it with gazebo_ros spawn_entity.py, as {other} does, or "
            'have both kinds in the xacro, those of Gazebo Sim in `<xacro:if value="$(arg gz)">` '
            "and these in `<xacro:unless>`",
            key=file,
            related=[(plugin.filename, "a plugin of Gazebo Classic") for plugin, _ in found],
        )


def _is_replaced(known: Mapping[str, Any], host: PluginHost) -> bool:
    """Return whether the robot also has what does the same in a later Gazebo."""
    instead = known.get("replacement") or {}
    library = library_stem(instead.get("filename", ""))
    stems = {newer_name(library_stem(plugin.filename.value)) for plugin in host.plugins}
    if "later" in known:
        return any(stem and stem in known["later"] for stem in stems)
    types = {sensor.type.value for sensor in host.robot.sensors} if host.robot else set()
    return newer_name(library) in stems or instead.get("sensor_type") in types


def _is_loaded(
    robot: Robot, package: Package, launch: Ros2Launch | None, simulations: Simulations | None
) -> bool:
    """Return whether Gazebo loads a robot, or may: a URDF if a launch file may spawn it."""
    if robot.conventions.read_by_gazebo or not package.workspace.launch_words:
        return True
    if any(may_spawn(graph) for _, graph in launches_naming(package)):
        return True
    if launch is None or not any(map(may_spawn, launch.entries)):
        return False
    starting = simulations.launched if simulations is not None else ()
    spawned = {each.robot.document.source.file for it in starting for each in it.robots}
    unknown = not spawned or any(it.unknown_robots for it in starting)
    return unknown or robot.document.source.file in spawned


def _for_its_sensor(plugin: Plugin, entry: dict[str, Any]) -> dict[str, Any]:
    """Return the entry of a plugin; one for cameras publishes points of a depth camera, too."""
    sensor, instead = plugin.element.parent, entry.get("replacement") or {}
    is_depth = sensor is not None and (sensor.get("type") or "").startswith("depth")
    if not is_depth or instead.get("sensor_type") != "camera":
        return entry
    return {**entry, "replacement": {**instead, "sensor_type": "rgbd_camera"}}


def _in_vain(plugin: Plugin, entry: dict[str, Any]) -> bool:
    """Return whether only the plugin has to be removed, because its sensor works alone."""
    instead = (entry.get("replacement") or {}).get("sensor_type")
    return entry.get("action") == "remove" or bool(plugin.owner and instead)


def _whose(context: Context) -> str:
    return "9" if context.is_subt else "Classic"


def _later_advice(entry: dict[str, Any]) -> str:
    """Return what takes its place in a release later than Dome."""
    instead = entry.get("replacement") or {}
    if "later" in entry:
        return str(entry["later"])
    if filename := instead.get("filename"):
        library = newer_name(library_stem(filename))
        return f"use {library} ({newer_name(instead['name'])})"
    return _advice({key: value for key, value in entry.items() if key != "note"})


def _advice(entry: dict[str, Any]) -> str:
    instead = entry.get("replacement") or {}
    if sensor := instead.get("sensor_type"):
        advice = f"use a sensor of type {sensor}"
    elif filename := instead.get("filename"):
        advice = f"remove it and use {filename} ({instead['name']})"
    elif entry.get("action") == "remove":
        advice = "remove it"
    else:
        advice = "no replacement is known"
    note = entry.get("note")
    return f"{advice} ({note})" if note else advice


_WORLD = """
<sdf version="1.9">
  <world name="hall">
    <plugin filename="{}" name="{}"/>  <!-- {} -->
  </world>
</sdf>
"""
_HARMONIC = {"@profile": "gazebo-harmonic"}
_DRIVE = '<plugin filename="libgazebo_ros_diff_drive.so" name="drive"/>'
_LATER_DRIVE = '<plugin filename="gz-sim-diff-drive-system" name="gz::sim::systems::DiffDrive"/>'
_SPAWN = """<launch>
  <node pkg="robot_state_publisher" exec="robot_state_publisher">
    <param name="robot_description" type="str"
      value="$(command 'xacro $(find-pkg-share acme_rover_bringup)/urdf/rover.urdf')"/>
  </node>
  <node pkg="{}" exec="{}" args="-topic robot_description"/>
</launch>
"""
_IN_CLASSIC = _SPAWN.format("gazebo_ros", "spawn_entity.py")
_IN_GAZEBO = _SPAWN.format("ros_gz_sim", "create")


_OF_OTHER = {
    "../acme_lab/package.xml": "<package format='3'><name>acme_lab</name>"
    "<export><build_type>ament_cmake</build_type></export></package>",
    "../acme_lab/launch/c.launch.xml": _IN_GAZEBO,
}


def _rover(drive: str = _DRIVE, **launched: str) -> dict[str, object]:
    files = {f"launch/{name}.launch.xml": text for name, text in launched.items()}
    return {
        "@bridge": True,
        "@profile": "ros2",
        "launch/rover.launch.py": None,
        "urdf/rover.urdf": f'<robot name="rover"><link name="base"/><gazebo>{drive}</gazebo>\n'
        "</robot>",
        **files,
    }


_HERE = _IN_GAZEBO.replace("/>\n</launch>", "/>  <!-- ^ PLG001 -->\n</launch>")
_MARKED = f"{_DRIVE}  <!-- ^ PLG001 -->"
GOOD = [
    _rover(world=_IN_CLASSIC),
    _rover(a=_IN_CLASSIC, b=_IN_GAZEBO, drive=f"{_DRIVE}\n{_LATER_DRIVE}"),
    {"@profile": "gazebo-classic", "@fragment": _DRIVE},
    '<plugin filename="libignition-gazebo-diff-drive-system.so" name="drive"/>',
]
BAD = [
    """
<plugin filename="libgazebo_ros_control.so" name="control"/>  <!-- ^ PLG001 -->
<plugin filename="libgazebo_ros_future_thing.so" name="thing"/>  <!-- ^ PLG001 -->
""",
    """
<sensor name="imu" type="imu">
  <plugin filename="libhector_gazebo_ros_imu.so" name="imu"/>  <!-- ^ PLG001 -->
</sensor>
""",
    {**_HARMONIC, "@fragment": _WORLD.format("libgazebo_ros_state.so", "state", "^ PLG001")},
    {"@profile": "ros2", "@urdf": f"<gazebo>{_DRIVE}</gazebo>  <!-- ^ PLG001 -->"},
    _rover(a=_IN_CLASSIC, b=_IN_CLASSIC, c=_HERE),
    _rover(a=_IN_CLASSIC, b=_HERE),
    _rover(a=_IN_CLASSIC, b=_IN_GAZEBO, c=_IN_GAZEBO, drive=_MARKED),
    {**_rover(a=_IN_CLASSIC, b=_IN_CLASSIC, drive=_MARKED), **_OF_OTHER},
    _rover(
        a=_IN_CLASSIC,
        b=_IN_CLASSIC,
        c=_IN_GAZEBO,
        drive=f'{_MARKED}\n<plugin filename="gz-sim-imu-system" name="imu"/>',
    ),
]
