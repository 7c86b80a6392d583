"""The parts of one package, as rules ask for them; each is read once, when first asked for."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from msgspec import field
from msgspec.structs import replace

from checker.base.allowance import Allowance, Exceeded
from checker.base.cache import NO_CACHE, Cache
from checker.base.child_server import Server
from checker.base.extras import PHYSICS
from checker.base.files import NotReadable
from checker.base.output import Stages
from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.engine.run import TRIALS
from checker.model.devices.known import KnownDevices, known_devices
from checker.model.plugin_host import PluginHost, model_host, world_host
from checker.model.robot import Robot
from checker.model.sdf.document import SdfDocument
from checker.model.sdf.includes import ModelIncludes, included_model
from checker.model.sdf.links import read_plugin
from checker.model.sdf.reader import read_sdf
from checker.model.sdf.world import World, read_worlds
from checker.package.inheritance import Missing
from checker.package.kind import PackageKind
from checker.package.manifests import Paperwork
from checker.package.package import Package
from checker.physics.mesh.package_meshes import PackageMeshes, mesh_uris, picked_parts
from checker.physics.mesh.process import mesh_server
from checker.report.scene.processes import NO_PROCESSES, StartedProcesses
from checker.source.xml import XmlDocument
from checker.source.xml_positions import XmlFault

if TYPE_CHECKING:
    from checker.engine.physics_parts import PhysicsParts
    from checker.engine.ros2_parts import Ros2Parts
    from checker.engine.submission_parts import SubmissionParts
    from checker.engine.urdf_parts import UrdfParts
    from checker.expand.ros2_launch.graph import Ros2Launch
    from checker.expand.xacro.expansion import Expander
    from checker.model.ros.simulation import Simulations
    from checker.model.ros.wiring.wiring import Wiring
    from checker.model.ros2_control.launched import LaunchedControl
    from checker.model.ros2_control.robot_control import RobotControl
    from checker.model.urdf.description import UrdfDescription
    from checker.physics.mass.link_inertias import LinkInertias

T = TypeVar("T")

_YAML = (".yaml", ".yml")
"""Of files that may tell a bridge what to do."""
_BEGUN = (
    ("urdf", "package_descriptions"),
    ("physics", "trials"),
    ("physics", "display"),
    ("physics", "robot_views"),
)
"""Parts that may be under way when a check ends."""

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
        allowance: What each part, and each rule, may use.
        description: The one robot that is judged; None for those that the package has.
    """

    package: Package
    cache: Cache = NO_CACHE
    stages: Stages = field(default_factory=Stages)
    devices: KnownDevices = field(default_factory=known_devices)
    processes: StartedProcesses = NO_PROCESSES
    xacro_args: Mapping[str, str] = field(default_factory=dict)
    allowance: Allowance = field(default_factory=Allowance)
    description: UrdfDescription | None = None
    _exceeding: dict[str, NotAvailable] = field(default_factory=dict)
    _provided: dict[str, Sequence[object]] = field(default_factory=dict)

    def part(self, kind: str) -> Sequence[object] | NotAvailable:
        """Return the part whose type has this name; a file may hold several robots.

        Raises:
            LookupError: A rule asks for something that is no part of a package.
        """
        provide = _PROVIDERS.get(kind)
        if provide is None:
            raise LookupError(f"{kind} is not a part of a package")
        if kind in self._exceeding:
            return self._exceeding[kind]
        try:
            with self.allowance.piece():
                had = provide(self)
        except Exceeded as exceeded:
            had = NotAvailable(f"{_words(kind)} cannot be had: it {exceeded.reason}")
            self._exceeding[kind] = had
        if isinstance(had, NotAvailable):
            return had
        self._provided[kind] = had if isinstance(had, tuple) else (had,)
        return self._provided[kind]

    def provided(self, kind: type[T]) -> Sequence[T]:
        """Return a part that some rule had; nothing when none asked for it or it is missing."""
        return [item for item in self._provided.get(kind.__name__, ()) if isinstance(item, kind)]

    def start(self, kinds: Collection[str]) -> None:
        """Begin with parts that take long, so that they come about while the rules run."""
        twice = "RepeatedTrial" in kinds
        driven = not TRIALS.isdisjoint(kinds)
        if PHYSICS.is_installed:
            if driven or "MassProperties" in kinds:
                self._begin_meshes()
            if driven and not isinstance(self.physics.trials, NotAvailable):
                self.physics.trials.begin(twice=twice)
            if "SensorViews" in kinds and not isinstance(self.physics.robot_views, NotAvailable):
                self.physics.robot_views.begin()
        if not {"UrdfFiles", "UrdfDescription"}.isdisjoint(kinds):
            _ = self.urdf.package_descriptions

    def start_meshes(self) -> None:
        """Begin to read the robot's meshes; what goes wrong is met again by who asks for it."""
        with suppress(Exception, Exceeded), self.allowance.piece():
            if PHYSICS.is_installed:
                self._begin_meshes()

    def start_display(self) -> None:
        """Begin to draw the robot."""
        if PHYSICS.is_installed and not isinstance(self.physics.display, NotAvailable):
            self.physics.display.begin()

    def _begin_meshes(self) -> None:
        meshes = self.robots[0].meshes if isinstance(self.robots, tuple) else None
        if isinstance(meshes, PackageMeshes):
            meshes.begin()

    def close(self) -> None:
        """End what was begun and nobody asked for."""
        self.processes.stop()
        self.mesh_server.stop()
        if "expander" in vars(self):
            self.expander.server.stop()
        robots = vars(self).get("robots")
        for robot in robots if isinstance(robots, tuple) else ():
            if isinstance(robot.meshes, PackageMeshes):
                robot.meshes.stop()
        for group, name in _BEGUN:
            value = vars(vars(self)[group]).get(name) if group in vars(self) else None
            if value is not None and not isinstance(value, NotAvailable):
                value.stop()

    # What few packages have, or few checks ask for, is loaded when it is asked for.

    @cached_property
    def urdf(self) -> UrdfParts:
        """What URDF files describe."""
        from checker.engine.urdf_parts import UrdfParts

        return UrdfParts(self)

    @cached_property
    def ros2(self) -> Ros2Parts:
        """What ROS 2 makes of the robots."""
        from checker.engine.ros2_parts import Ros2Parts

        return Ros2Parts(self)

    @cached_property
    def submission(self) -> SubmissionParts:
        """The spawner, the specification, and what both say of the robot."""
        from checker.engine.submission_parts import SubmissionParts

        return SubmissionParts(self)

    @cached_property
    def physics(self) -> PhysicsParts:
        """What is measured of the robots."""
        from checker.engine.physics_parts import PhysicsParts

        return PhysicsParts(self)

    def of(self, package: Package) -> Subject:
        """Return the same of another state of the package."""
        return replace(self, package=package, _provided={}, _exceeding={})

    def with_only(self, description: UrdfDescription) -> Subject:
        """Return the same with one robot, which another value of an argument makes."""
        other = replace(self, description=description, _provided={}, _exceeding={})
        shared = ("ros2_launch", "expander", "mesh_server", "paperwork")
        vars(other).update({name: vars(self)[name] for name in shared if name in vars(self)})
        return other

    def robots_of(self, other: Package) -> tuple[Robot, ...] | NotAvailable:
        """Return the robots of another package, to compare with."""
        subject = Subject(other)
        try:
            return subject._read_robots()
        finally:
            subject.close()

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
        descriptions = self.urdf.descriptions
        return descriptions if isinstance(descriptions, NotAvailable) else descriptions[0].document

    def document(self, path: str) -> XmlDocument | NotAvailable:
        """Return a file as XML, or say why it cannot be had."""
        document = self.package.xml(path)
        if isinstance(document, XmlFault):
            return NotAvailable(f"{path} is not well-formed")
        if isinstance(document, NotReadable):
            return NotAvailable(f"{path} {document.reason}")
        if document.root.tag == "sdf" and path.lower().endswith(".xacro"):
            from checker.model.sdf.expanded import expanded_model

            return expanded_model(self.package, path, self.expander)
        return document

    @cached_property
    def link_inertias(self) -> tuple[LinkInertias, ...] | NotAvailable:
        """The inertia of each link, as written."""
        if isinstance(self.robots, NotAvailable):
            return self.robots
        from checker.physics.mass.link_inertias import link_inertias

        return tuple(map(link_inertias, self.robots))

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

    @cached_property
    def expander(self) -> Expander:
        """What expands xacro files; its process is started when there is one to expand."""
        from checker.expand.xacro.expansion import Expander, xacro_server

        return Expander(self.cache, self.processes.xacro or xacro_server())

    def _read_robots(self) -> tuple[Robot, ...] | NotAvailable:
        """Return the robot with the plugins that the spawner adds; of a lone file all robots."""
        if isinstance(self.model, NotAvailable):
            return self.model
        if self.model.root.tag == "robot":
            descriptions = self.urdf.descriptions
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
        control = self.ros2.controls_by_file.get(description.file)
        robot = description.robot
        if control is None:
            return robot
        from checker.model.locomotion.controlled import without_idle

        words = self.package.workspace.launch_words
        return replace(robot, controllers=without_idle(control.controllers, words))

    def _with_spawned_plugins(self, robot: Robot) -> Robot:
        if isinstance(self.submission.spawned, NotAvailable):
            unread = self.submission.spawned.reason if self.submission.spawned.applicable else ""
            return replace(robot, unread_plugins=unread)
        added = (read_plugin(element) for element in self.submission.spawned.plugins)
        return replace(robot, plugins=(*robot.plugins, *added))

    @cached_property
    def ros2_launch(self) -> Ros2Launch | NotAvailable:
        """What the ROS 2 launch files of the package start."""
        from checker.expand.ros2_launch.package_launch import ros2_launch

        return ros2_launch(self.package)

    @property
    def simulations(self) -> Simulations | NotAvailable:
        """What the ROS 2 launch files simulate and bridge."""
        files = (entry.path.lower() for entry in self.package.index.files)
        without = isinstance(self.ros2_launch, NotAvailable)
        if without and not any(path.endswith(_YAML) for path in files):
            return self.without_simulation
        return self.ros2.simulations

    @property
    def wirings(self) -> tuple[Wiring, ...] | NotAvailable:
        """The wiring of each launch file of ROS 2."""
        launch = self.ros2_launch
        return launch if isinstance(launch, NotAvailable) else self.ros2.wirings

    @property
    def without_simulation(self) -> NotAvailable:
        """Why there is nothing to say of a simulation."""
        reason = "no launch file starts Gazebo or a bridge to it"
        return NotAvailable(reason, applicable=False)

    @property
    def robot_controls(self) -> tuple[RobotControl, ...] | NotAvailable:
        """ros2_control of each robot that has it."""
        descriptions = self.urdf.descriptions
        return descriptions if isinstance(descriptions, NotAvailable) else self.ros2.robot_controls

    @property
    def launched_controls(self) -> tuple[LaunchedControl, ...] | NotAvailable:
        """What each launch file of ROS 2 does for ros2_control."""
        launch = self.ros2_launch
        return launch if isinstance(launch, NotAvailable) else self.ros2.launched_controls


