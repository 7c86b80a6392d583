"""The robot and its trial for those who look: one animated GLB."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from checker.display.building import scene_of
from checker.display.glb import glb_of
from checker.display.pictures import Drawing
from checker.display.scene import DisplayScene, Layer
from checker.display.surface import Surfaces
from checker.model.robot import Robot
from checker.report.report import Display

if TYPE_CHECKING:
    from checker.trial.trial import Trial

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
    """Return the robot in 3D; None where nothing of it can be shown.

    Args:
        robot: It.
        trial: How it moved; None without a trial.
        surfaces: What its mesh files look like.
        drawing: Makes pictures of it, while the rest is put together; None for none.
    """
    scene = scene_of(robot, trial, surfaces)
    if not any(link.items for link in scene.links):
        return None
    if drawing is not None:
        drawing.give(scene)
    for spared in _SPARED:
        glb = glb_of(without(scene, spared))
        if len(glb) <= BYTES:
            left_out = tuple(f"the layer {layer} is not shown: it is too large" for layer in spared)
            pictures = drawing.pictures if drawing is not None else ()
            return Display(glb, pictures, (*scene.notes, *left_out))
    return None


def without(scene: DisplayScene, layers: Collection[Layer]) -> DisplayScene:
    """Return a scene without some of its layers."""
    if not layers:
        return scene
    links = (
        replace(link, items=tuple(item for item in link.items if item.layer not in layers))
        for link in scene.links
    )
    return replace(scene, links=tuple(links))
