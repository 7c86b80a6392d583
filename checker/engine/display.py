"""The robot of a package in 3D: its meshes are read early, then it is put together."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from contextlib import ExitStack, suppress
from functools import cached_property
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.base.cache import Cache
from checker.base.output import Stages
from checker.base.parts import part
from checker.base.record import Record
from checker.model.robot import Robot
from checker.physics.trial.trial import Trial
from checker.report.report import Display
from checker.report.scene.builder import scene_of
from checker.report.scene.glb import glb_of
from checker.report.scene.mesh_files import MeshFiles, NoSurfaces, Surfaces, surfaces_of
from checker.report.scene.pictures import ASPECT, Drawing, shots_of
from checker.report.scene.processes import NO_PROCESSES, StartedProcesses
from checker.report.scene.scene import DisplayScene, Layer

if TYPE_CHECKING:
    from checker.physics.trial.trial import Trial


# The robot and its trial for display: one animated GLB.


BYTES = 4_500_000
"""The most that a GLB takes: a report with it stays below 10 MB."""

_MARKS = (Layer.INERTIA, Layer.FRAME, Layer.JOINT, Layer.MASS, Layer.VIEW)
_SPARED: Sequence[Collection[Layer]] = (
    (),
    (Layer.COLLISION,),
    _MARKS,
    (Layer.COLLISION, *_MARKS),
    (Layer.VISUAL, *_MARKS),
    tuple(Layer),
)
"""Layers that are left out, one choice after the other, until the rest is small enough."""


def display_of(
    robot: Robot, trial: Trial | None, surfaces: Surfaces, drawing: Drawing | None = None
) -> Display | None:
    """Return the robot in 3D; None if nothing of it can be shown.

    Args:
        robot: The robot.
        trial: Its motion; None without a trial.
        surfaces: What its mesh files look like.
        drawing: Makes pictures of it, while the rest is put together; None for none.
    """
    scene = scene_of(robot, trial, surfaces)
    if not any(link.items for link in scene.links):
        return None
    if drawing is not None:
        drawing.give(scene, tuple(shots_of(scene, ASPECT)))
    for spared in _SPARED:
        glb = glb_of(without_layers(scene, spared))
        if len(glb) <= BYTES:
            left_out = tuple(f"the layer {layer} is not shown: it is too large" for layer in spared)
            pictures = drawing.pictures if drawing is not None else ()
            return Display(glb, pictures, (*scene.notes, *left_out))
    return None


def without_layers(scene: DisplayScene, layers: Collection[Layer]) -> DisplayScene:
    """Return a scene without some of its layers."""
    if not layers:
        return scene
    links = (
        replace(link, items=tuple(item for item in link.items if item.layer not in layers))
        for link in scene.links
    )
    return replace(scene, links=tuple(links))


class RobotDisplay(Record, eq=False, dict=True):
    """The first of some robots, to be shown.

    Attributes:
        robots: The robots, at least one.
        cache: The cache of results.
        stages: Called with a message when a long step starts.
        processes: Processes that wait; the caller ends them.
    """

    robots: tuple[Robot, ...]
    cache: Cache
    stages: Stages
    processes: StartedProcesses = NO_PROCESSES

    def begin(self) -> None:
        """Begin to read the meshes and to load what draws, while the caller does something else."""
        # What goes wrong is met again when the robot is put together.
        with suppress(Exception), self.stages.stage("display"):
            self._drawing.begin()
            if isinstance(self._surfaces, MeshFiles):
                self._surfaces.begin()

    def stop(self) -> None:
        """Stop the processes that still run."""
        self._drawing.stop()
        surfaces = self.__dict__.get("_surfaces")
        if isinstance(surfaces, MeshFiles):
            surfaces.stop()

    def build(self, trial: Trial | None) -> Display | None:
        """Return the robot in 3D; None if there is nothing to see.

        Args:
            trial: Its motion; None without a trial.
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
        return Drawing(self.cache, self.processes.drawing)

    @cached_property
    def _surfaces(self) -> MeshFiles | NoSurfaces:
        return surfaces_of(self.robots[0])


@part
def robot_display(
    robots: tuple[Robot, ...],
    cache: Cache,
    stages: Stages,
    processes: StartedProcesses,
    ends: ExitStack,
) -> RobotDisplay:
    """Return the display of the robots; a check that shows nothing loads none of this."""
    display = RobotDisplay(robots, cache, stages, processes)
    ends.callback(display.stop)
    return display