def _words(kind: str) -> str:
    """Return the name of a part's type as words: "the launch graph"."""
    return f"the {re.sub('(?<!^)(?=[A-Z])', ' ', kind).lower()}"


_PROVIDERS: dict[str, Callable[[Subject], object]] = {
    "Package": lambda subject: subject.package,
    "Paperwork": lambda subject: subject.paperwork,
    "SdfDocument": lambda subject: subject.sdf,
    "World": lambda subject: subject.worlds,
    "PluginHost": lambda subject: subject.plugin_hosts,
    "Robot": lambda subject: subject.robots,
    "FirstConfiguration": lambda subject: subject.submission.first_configuration,
    "LinkInertias": lambda subject: subject.link_inertias,
    "MassProperties": lambda subject: subject.physics.masses,
    "RobotTrial": lambda subject: subject.physics.driven,
    "SettledTrial": lambda subject: subject.physics.settled,
    "RepeatedTrial": lambda subject: subject.physics.driven_twice,
    "Spawner": lambda subject: subject.submission.spawner,
    "SpawnedXml": lambda subject: subject.submission.spawned,
    "StartedXml": lambda subject: subject.submission.started,
    "LaunchGraph": lambda subject: subject.submission.launch,
    "Ros2Launch": lambda subject: subject.ros2_launch,
    "Simulations": lambda subject: subject.simulations,
    "Wiring": lambda subject: subject.wirings,
    "ControlSystem": lambda subject: subject.urdf.control,
    "RobotControl": lambda subject: subject.robot_controls,
    "LaunchedControl": lambda subject: subject.launched_controls,
    "Specification": lambda subject: subject.submission.specification,
    "UrdfDescription": lambda subject: subject.urdf.descriptions,
    "UrdfFiles": lambda subject: subject.urdf.files,
    "KnownDevices": lambda subject: subject.devices,
    "SensorDevices": lambda subject: subject.submission.sensor_devices,
    "SensorViews": lambda subject: subject.physics.views,
}
