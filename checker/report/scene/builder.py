"""Builds the scene of a robot and its trial: all layers, link by link."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import islice
from typing import TYPE_CHECKING, Any

from msgspec.structs import replace

from checker.model.components import Sensor
from checker.model.geometry.transform import Transform
from checker.model.robot import Robot
from checker.physics.mesh.surface import Colour, Surface
from checker.physics.trial.mjcf.names import is_finite_pose
from checker.physics.views.rays import Grid, grid_of
from checker.report.scene.extent import sphere_around
from checker.report.scene.layers.mechanics import frames, inertias, joints, masses
from checker.report.scene.layers.visuals import collisions, visuals
from checker.report.scene.mesh_files import Notes, Surfaces, short
from checker.report.scene.primitives import bar, merge_surfaces
from checker.report.scene.scene import DisplayScene, Item, Layer, LinkNode, Tracks
from checker.report.scene.shown_robot import Hung, Showing

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]
    from checker.physics.trial.trial import Replay, Trial


# The layer of views: what cameras and lidars can see, cut off near the robot.


_BLUE: Colour = (0.2, 0.6, 1.0, 0.18)
_EDGES: Colour = (0.1, 0.4, 0.9, 1.0)
_GREEN: Colour = (0.2, 0.85, 0.4, 0.18)
_CAMERA, _LIDAR = 1.5, 2.0
"""Greatest range of shown views, as a multiple of the robot's size."""
_WIDTH = 0.006
"""Width of an edge, as a share of its view's length."""
_STEP = math.radians(7.5)
_ROUND = 2 * math.pi - 1e-3
_FLAT = 1e-6


def views(showing: Showing) -> Hung:
    """Yield the views of a robot's cameras and lidars."""
    for link in showing.links:
        for sensor in link.sensors:
            grid, place = grid_of(sensor), showing.placed(link, sensor, sensor.pose)
            if grid is not None and place is not None:
                name, path = sensor.name.value, sensor.element.path
                surfaces = view_of(sensor, grid, showing.size)
                yield link.scoped_name, Item(Layer.VIEW, name, path, place, surfaces)


def view_of(sensor: Sensor, grid: Grid, size: float) -> tuple[Surface, ...]:
    """Return what a sensor can see, in its own frame.

    Args:
        sensor: A camera or lidar.
        grid: The angles and ranges of its view.
        size: The size of the robot, metres.
    """
    if grid.picture is not None:
        return _pyramid(grid.picture, min(grid.far, _CAMERA * size))
    lidar = sensor.kind.is_lidar
    reach = min(grid.far, (_LIDAR if lidar else _CAMERA) * size)
    return (replace(_fans(grid, reach), colour=_GREEN if lidar else _BLUE),)


def _pyramid(picture: tuple[float, float], reach: float) -> tuple[Surface, ...]:
    """Return the view of a pinhole camera: its sides, and thin bars along their edges."""
    import numpy as np

    wide, high = picture
    # Reach is along the edges: a wide picture would else be larger than all the rest.
    deep = reach / math.hypot(1.0, wide, high)
    y, z = wide * deep, high * deep
    corners = [(deep, y, z), (deep, -y, z), (deep, -y, -z), (deep, y, -z)]
    points = np.array([(0.0, 0.0, 0.0), *corners], dtype=np.float32)
    sides = [(0, 1, 2), (0, 2, 3), (0, 3, 4), (0, 4, 1), (1, 4, 3), (1, 3, 2)]
    starts = [(0.0, 0.0, 0.0)] * 4 + corners
    ends = corners + corners[1:] + corners[:1]
    edges = [bar(a, b, _WIDTH * reach) for a, b in zip(starts, ends, strict=True)]
    return (
        Surface(points, np.array(sides, dtype=np.uint32), _BLUE),
        replace(merge_surfaces(edges), colour=_EDGES),
    )


def _fans(grid: Grid, reach: float) -> Surface:
    """Return the limits of a scan: its lowest and highest rows, and its sides if it has any."""
    left, right = grid.across.lower, grid.across.upper
    low, high = grid.up.lower, grid.up.upper
    rows = [low] if high - low < _FLAT else [low, high]
    across = _angles(left, right)
    fans = [_fan([(angle, row) for angle in across], reach) for row in rows]
    if right - left < _ROUND and len(rows) > 1:
        up = _angles(low, high)
        fans += [_fan([(side, angle) for angle in up], reach) for side in (left, right)]
    return merge_surfaces(fans)


def _angles(lower: float, upper: float) -> list[float]:
    steps = max(math.ceil((upper - lower) / _STEP), 1)
    return [lower + (upper - lower) * step / steps for step in range(steps + 1)]


def _fan(directions: Sequence[tuple[float, float]], reach: float) -> Surface:
    """Return triangles from the origin to neighbouring directions (azimuth and elevation)."""
    import numpy as np

    azimuth, elevation = (np.array(angles) for angles in zip(*directions, strict=True))
    flat = np.cos(elevation)
    ends = np.stack([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)], axis=1)
    vertices = np.concatenate([np.zeros((1, 3)), reach * ends]).astype(np.float32)
    number = np.arange(1, len(directions))
    faces = np.stack([np.zeros_like(number), number, number + 1], axis=1).astype(np.uint32)
    return Surface(vertices, faces)


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


def scene_of(
    robot: Robot, trial: Trial | None, surfaces: Surfaces, *, marked: bool = True
) -> DisplayScene:
    """Return what is shown of a robot.

    Args:
        robot: The robot.
        trial: Its motion; None without a trial.
        surfaces: What its mesh files look like.
        marked: Whether marks such as joints and views are among it, besides its shapes.
    """
    notes = Notes()
    showing = Showing(robot, _frames(robot, notes), surfaces, notes)
    shapes = list(_hung(_SHAPES, showing))
    size = sphere_around(shapes, showing.frames).radius
    hung: dict[str, list[Item]] = {}
    marks = _hung(_MARKS, replace(showing, size=size)) if marked else ()
    for name, item in (*shapes, *marks):
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
        elif pose is None or not is_finite_pose(pose):
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
