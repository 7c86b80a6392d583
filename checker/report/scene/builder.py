"""Builds what is shown of a robot and its trial: all layers, link by link."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import islice
from typing import TYPE_CHECKING

from msgspec.structs import replace

from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.physics.trial.mjcf.names import well_placed
from checker.report.scene.extent import sphere_around
from checker.report.scene.layers.mechanics import frames, inertias, joints, masses
from checker.report.scene.layers.views import views
from checker.report.scene.layers.visuals import collisions, visuals
from checker.report.scene.scene import DisplayScene, Item, Layer, LinkNode, Tracks
from checker.report.scene.shown_robot import Hung, Showing
from checker.report.scene.surfaces import Notes, Surfaces, short

if TYPE_CHECKING:
    from checker.physics.trial.trial import Replay, Trial

LINKS, ITEMS = 5000, 2000
"""The most links that are shown, and things in one layer."""

_Maker = Callable[[Showing], Hung]

_SHAPES: Mapping[Layer, _Maker] = {Layer.VISUAL: visuals, Layer.COLLISION: collisions}
_MARKS: Mapping[Layer, _Maker] = {
    Layer.INERTIA: inertias,
    Layer.FRAME: frames,
    Layer.JOINT: joints,
    Layer.MASS: masses,
    Layer.VIEW: views,
}


def scene_of(robot: Robot, trial: Trial | None, surfaces: Surfaces) -> DisplayScene:
    """Return what is shown of a robot.

    Args:
        robot: It.
        trial: How it moved; None without a trial.
        surfaces: What its mesh files look like.
    """
    notes = Notes()
    showing = Showing(robot, _frames(robot, notes), surfaces, notes)
    shapes = list(_hung(_SHAPES, showing))
    size = sphere_around(shapes, showing.frames).radius
    hung: dict[str, list[Item]] = {}
    for name, item in (*shapes, *_hung(_MARKS, replace(showing, size=size))):
        hung.setdefault(name, []).append(item)
    replay = trial.replay if trial is not None else None
    links = [
        LinkNode(
            name,
            robot.links_by_name[name].element.path,
            frame,
            tuple(hung.get(name, ())),
            _carrier(name, replay, showing.frames),
        )
        for name, frame in showing.frames.items()
    ]
    links.sort(key=lambda link: bool(link.carrier))
    tracks = _tracks(replay, showing.frames)
    return DisplayScene(robot.name.value, tuple(links), tracks, notes.sentences)


def _frames(robot: Robot, notes: Notes) -> dict[str, Transform]:
    """Return the poses of the links that can be shown."""
    if len(robot.links_by_name) > LINKS:
        notes.say(f"{len(robot.links_by_name)} links: only the first {LINKS} are shown")
    known: dict[str, Transform] = {}
    for link in islice(robot.links, LINKS):
        name = link.scoped_name
        pose = robot.pose_of(name)
        if name in known:
            notes.say(f"several links are called {short(name)!r}: only the first is shown")
        elif pose is None or not well_placed(pose):
            notes.say(f"link {short(name)!r} is not shown: its place is not known")
        else:
            known[name] = pose
    return known


def _hung(makers: Mapping[Layer, _Maker], showing: Showing) -> Hung:
    """Yield the items of some layers, as many of each as can be shown."""
    for layer, make in makers.items():
        items = make(showing)
        yield from islice(items, ITEMS)
        if next(items, None) is not None:
            showing.notes.say(f"only the first {ITEMS} parts of the layer {layer} are shown")


def _carrier(name: str, replay: Replay | None, shown: Mapping[str, Transform]) -> str:
    carrier = replay.carriers.get(name, "") if replay is not None else ""
    return carrier if carrier in shown else ""


def _tracks(replay: Replay | None, shown: Mapping[str, Transform]) -> Tracks | None:
    """Return the motion of the links that are shown."""
    import numpy as np

    if replay is None:
        return None
    poses = {
        name: np.array(flat, dtype=np.float32).reshape(len(replay.time), -1)
        for name, flat in replay.poses.items()
        if name in shown
    }
    return Tracks(np.array(replay.time, dtype=np.float32), poses)
