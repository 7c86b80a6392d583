"""Parts of ROS: control of robots, and the simulations and connections of launch files."""

from __future__ import annotations

from collections.abc import Iterator

from msgspec.structs import replace

from checker.base.parts import Ask, NotAvailable, part
from checker.formats.urdf.description import UrdfDescription
from checker.formats.xacro.expansion import Expander
from checker.launch.ros1.package_launch import LaunchEntries
from checker.launch.ros2.graph import Ros2Launch
from checker.model.locomotion.controlled import without_idle
from checker.model.placed_robots import PlacedRobots, placed
from checker.model.robot import Robot
from checker.model.world import World
from checker.package.kind import PackageKind
from checker.package.package import Package
from checker.robots.parts import ControlledRobot, PlainRobots
from checker.robots.urdf_files import UrdfFiles
from checker.ros.control.controllers import ControlSystem
from checker.ros.control.launched_beside import LaunchedBeside
from checker.ros.control.loaded_parameters import Parameters, controllers_for, loaded_parameters
from checker.ros.ros2_control.launched import LaunchedControl, launched_files
from checker.ros.ros2_control.launched import launched_controls as read_launched_controls
from checker.ros.ros2_control.robot_control import (
    ConfiguredControllers,
    ControlReader,
    PluginFiles,
    RobotControl,
    may_be_controlled,
)
from checker.ros.simulation import Simulations
from checker.ros.simulation import simulations as read_simulations
from checker.ros.spawned import SpawnedReader
from checker.ros.spawned_files import SpawnedFiles
from checker.ros.wiring.wiring import Wiring, Wirings
from checker.ros.wiring.wiring import wirings as read_wirings

_YAML = (".yaml", ".yml")
"""Suffixes of files that may configure a bridge."""


@part
def control_reader(package: Package, launch: Ros2Launch | NotAvailable) -> ControlReader:
    """Return what reads ros2_control of the package's robots; each file of parameters once."""
    graphs = () if isinstance(launch, NotAvailable) else launch.entries
    return ControlReader(package, launched_files(package, graphs))


@part
def spawned_reader(package: Package, expander: Expander, control: ControlReader) -> SpawnedReader:
    """Return what reads the robots that launch files spawn and describe; each file once."""
    return SpawnedReader(package, expander, control)


@part
def spawned_files(package: Package, launch: Ros2Launch | NotAvailable) -> SpawnedFiles:
    """Return which descriptions of the package launch files put into Gazebo."""
    return SpawnedFiles(package, () if isinstance(launch, NotAvailable) else launch.entries)


@part
def robot_controls(
    descriptions: tuple[UrdfDescription, ...], files: UrdfFiles, reader: ControlReader
) -> tuple[RobotControl, ...] | NotAvailable:
    """Return ros2_control of each robot that has it."""
    found = map(reader.control, descriptions) if any(map(may_be_controlled, descriptions)) else ()
    controls = tuple(control for control in found if control is not None)
    if len(controls) == 1 and not controls[0].controllers:
        (only,) = controls
        return (replace(only, beside=reader.controllers_beside(only)),)
    return controls or NotAvailable(_without_control(files), applicable=False)


def _without_control(files: UrdfFiles) -> str:
    """Return that no robot is controlled, or the values of arguments with which one is."""
    values = next((it.values for it in files.others if may_be_controlled(it)), "")
    if not values:
        return "no robot is controlled by ros2_control"
    options = " ".join(f"--xacro-arg {value}" for value in values.split())
    return f"a robot is controlled by ros2_control only with {values}: check it with {options}"


@part
def configured_controllers(
    controls: tuple[RobotControl, ...] | NotAvailable, reader: ControlReader
) -> tuple[ConfiguredControllers, ...] | NotAvailable:
    """Return the controllers of each robot, or those of launch files if no robot can be read.

    Files of the launch that name no joint of a robot are added to the others of the launch.
    """
    if not isinstance(controls, NotAvailable):
        return tuple(_configured(controls, reader))
    files = tuple(reader.launched_files()) if controls.applicable else ()
    return (ConfiguredControllers(files),) if files else controls


def _configured(
    controls: tuple[RobotControl, ...], reader: ControlReader
) -> Iterator[ConfiguredControllers]:
    taken = {file.path for it in controls for file in it.files}
    others = tuple(it for it in reader.launched_files() if it.path not in taken)
    launched = [any(file.path in reader.launched for file in it.files) for it in controls]
    for control, is_launched in zip(controls, launched, strict=True):
        files = (*control.files, *others) if is_launched else control.files
        yield ConfiguredControllers(files, control.robot)
    if others and not any(launched):
        yield ConfiguredControllers(others)


