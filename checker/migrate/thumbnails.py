"""Pictures of a robot from five sides, as the SubT model repository requires."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from checker.base.parts import WorkerFailed
from checker.base.record import Record
from checker.model.robot import Robot
from checker.report.scene.builder import scene_of
from checker.report.scene.drawing.request import Shot
from checker.report.scene.mesh_files import MeshFiles, surfaces_of
from checker.report.scene.pictures import ASPECT, Drawing, shot_of
from checker.report.scene.scene import DisplayScene, Layer

_SIDES = {
    "1": (-138.0, -27.0),
    "2": (0.0, -90.0),
    "3": (-90.0, 0.0),
    "4": (180.0, 0.0),
    "5": (0.0, 0.0),
}
"""Azimuth and elevation of the line of sight, degrees: at an angle, from above, from the left, from
the front, from the rear."""


class Thumbnails(Record):
    """Pictures, or why there are none.

    Attributes:
        files: PNG files by their name without suffix.
        trouble: What the author has to do instead; empty if they were drawn.
    """

    files: Mapping[str, bytes] = {}
    trouble: str = ""


def thumbnails_of(robot: Robot) -> Thumbnails:
    """Draw a robot, without a window."""
    surfaces, drawing = surfaces_of(robot), Drawing()
    try:
        scene = scene_of(robot, None, surfaces, marked=False)
        shots = tuple(_shots(scene))
        if not shots:
            reasons = "; ".join(scene.notes) or "the model has no visuals"
            return Thumbnails(trouble=_trouble(reasons))
        drawing.give(scene, shots, "PNG")
        files = drawing.files
        if isinstance(files, WorkerFailed):
            return Thumbnails(trouble=_trouble(f"the process that draws {files.reason}"))
        return Thumbnails(dict(zip(_SIDES, files, strict=True)))
    finally:
        drawing.stop()
        if isinstance(surfaces, MeshFiles):
            surfaces.stop()


def _shots(scene: DisplayScene) -> Iterator[Shot]:
    """Yield the shots; none if no visual can be shown."""
    for name, direction in _SIDES.items():
        if shot := shot_of(scene, Layer.VISUAL, direction, ASPECT, name):
            yield shot


def _trouble(reason: str) -> str:
    return f"thumbnails/1.png to 5.png (at an angle, top, left, front, rear), not drawn: {reason}"
