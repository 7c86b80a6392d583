"""The parts of a submission to SubT, and launch files of ROS 1."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.files import NotReadable
from checker.base.parts import NotAvailable
from checker.base.record import Record
from checker.expand.spawner.emitted_xml import (
    SpawnedXml,
    StartedXml,
    WorkspaceFiles,
    emitted_xml,
)
from checker.expand.spawner.reader import Spawner, read_spawner
from checker.model.devices.devices import SensorDevices
from checker.model.devices.sensors import find_sensor_devices
from checker.model.first_configuration import FirstConfiguration
from checker.package.configuration import configuration_number, first_configuration
from checker.package.inheritance import SPAWNER, Missing
from checker.package.kind import PackageKind

if TYPE_CHECKING:
    from checker.engine.subject import Subject
    from checker.expand.launch.graph import LaunchGraph
    from checker.model.specification.sheet import Specification


class SubmissionParts(Record, eq=False, dict=True):
    """The spawner, the specification, and what both say of the robot.

    Attributes:
        subject: The package under review.
    """

    subject: Subject

    @cached_property
    def first_configuration(self) -> FirstConfiguration | NotAvailable:
        """The configuration of the same robot that has the lowest available number."""
        package = first_configuration(self.subject.package)
        if package is None:
            return NotAvailable(
                "no earlier configuration is available to compare", applicable=False
            )
        robots = self.subject.robots_of(package)
        if isinstance(robots, NotAvailable):
            return NotAvailable(f"{package.name} cannot be compared: {robots.reason}")
        return FirstConfiguration(package.name, robots[0])

    @cached_property
    def spawner(self) -> Spawner | NotAvailable:
        """The spawner, read without running it."""
        if self.subject.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAvailable("the package needs no spawner", applicable=False)
        source = self.subject.package.read(SPAWNER)
        if isinstance(source, NotReadable):
            return NotAvailable(f"{SPAWNER} {source.reason}")
        files = WorkspaceFiles(self.subject.package)
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
        from checker.expand.launch.package_launch import launch_graph

        if self.subject.package.kind is PackageKind.URDF_DESCRIPTION:
            if not self.subject.urdf.launch_entries.entries:
                return NotAvailable("the package has no launch files", applicable=False)
            return self.subject.urdf.launch_entries.graph
        return launch_graph(self.subject.package, self.started)

    @cached_property
    def specification(self) -> Specification | NotAvailable:
        """The specification sheet."""
        if self.subject.package.kind not in (PackageKind.ROBOT, PackageKind.CONFIGURATION):
            return NotAvailable("the package needs no specifications.md", applicable=False)
        part = self.subject.package.part("specifications.md")
        if isinstance(part, Missing):
            # PKG003 reports a sheet that is nowhere; one of a sibling may say anything.
            elsewhere = part.package_not_at_hand is not None
            return NotAvailable(part.reason, applicable=elsewhere)
        source = self.subject.package.read(part.path)
        if isinstance(source, NotReadable):
            return NotAvailable(f"{part.path} {source.reason}")
        from checker.model.specification.sheet import read_specification

        return read_specification(source)

    @cached_property
    def sensor_devices(self) -> SensorDevices | NotAvailable:
        """The devices that sensors stand for; without the sheet, as far as the model tells."""
        robots = self.subject.robots
        if isinstance(robots, NotAvailable):
            return robots
        sheet = None if isinstance(self.specification, NotAvailable) else self.specification
        path = self.subject.package.model_path
        numbers = {configuration_number(self.subject.package)}
        if not isinstance(path, Missing):
            numbers.add(configuration_number(path.package))
        devices = self.subject.devices
        by_robot = [find_sensor_devices(robot, devices, sheet, numbers) for robot in robots]
        known = tuple(device for each in by_robot for device in each.known)
        return SensorDevices(known, by_robot[0].diversions)
