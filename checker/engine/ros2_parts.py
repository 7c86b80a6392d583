"""The parts of a package that ROS 2 starts: ros2_control, and what Gazebo simulates."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.parts import NotAvailable
from checker.base.record import Record
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

if TYPE_CHECKING:
    from checker.engine.subject import Subject
    from checker.model.ros.simulation import Simulations
    from checker.model.ros.spawned import SpawnedReader
    from checker.model.ros.wiring.wiring import Wiring


class Ros2Parts(Record, eq=False, dict=True):
    """What ROS 2 makes of the robots.

    Attributes:
        subject: The package under review.
    """

    subject: Subject

    @cached_property
    def controls_by_file(self) -> dict[str, RobotControl]:
        """ros2_control of the robots that have it, by the file of their description."""
        descriptions = self.subject.urdf.descriptions
        known = () if isinstance(descriptions, NotAvailable) else descriptions
        if not any(may_be_controlled(description) for description in known):
            return {}
        reader = self.control_reader
        controls = ((description.file, reader.control(description)) for description in known)
        return {file: control for file, control in controls if control is not None}

    @cached_property
    def control_reader(self) -> ControlReader:
        """Reads ros2_control of the package's robots; each file of parameters once."""
        launch = self.subject.ros2_launch
        graphs = () if isinstance(launch, NotAvailable) else launch.entries
        return ControlReader(self.subject.package, launched_files(self.subject.package, graphs))

    @property
    def launched_controls(self) -> tuple[LaunchedControl, ...] | NotAvailable:
        """What each launch file of ROS 2 does for ros2_control."""
        launch = self.subject.ros2_launch
        if isinstance(launch, NotAvailable):
            return launch
        controls = self.robot_controls
        known = () if isinstance(controls, NotAvailable) else controls
        found = tuple(launched_controls(self.control_reader, launch.entries, known))
        return found or NotAvailable("no launch file spawns a controller", applicable=False)

    @property
    def robot_controls(self) -> tuple[RobotControl, ...] | NotAvailable:
        """ros2_control of each robot that has it."""
        descriptions = self.subject.urdf.descriptions
        if isinstance(descriptions, NotAvailable):
            return descriptions
        if not self.controls_by_file:
            return NotAvailable("no robot is controlled by ros2_control", applicable=False)
        return tuple(self.controls_by_file.values())

    @cached_property
    def spawned_reader(self) -> SpawnedReader:
        """Reads the robots that launch files spawn and describe; each file once."""
        from checker.model.ros.spawned import SpawnedReader

        return SpawnedReader(self.subject.package, self.subject.expander, self.control_reader)

    @cached_property
    def simulations(self) -> Simulations | NotAvailable:
        """What the ROS 2 launch files simulate and bridge."""
        if self.subject.package.only:
            return NotAvailable("a single file has no launch files", applicable=False)
        launch = self.subject.ros2_launch
        known = None if isinstance(launch, NotAvailable) else launch
        from checker.model.ros.simulation import simulations

        found = simulations(self.subject.package, known, self.spawned_reader)
        if any(it.bridges.is_there or it.starts_gazebo or it.classic_robots for it in found.all):
            return found
        return self.subject.without_simulation

    @cached_property
    def wirings(self) -> tuple[Wiring, ...] | NotAvailable:
        """The wiring of each launch file of ROS 2."""
        launch = self.subject.ros2_launch
        if isinstance(launch, NotAvailable):
            return launch
        simulations = self.subject.simulations
        known = None if isinstance(simulations, NotAvailable) else simulations
        from checker.model.ros.wiring.wiring import wirings

        found = tuple(wirings(launch, known, self.control_reader, self.spawned_reader))
        return found or NotAvailable("no launch file starts a node", applicable=False)
