"""The parts of one package, as rules ask for them; each is read once, when first asked for."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from msgspec import field
from msgspec.structs import replace

from checker.base.cache import NO_CACHE, Cache
from checker.base.child_server import Server
from checker.base.files import NotReadable
from checker.base.output import Stages
from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.expand.launch.graph import LaunchGraph
from checker.expand.launch.package_launch import LaunchEntries, launch_entries, launch_graph
from checker.expand.ros2_launch.graph import Ros2Launch
from checker.expand.spawner.emitted_xml import (
    SpawnedXml,
    StartedXml,
    WorkspaceFiles,
    emitted_xml,
)
from checker.expand.spawner.reader import Spawner, read_spawner
from checker.model.control.controllers import ControlSystem
from checker.model.control.system import control_system
from checker.model.devices.devices import SensorDevices
from checker.model.devices.known import KnownDevices, known_devices
from checker.model.devices.sensors import find_sensor_devices
from checker.model.first_configuration import FirstConfiguration
from checker.model.plugin_host import PluginHost, model_host, world_host
from checker.model.robot import Robot
from checker.model.ros.simulation import Simulations, simulations
from checker.model.ros2_control.launched import (
    LaunchedControl,
    launched_controls,
    launched_files,
)
from checker.model.ros2_control.robot_control import (
    ControlReader,
    RobotControl,
    may_be_controlled,
)
from checker.model.sdf.document import SdfDocument
from checker.model.sdf.expanded import SUFFIX, expanded_model
from checker.model.sdf.includes import ModelIncludes, included_model
from checker.model.sdf.links import read_plugin
from checker.model.sdf.reader import read_sdf
from checker.model.sdf.world import World, read_worlds
from checker.model.sensing.view import SensorViews
from checker.model.specification.sheet import Specification, read_specification
from checker.model.urdf.description import UrdfDescription
from checker.model.urdf.files import UrdfFiles
from checker.model.urdf.package_descriptions import PackageDescriptions
from checker.package.configuration import configuration_number, first_configuration
from checker.package.inheritance import SPAWNER, Missing
from checker.package.kind import PackageKind
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.physics.mass.mass_properties import MassProperties
from checker.physics.mass.robot_mass import weigh
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris, picked_parts
from checker.physics.mesh.process import mesh_server
from checker.physics.trial.robot_trial import RepeatedTrial, RobotTrial, SettledTrial
from checker.physics.trial.run import RobotTrials
from checker.physics.trial.settling import unrest_of
from checker.physics.views.sensor_views import RobotViews
from checker.report.scene.processes import NO_PROCESSES, StartedProcesses
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

if TYPE_CHECKING:
    from checker.engine.display import RobotDisplay

T = TypeVar("T")

_WITHOUT_ROBOT = {
    PackageKind.PLUGIN: "the package only carries a plugin",
    PackageKind.UNKNOWN: "the package contains no robot",
}


class Subject(Record, eq=False, dict=True):
    """One package under review.

    Attributes:
        package: Its files.
        cache: Where results that take long are kept.
        stages: Told of what takes long.
        devices: Sensor devices of which figures are known.
        processes: Processes that wait for something to do.
        xacro_args: Arguments for xacro, before those that launch files give.
    """

    package: Package
    cache: Cache = NO_CACHE
    stages: Stages = field(default_factory=Stages)
    devices: KnownDevices = field(default_factory=known_devices)
    processes: StartedProcesses = NO_PROCESSES
    xacro_args: Mapping[str, str] = field(default_factory=dict)
    _provided: dict[type, Sequence[object]] = field(default_factory=dict)

    def part(self, kind: type) -> Sequence[object] | NotAvailable:
        """Return the part that is an instance of `kind`; a file may hold several robots.

        Raises:
            LookupError: A rule asks for something that is no part of a package.
        """
        provide = _PROVIDERS.get(kind)
        if provide is None:
            raise LookupError(f"{kind.__name__} is not a part of a package")
        had = provide(self)
        if isinstance(had, NotAvailable):
            return had
        self._provided[kind] = had if isinstance(had, tuple) else (had,)
        return self._provided[kind]

    def provided(self, kind: type[T]) -> Sequence[T]:
        """Return a part that some rule had; nothing when none asked for it or it is missing."""
        return [item for item in self._provided.get(kind, ()) if isinstance(item, kind)]

    def start(self, kinds: Collection[type]) -> None:
        """Begin with parts that take long, so that they come about while the rules run."""
        twice = RepeatedTrial in kinds
        driven = twice or any(issubclass(kind, RobotTrial) for kind in kinds)
        if driven or MassProperties in kinds:
            self._begin_meshes()
        if driven and not isinstance(self.trials, NotAvailable):
            self.trials.begin(twice=twice)
        if SensorViews in kinds and not isinstance(self.robot_views, NotAvailable):
            self.robot_views.begin()
        if UrdfFiles in kinds or UrdfDescription in kinds:
            _ = self.package_descriptions

    def start_meshes(self) -> None:
        """Begin to read the robot's meshes; what goes wrong is met again by who asks for it."""
        with suppress(Exception):
            self._begin_meshes()

    def _begin_meshes(self) -> None:
        meshes = self.robots[0].meshes if isinstance(self.robots, tuple) else None
        if isinstance(meshes, PackageMeshes):
            meshes.begin()

    def close(self) -> None:
        """End what was begun and nobody asked for."""
        self.processes.stop()
        self.mesh_server.stop()
        robots = self.__dict__.get("robots")
        for robot in robots if isinstance(robots, tuple) else ():
            if isinstance(robot.meshes, PackageMeshes):
                robot.meshes.stop()
        names = ("trials", "package_descriptions", "display", "robot_views")
        for value in map(self.__dict__.get, names):
            if value is not None and not isinstance(value, NotAvailable):
                value.stop()

    @cached_property
    def paperwork(self) -> Paperwork:
        """What the package's own papers say."""
        return Paperwork(self.package)

    @cached_property
    def model(self) -> XmlDocument | NotAvailable:
        """The model file."""
        without = _WITHOUT_ROBOT.get(self.package.kind)
        if without is not None:
            return NotAvailable(without, applicable=False)
        if self.package.kind is PackageKind.URDF_DESCRIPTION:
            return self._urdf
        path = self.package.model_path
        if isinstance(path, Missing):
            return NotAvailable(path.reason)
        document = self.document(path.path)
        if isinstance(document, XmlDocument) and document.root.tag == "robot":
            return self._urdf if self.package.only else document
        return document

    @property
    def _urdf(self) -> XmlDocument | NotAvailable:
        """The first description of a URDF package, or of a file."""
        descriptions = self.descriptions
        return descriptions if isinstance(descriptions, NotAvailable) else descriptions[0].document

    @cached_property
    def package_descriptions(self) -> PackageDescriptions:
        """The URDF files that stand for a robot, as they are being expanded."""
        launch = self.ros2_launch
        ros2 = None if isinstance(launch, NotAvailable) else launch
        return PackageDescriptions(self.package, self.cache, args=self.xacro_args, ros2=ros2)

    @property
    def urdf_files(self) -> UrdfFiles | NotAvailable:
        """What became of the URDF files."""
        if not self.package_descriptions.applicable:
            return NotAvailable("no URDF file is a robot", applicable=False)
        return self.package_descriptions.files

    @cached_property
    def descriptions(self) -> tuple[UrdfDescription, ...] | NotAvailable:
        """The robots that URDF files describe."""
        files = self.urdf_files
        if isinstance(files, NotAvailable) or files.descriptions:
            return files if isinstance(files, NotAvailable) else files.descriptions
        wrong = [f"{fault.file} cannot be expanded" for fault in files.faults]
        reasons = [*wrong, *files.unread]
        reason = next(iter((*reasons, *files.set_aside)), "the URDF files contain no robot")
        return NotAvailable(reason, applicable=bool(reasons))

    def document(self, path: str) -> XmlDocument | NotAvailable:
        """Return a file as XML, or say why it cannot be had."""
        document = self.package.xml(path)
        if isinstance(document, XmlFault):
            return NotAvailable(f"{path} is not well-formed")
        if isinstance(document, NotReadable):
            return NotAvailable(f"{path} {document.reason}")
        if document.root.tag == "sdf" and path.lower().endswith(SUFFIX):
            return expanded_model(self.package, path, self.cache)
        return document

    @cached_property
    def sdf(self) -> SdfDocument | NotAvailable:
        """The model file as SDF."""
        if isinstance(self.model, NotAvailable):
            return self.model
        if self.model.root.tag == "robot":
            return NotAvailable("the model is a URDF file", applicable=False)
        return SdfDocument(self.model, (self.model.root.get("version") or "").strip())

    @cached_property
    def worlds(self) -> tuple[World, ...] | NotAvailable:
        """The worlds of the model file."""
        if isinstance(self.sdf, NotAvailable):
            return NotAvailable(self.sdf.reason, applicable=self.package.kind is PackageKind.WORLD)
        worlds = read_worlds(self.sdf.document, ModelIncludes(self.package))
        return worlds or NotAvailable("the file contains no world", applicable=False)

    @property
    def plugin_hosts(self) -> tuple[PluginHost, ...] | NotAvailable:
        """What loads plugins: the robots, and the worlds of the model file."""
        robots, worlds = self.robots, self.worlds
        hosts = () if isinstance(worlds, NotAvailable) else tuple(map(world_host, worlds))
        if isinstance(robots, NotAvailable):
            return hosts or robots
        return (*map(model_host, robots), *hosts)

    @cached_property
    def robots(self) -> tuple[Robot, ...] | NotAvailable:
        """The robots of the package with their meshes."""
        robots = self._read_robots()
        if isinstance(robots, NotAvailable):
            return robots
        return tuple(replace(robot, meshes=self._meshes(robot)) for robot in robots)

    def _meshes(self, robot: Robot) -> PackageMeshes:
        uris, picks, server = mesh_uris(robot), picked_parts(robot), self.mesh_server
        return PackageMeshes(self.package, uris, self.cache, self.stages, server, picks)

    @cached_property
    def mesh_server(self) -> Server:
        """The process that reads mesh files; it is started when there is one to read."""
        return self.processes.meshes or mesh_server()

    def _read_robots(self) -> tuple[Robot, ...] | NotAvailable:
        """Return the robot with the plugins that the spawner adds; of a lone file all robots."""
        if isinstance(self.model, NotAvailable):
            return self.model
        if self.model.root.tag == "robot":
            descriptions = self.descriptions
            return (
                descriptions
                if isinstance(descriptions, NotAvailable)
                else tuple(map(self._controlled, descriptions))
            )
        robots = read_sdf(self.model, ModelIncludes(self.package))
        if self.package.kind is PackageKind.WORLD:
            robots = tuple(robot for robot in robots if not robot.is_static)
        if not self.package.only:
            robots = robots[:1]
        if not robots:
            nothing_to_see = self.model.root.child("world") is not None
            kind = "model that moves" if nothing_to_see else "model"
            reason = f"{self.model.source.file} contains no {kind}"
            if (placed := self.model.root.child("include")) is not None:
                missing = included_model(placed, ModelIncludes(self.package))
                reason = missing if isinstance(missing, str) else reason
            return NotAvailable(reason, applicable=not nothing_to_see)
        return (self._with_spawned_plugins(robots[0]), *robots[1:])

    def _controlled(self, description: UrdfDescription) -> Robot:
        """Return the robot of a description with its controllers."""
        control = self.controls_by_file.get(description.file)
        robot = description.robot
        return robot if control is None else replace(robot, controllers=control.controllers)

    @cached_property
    def controls_by_file(self) -> dict[str, RobotControl]:
        """ros2_control of the robots that have it, by the file of their description."""
        descriptions = self.descriptions
        known = () if isinstance(descriptions, NotAvailable) else descriptions
        if not any(may_be_controlled(description) for description in known):
            return {}
        reader = self.control_reader
        controls = ((description.file, reader.control(description)) for description in known)
        return {file: control for file, control in controls if control is not None}

    @cached_property
    def control_reader(self) -> ControlReader:
        """Reads ros2_control of the package's robots; each file of parameters once."""
        graphs = () if isinstance(self.ros2_launch, NotAvailable) else self.ros2_launch.entries
        return ControlReader(self.package, launched_files(self.package, graphs))

    @property
    def launched_controls(self) -> tuple[LaunchedControl, ...] | NotAvailable:
        """What each launch file of ROS 2 does for ros2_control."""
        if isinstance(self.ros2_launch, NotAvailable):
            return self.ros2_launch
        controls = () if isinstance(self.descriptions, NotAvailable) else self.robot_controls
        known = () if isinstance(controls, NotAvailable) else controls
        found = tuple(launched_controls(self.control_reader, self.ros2_launch.entries, known))
        return found or NotAvailable("no launch file spawns a controller", applicable=False)

    @property
    def robot_controls(self) -> tuple[RobotControl, ...] | NotAvailable:
        """ros2_control of each robot that has it."""
        if isinstance(self.descriptions, NotAvailable):
            return self.descriptions
        if not self.controls_by_file:
            return NotAvailable("no robot is controlled by ros2_control", applicable=False)
        return tuple(self.controls_by_file.values())

    def _with_spawned_plugins(self, robot: Robot) -> Robot:
        if isinstance(self.spawned, NotAvailable):
            unread = self.spawned.reason if self.spawned.applicable else ""
            return replace(robot, unread_plugins=unread)
        added = (read_plugin(element) for element in self.spawned.plugins)
        return replace(robot, plugins=(*robot.plugins, *added))

    @cached_property
    def masses(self) -> tuple[MassProperties, ...] | NotAvailable:
        """The robots as Pinocchio weighs them."""
        if isinstance(self.robots, NotAvailable):
            return self.robots
        with self.stages.stage("weigh"):
            return tuple(weigh(robot, self.cache) for robot in self.robots)

    @cached_property
    def first_configuration(self) -> FirstConfiguration | NotAvailable:
        """The configuration of the same robot that has the lowest available number."""
        package = first_configuration(self.package)
        if package is None:
            return NotAvailable(
                "no earlier configuration is available to compare", applicable=False
            )
        robots = Subject(package)._read_robots()
        if isinstance(robots, NotAvailable):
            return NotAvailable(f"{package.name} cannot be compared: {robots.reason}")
        return FirstConfiguration(package.name, robots[0])

    @cached_property
    def trials(self) -> RobotTrials | NotAvailable:
        """The trials of the robots."""
        if isinstance(self.robots, NotAvailable):
            return self.robots
        return RobotTrials(self.robots, self.cache, self.stages)

    @property
    def undriven(self) -> Mapping[int, str]:
        """Why robots have no trial, by their number; nothing where no rule asked for one."""
        trials = self.__dict__.get("trials")
        return trials.undriven if isinstance(trials, RobotTrials) else {}

    @property
    def driven(self) -> tuple[RobotTrial, ...] | NotAvailable:
        """The robots and their trials."""
        return self.trials if isinstance(self.trials, NotAvailable) else self.trials.once

    @property
    def settled(self) -> tuple[SettledTrial, ...] | NotAvailable:
        """Those of them that come to rest before they drive."""
        # Whoever asks for these has the figures shown, too.
        self.part(RobotTrial)
        driven = self.driven
        if isinstance(driven, NotAvailable):
            return driven
        reasons = [
            each.unlike or each.robot.stuck_wheel or unrest_of(each.trial) for each in driven
        ]
        fit = [each for each, reason in zip(driven, reasons, strict=True) if not reason]
        unfit = next(filter(None, reasons), "")
        if not fit:
            return NotAvailable(unfit)
        first, *others = (SettledTrial(each.robot, each.trial) for each in fit)
        return (replace(first, others=unfit), *others)

    @property
    def driven_twice(self) -> tuple[RepeatedTrial, ...] | NotAvailable:
        """The robots and their trials, also at half the time step."""
        return self.trials if isinstance(self.trials, NotAvailable) else self.trials.twice

    @cached_property
    def display(self) -> RobotDisplay | NotAvailable:
        """The robot in 3D; a check that shows nothing loads none of the modules behind it."""
        from checker.engine.display import RobotDisplay

        had = self.robots
        if isinstance(had, NotAvailable):
            return had
        return RobotDisplay(had, self.cache, self.stages, self.processes)

    @cached_property
    def robot_views(self) -> RobotViews | NotAvailable:
        """The views of the robots' sensors."""
        if isinstance(self.robots, NotAvailable):
            return self.robots
        return RobotViews(self.robots, self.cache, self.stages, self.mesh_server)

    @property
    def views(self) -> tuple[SensorViews, ...] | NotAvailable:
        """The robots and what of themselves their sensors see."""
        return (
            self.robot_views
            if isinstance(self.robot_views, NotAvailable)
            else self.robot_views.views
        )

    @cached_property
    def spawner(self) -> Spawner | NotAvailable:
        """The spawner, read without running it."""
        if self.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAvailable("the package needs no spawner", applicable=False)
        source = self.package.read(SPAWNER)
        if isinstance(source, NotReadable):
            return NotAvailable(f"{SPAWNER} {source.reason}")
        files = WorkspaceFiles(self.package)
        return read_spawner(files, files.entry, source)

    @cached_property
    def spawned(self) -> SpawnedXml | NotAvailable:
        """What the function `spawner` emits."""
        if isinstance(self.spawner, NotAvailable):
            return self.spawner
        return emitted_xml(SpawnedXml, "spawner", self.spawner.spawn)

    @cached_property
    def started(self) -> StartedXml | NotAvailable:
        """What the function `rosExecutables` emits."""
        if isinstance(self.spawner, NotAvailable):
            return self.spawner
        return emitted_xml(StartedXml, "rosExecutables", self.spawner.executables)

    @cached_property
    def launch(self) -> LaunchGraph | NotAvailable:
        """What the launch files start that the spawner calls for; of a URDF package, all."""
        if self.package.kind is PackageKind.URDF_DESCRIPTION:
            if not self.launch_entries.entries:
                return NotAvailable("the package has no launch files", applicable=False)
            return self.launch_entries.graph
        return launch_graph(self.package, self.started)

    @cached_property
    def ros2_launch(self) -> Ros2Launch | NotAvailable:
        """What the ROS 2 launch files of the package start."""
        # Few packages have such files; the others need not load what evaluates them.
        from checker.expand.ros2_launch.package_launch import ros2_launch

        return ros2_launch(self.package)

    @cached_property
    def simulations(self) -> Simulations | NotAvailable:
        """What the ROS 2 launch files simulate and bridge."""
        if self.package.only:
            return NotAvailable("a single file has no launch files", applicable=False)
        launch = self.ros2_launch
        known = None if isinstance(launch, NotAvailable) else launch
        found = simulations(self.package, known, self.cache, self.control_reader)
        if any(each.bridges.is_there or each.starts_gazebo for each in found.all):
            return found
        return NotAvailable("no launch file starts Gazebo or a bridge to it", applicable=False)

    @cached_property
    def launch_entries(self) -> LaunchEntries:
        """The launch files that a URDF package can be started with."""
        if self.package.kind is not PackageKind.URDF_DESCRIPTION:
            return LaunchEntries()
        return launch_entries(self.package)

    @cached_property
    def control(self) -> ControlSystem | NotAvailable:
        """What controls the joints of a URDF package."""
        alone = self.package.only and self.package_descriptions.applicable
        if self.package.kind is not PackageKind.URDF_DESCRIPTION and not alone:
            return NotAvailable("the package is not a URDF package", applicable=False)
        return control_system(self.package, self.launch_entries, self.robots, self.descriptions)

    @cached_property
    def specification(self) -> Specification | NotAvailable:
        """The specification sheet."""
        if self.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAvailable("the package needs no specifications.md", applicable=False)
        part = self.package.part("specifications.md")
        if isinstance(part, Missing):
            # PKG003 reports a sheet that is nowhere; one of a sibling may say anything.
            elsewhere = part.package_not_at_hand is not None
            return NotAvailable(part.reason, applicable=elsewhere)
        source = self.package.read(part.path)
        if isinstance(source, NotReadable):
            return NotAvailable(f"{part.path} {source.reason}")
        return read_specification(source)

    @cached_property
    def sensor_devices(self) -> SensorDevices | NotAvailable:
        """The devices that sensors stand for; without the sheet, as far as the model tells."""
        if isinstance(self.robots, NotAvailable):
            return self.robots
        sheet = None if isinstance(self.specification, NotAvailable) else self.specification
        path = self.package.model_path
        numbers = {configuration_number(self.package)}
        if not isinstance(path, Missing):
            numbers.add(configuration_number(path.package))
        by_robot = [
            find_sensor_devices(robot, self.devices, sheet, numbers) for robot in self.robots
        ]
        known = tuple(device for devices in by_robot for device in devices.known)
        return SensorDevices(known, by_robot[0].diversions)


