"""The robot of a package in 3D: its meshes are read early, then it is put together."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from functools import cached_property

from checker.cache import Cache
from checker.display.display import display_of
from checker.display.early import NO_CHILDREN, EarlyChildren
from checker.display.mesh_files import MeshFiles, surfaces_of
from checker.display.pictures import Drawing
from checker.display.surface import NoSurfaces
from checker.mesh.package_meshes import TimedMeshes
from checker.model.robot import Robot
from checker.record import record
from checker.report.report import Display
from checker.saying import Stages
from checker.trial.trial import Trial


@record(eq=False)
class Displaying:
    """The first of some robots, to be shown.

    Attributes:
        robots: At least one.
        cache: Where results are kept.
        stages: Told of what takes long.
        early: Children that wait; whoever has started them ends them.
    """

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages
    early: EarlyChildren = NO_CHILDREN

    def begin(self) -> None:
        """Begin to read the meshes and to load what draws, while the caller does something else."""
        # What goes wrong is met again when the robot is put together.
        with suppress(Exception), self.stages.stage("display"):
            self._drawing.begin()
            if isinstance(self._surfaces, MeshFiles):
                self._surfaces.begin()

    def stop(self) -> None:
        """End what nobody has waited for."""
        self._drawing.stop()
        surfaces = self.__dict__.get("_surfaces")
        if isinstance(surfaces, MeshFiles):
            surfaces.stop()

    def made(self, trial: Trial | None) -> Display | None:
        """Return the robot in 3D; None where there is nothing to see.

        Args:
            trial: How it moved; None without a trial.
        """
        with self.stages.stage("display", "drawing the robot"):
            display = display_of(self.robots[0], trial, self._surfaces, self._drawing)
        count = len(self.robots)
        if display is None or count == 1:
            return display
        return replace(
            display, notes=(f"of {count} robots only the first is shown", *display.notes)
        )

    @cached_property
    def _drawing(self) -> Drawing:
        return Drawing(self.cache, self.early.artist)

    @cached_property
    def _surfaces(self) -> MeshFiles | NoSurfaces:
        robot = self.robots[0]
        meshes = robot.meshes
        if isinstance(meshes, TimedMeshes):
            return surfaces_of(meshes.meshes, robot, self.cache, self.early.looks)
        return NoSurfaces()
