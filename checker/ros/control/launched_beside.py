"""Controllers of ROS 1 that the launch files of other packages load beside a package's robot."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import islice

from checker.base.record import Record
from checker.launch.ros1.expansion import expand_launch
from checker.launch.ros1.graph import LaunchGraph
from checker.launch.ros1.package_launch import MAX_FILES, LaunchFiles
from checker.model.controllers import Controller
from checker.model.robot import Robot
from checker.package.detected_target import launching
from checker.package.package import Package
from checker.ros.control.loaded_parameters import Parameters, controllers_for
from checker.ros.robot_description import robot_descriptions
from checker.source.xml import XmlDocument


class LaunchedBeside(Record, eq=False, dict=True):
    """Launch files of other packages that load robots of a package."""

    package: Package

    def controllers(self, robot: Robot) -> tuple[Controller, ...]:
        """Return the controllers that launch files load together with a robot."""
        parameters = Parameters(self.package)
        for graph in self._graphs:
            if robot.document.source.file in self._described(graph):
                parameters.load(graph)
        return controllers_for(robot, parameters.reached)

    @cached_property
    def _graphs(self) -> tuple[LaunchGraph, ...]:
        documents = (
            self.package.xml(f"../{other.name}/{path}")
            for other in launching(self.package)
            for path in other.launch_texts
            if path.endswith(".launch")
        )
        known = (it for it in documents if isinstance(it, XmlDocument))
        files = LaunchFiles(self.package)
        return tuple(expand_launch(it, {}, files) for it in islice(known, MAX_FILES))

    def _described(self, graph: LaunchGraph) -> Iterator[str]:
        """Yield the files of this package that are the robot's description."""
        for description in robot_descriptions(graph):
            own = (it for it in description.files if self.package.named(it.package) is self.package)
            yield from (it.path for it in own)