@part
def plugin_files(
    package: Package,
    descriptions: tuple[UrdfDescription, ...] | NotAvailable,
    plain: PlainRobots | NotAvailable,
    launch: Ros2Launch | NotAvailable,
    spawned: SpawnedReader,
    reader: ControlReader,
) -> tuple[PluginFiles, ...] | NotAvailable:
    """Return the files of parameters of each robot whose plugins run a controller manager.

    These are the robots of the package, and SDF models in it that its launch files spawn.
    """
    robots = [] if isinstance(descriptions, NotAvailable) else [it.robot for it in descriptions]
    others = [] if isinstance(plain, NotAvailable) else [*plain.robots]
    if not isinstance(launch, NotAvailable) and package.index.with_suffix(".sdf"):
        others += spawned.models(launch.entries)
    # Each SDF file once; one URDF file may describe several robots.
    files = {robot.document.source.file: robot for robot in reversed(others)}
    described = {robot.document.source.file for robot in robots}
    robots += [robot for file, robot in files.items() if file not in described]
    found = tuple(each for each in map(reader.plugin_files, robots) if each.managers)
    return found or NotAvailable("no plugin runs a controller manager", applicable=False)


@part
def parameters(package: Package, entries: LaunchEntries) -> Parameters:
    """Return what configures controllers of ROS 1; each file is read once."""
    return loaded_parameters(package, entries)


@part
def controlled_robots(
    package: Package,
    descriptions: tuple[UrdfDescription, ...],
    controls: tuple[RobotControl, ...] | NotAvailable,
    reader: ControlReader,
    ask: Ask,
) -> tuple[ControlledRobot, ...] | NotAvailable:
    """Return robots with the controllers of ros2_control, or of ROS 1, that may run."""
    started = package.workspace.launch_words
    known = () if isinstance(controls, NotAvailable) else controls
    found = {
        id(it.robot): (it.robot, it.controllers or it.beside or reader.controllers_beside(it))
        for it in known
    }
    others = [it.robot for it in descriptions if it.transmissions and id(it.robot) not in found]
    # Files of parameters are read for those robots alone that need them.
    loaded = ask.one(Parameters) if others else NotAvailable("no robot has a transmission")
    if isinstance(loaded, Parameters):
        beside = LaunchedBeside(package)
        found |= {
            id(it): (it, controllers_for(it, loaded.reached) or beside.controllers(it))
            for it in others
        }
    robots = tuple(
        ControlledRobot(robot, without_idle(controllers, started))
        for robot, controllers in found.values()
    )
    return robots or NotAvailable("no robot has a controller", applicable=False)


@part
def launched_controls(
    launch: Ros2Launch,
    controls: tuple[RobotControl, ...] | NotAvailable,
    reader: ControlReader,
    spawned: SpawnedReader,
) -> tuple[LaunchedControl, ...] | NotAvailable:
    """Return what each launch file of ROS 2 does for ros2_control."""
    known = () if isinstance(controls, NotAvailable) else controls
    found = tuple(read_launched_controls(reader, launch.entries, known, spawned))
    return found or NotAvailable("no launch file spawns a controller", applicable=False)


@part
def simulations(
    package: Package, launch: Ros2Launch | NotAvailable, reader: SpawnedReader
) -> Simulations | NotAvailable:
    """Return what the ROS 2 launch files simulate and bridge."""
    known = None if isinstance(launch, NotAvailable) else launch
    paths = (entry.path.lower() for entry in package.index.files)
    if known is not None or any(path.endswith(_YAML) for path in paths):
        if package.only:
            return NotAvailable("a single file has no launch files", applicable=False)
        found = read_simulations(package, known, reader)
        if any(it.bridges.is_there or it.starts_gazebo or it.classic_robots for it in found.all):
            return found
    return NotAvailable("no launch file starts Gazebo or a bridge to it", applicable=False)


@part
def placed_robots(
    plain: PlainRobots,
    worlds: tuple[World, ...] | NotAvailable,
    simulations: Simulations | NotAvailable,
) -> PlacedRobots:
    """Return the robots in the gravity of the worlds of their file, and of launch files."""
    own = () if isinstance(worlds, NotAvailable) else worlds
    launched = () if isinstance(simulations, NotAvailable) else simulations.launched
    robots = []
    for robot in plain.robots:
        holding = (world for world in own if robot.element.parent is world.element)
        loading = (world for each in launched for world in each.worlds_of(robot))
        robots.append(placed(robot, (*holding, *loading)))
    return PlacedRobots(tuple(robots))


@part
def wirings(
    launch: Ros2Launch,
    simulations: Simulations | NotAvailable,
    control: ControlReader,
    spawned: SpawnedReader,
) -> tuple[Wiring, ...] | NotAvailable:
    """Return the wiring of each launch file of ROS 2."""
    known = None if isinstance(simulations, NotAvailable) else simulations
    found = tuple(read_wirings(launch, known, control, spawned))
    return found or NotAvailable("no launch file starts a node", applicable=False)


@part
def wirings_together(wirings: tuple[Wiring, ...]) -> Wirings:
    """Return the wiring of all launch files of ROS 2."""
    return Wirings(wirings)


@part
def control_system(
    package: Package, entries: LaunchEntries, parameters: Parameters, ask: Ask
) -> ControlSystem | NotAvailable:
    """Return what controls the joints of a URDF package."""
    alone = package.only and isinstance(ask.one(UrdfFiles), UrdfFiles)
    if package.kind is not PackageKind.URDF_DESCRIPTION and not alone:
        return NotAvailable("the package is not a URDF package", applicable=False)
    from checker.ros.control.system import control_system as read_control_system

    robots, descriptions = ask.all(Robot), ask.all(UrdfDescription)
    return read_control_system(package, entries, parameters, robots, descriptions)