_PROVIDERS: dict[type, Callable[[Subject], object]] = {
    Package: lambda subject: subject.package,
    Paperwork: lambda subject: subject.paperwork,
    SdfDocument: lambda subject: subject.sdf,
    World: lambda subject: subject.worlds,
    PluginHost: lambda subject: subject.plugin_hosts,
    Robot: lambda subject: subject.robots,
    FirstConfiguration: lambda subject: subject.first_configuration,
    MassProperties: lambda subject: subject.masses,
    RobotTrial: lambda subject: subject.driven,
    SettledTrial: lambda subject: subject.settled,
    RepeatedTrial: lambda subject: subject.driven_twice,
    Spawner: lambda subject: subject.spawner,
    SpawnedXml: lambda subject: subject.spawned,
    StartedXml: lambda subject: subject.started,
    LaunchGraph: lambda subject: subject.launch,
    Ros2Launch: lambda subject: subject.ros2_launch,
    Simulations: lambda subject: subject.simulations,
    ControlSystem: lambda subject: subject.control,
    RobotControl: lambda subject: subject.robot_controls,
    LaunchedControl: lambda subject: subject.launched_controls,
    Specification: lambda subject: subject.specification,
    UrdfDescription: lambda subject: subject.descriptions,
    UrdfFiles: lambda subject: subject.urdf_files,
    KnownDevices: lambda subject: subject.devices,
    SensorDevices: lambda subject: subject.sensor_devices,
    SensorViews: lambda subject: subject.views,
}
