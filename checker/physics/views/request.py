"""Request to the worker: a robot's sensors, lights and shapes as JSON."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Iterator
from itertools import islice
from typing import Any

from msgspec import to_builtins

from checker.base.record import Record
from checker.model.components import Collision, Light, Link, Visual
from checker.model.geometry.boxes import Box
from checker.model.geometry.interpenetration import is_convex
from checker.model.geometry.placed_shapes import place_shapes
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform
from checker.model.mesh import MeshFault, picked_part
from checker.model.robot import Robot
from checker.model.sensing.mounts import Mounted, mounted_sensors
from checker.physics.mesh.uris import MeshFile
from checker.physics.views.obstacles import SOLIDS
from checker.physics.views.rays import grid_of
from checker.source.text import Located

SENSORS, SHAPES = 60, 3000
"""The most that are looked at; a robot has a dozen sensors and a hundred visuals."""
LIGHTS = 60
"""Pairs of a light and a mesh around it that are looked at."""

Content = Callable[[Located[str]], tuple[MeshFile, str] | MeshFault]
"""Finds the file behind a URI, and a hash of what is in it."""


class ViewRequest(Record, eq=False):
    """A request, and what its numbers represent.

    Attributes:
        item: The item for the worker.
        contents: A hash of each mesh file, in the order of the request.
        sensors: The sensors in the order of the request.
        shapes: Visuals, then collisions if a sensor meets these, by their numbers.
        lights: The lights with the visual around each, in the order of the request.
        unseen: What is left out, and why, as ends of sentences.
    """

    item: dict[str, Any]
    contents: tuple[str, ...]
    sensors: tuple[Mounted, ...]
    shapes: tuple[tuple[Link, Visual | Collision], ...]
    lights: tuple[tuple[Light, Visual], ...]
    unseen: tuple[str, ...]

    @property
    def has_work(self) -> bool:
        """True if a sensor, or the surroundings of a light, may have something in view."""
        seen = self.item["meshes"] or self.item["solids"]
        return bool((self.sensors or self.lights) and seen)

    @property
    def work(self) -> int:
        """Number of pairs of sensor and shape that are computed."""
        return len(self.sensors) * len(self.shapes)


def view_request(robot: Robot, content: Content) -> ViewRequest:
    """Return the request for a robot."""
    looking = [
        (sensor, grid) for sensor in mounted_sensors(robot) if (grid := grid_of(sensor.sensor))
    ]
    visuals = [(link, visual) for link in robot.links for visual in link.visuals]
    touching = any(_meets_collisions(mount) for mount, _ in looking)
    collisions = [(link, it) for link in robot.links if touching for it in link.collisions]
    unseen: list[str] = []
    if len(looking) > SENSORS or max(len(visuals), len(collisions)) > SHAPES:
        unseen.append(f"at most {SENSORS} sensors, {SHAPES} visuals and collisions are checked")
        looking, visuals, collisions = looking[:SENSORS], visuals[:SHAPES], collisions[:SHAPES]
    lights = list(islice(_covered_lights(robot, visuals), LIGHTS))
    around = {visual for _, visual, _ in lights}
    scene = _Scene({}, {}, unseen)
    shapes: tuple[tuple[Link, Visual | Collision], ...] = (*visuals, *collisions)
    for number, (link, shape) in enumerate(shapes):
        if looking or shape in around:
            scene.add(number, shape, robot.pose_of_part(link, shape.pose), content)
    item = {
        "sensors": [
            {
                "pose": _numbers(mount.pose),
                "grid": to_builtins(grid),
                "collisions": _meets_collisions(mount),
            }
            for mount, grid in looking
        ],
        "visuals": len(visuals),
        "solids": scene.solids,
        "meshes": list(scene.meshes.values()),
    }
    if lights:
        numbers = {visual: number for number, (_, visual) in enumerate(visuals)}
        item["lights"] = [_shining(light, pose, numbers[visual]) for light, visual, pose in lights]
    contents = tuple(key for key, *_ in scene.meshes)
    seen = tuple(mount for mount, _ in looking)
    pairs = tuple((light, visual) for light, visual, _ in lights)
    left_out = tuple(dict.fromkeys(scene.unseen))
    return ViewRequest(item, contents, seen, shapes, pairs, left_out)


def _meets_collisions(mounted: Mounted) -> bool:
    """Return whether a sensor's rays meet collisions: those of Gazebo Classic without GPU."""
    return mounted.sensor.type.value == "ray"


def _covered_lights(
    robot: Robot, visuals: Iterable[tuple[Link, Visual]]
) -> Iterator[tuple[Light, Visual, Transform]]:
    """Yield lights that cast shadows with each opaque, concave mesh that they may stand inside."""
    lights = [
        (light, pose)
        for link in robot.links
        for light in link.lights
        if light.casts_shadows and light.type != "directional"
        if (pose := robot.pose_of_part(link, light.pose)) is not None
        if all(map(math.isfinite, _numbers(pose)))
    ]
    for link, visual in visuals if lights else ():
        if visual.geometry.shape == "mesh" and not visual.is_see_through:
            for piece in place_shapes(robot, link, (visual,)):
                inside = [at for at in lights if _is_within(at[1], piece.box)]
                if inside and not is_convex(robot, piece):
                    yield from ((light, visual, pose) for light, pose in inside)


def _is_within(pose: Transform, box: Box) -> bool:
    return box.gap(Box(pose.translation, pose.translation)) <= 0.0


def _shining(light: Light, pose: Transform, visual: int) -> dict[str, Any]:
    shining: dict[str, Any] = {"visual": visual, "at": list(pose.translation)}
    if light.beam is not None:
        shining["along"] = list(pose.rotate(light.beam.along))
        shining["half"] = light.beam.half
    return shining


class _Scene(Record, eq=False):
    """The shapes of a request, as they are collected.

    Attributes:
        solids: The solids by kind.
        meshes: The meshes by the hash of the content, the name of the part and whether it is
            centred.
        unseen: The reasons why some are left out.
    """

    solids: dict[str, dict[str, list[Any]]]
    meshes: dict[tuple[str, str, bool], dict[str, Any]]
    unseen: list[str]

    def add(
        self, number: int, shape: Visual | Collision, pose: Transform | None, content: Content
    ) -> None:
        """Add a shape, or state why it cannot be used."""
        geometry, kind = shape.geometry, "visual" if isinstance(shape, Visual) else "collision"
        see_through = isinstance(shape, Visual) and shape.is_see_through
        if see_through or geometry.shape in ("", "empty"):
            return
        if pose is None or not all(map(math.isfinite, _numbers(pose))):
            self.unseen.append(f"the place of {kind} {shape.name.value!r} is not known")
        elif geometry.shape == "mesh" and geometry.uri is not None:
            self._add_mesh(number, geometry, pose, content(geometry.uri))
        elif geometry.shape in SOLIDS:
            names = SOLIDS[geometry.shape][0]
            sizes = [size.value for name in names for size in geometry.sizes.get(name, ())]
            # A shape without extent is not drawn.
            if sizes and all(0.0 < size < math.inf for size in sizes):
                empty: dict[str, list[Any]] = {"visuals": [], "sizes": [], "poses": []}
                group = self.solids.setdefault(geometry.shape, empty)
                group["visuals"].append(number)
                group["sizes"].append(sizes)
                group["poses"].append(_numbers(pose))
        else:
            self.unseen.append(f"a {kind} of kind {geometry.shape} is not checked")

    def _add_mesh(
        self,
        number: int,
        geometry: Geometry,
        pose: Transform,
        found: tuple[MeshFile, str] | MeshFault,
    ) -> None:
        uri = geometry.uri
        named = uri.value if uri is not None else ""
        if isinstance(found, MeshFault):
            self.unseen.append(f"{named} {found.reason}")
            return
        picked = picked_part(geometry)
        part, centred = picked or ("", False)
        scale = [factor.value for factor in geometry.sizes.get("scale", ())]
        if (picked and not part) or len(scale) != 3 or not all(map(math.isfinite, scale)):
            self.unseen.append(f"{named} is only partly used (<submesh>)")
            return
        file, key = found
        mesh: dict[str, Any] = {"file": str(file.location), "name": named.rpartition("/")[2]}
        mesh |= {"uri": named, "part": part, "centred": centred, "uses": []}
        uses = self.meshes.setdefault((key, part, centred), mesh)["uses"]
        uses.append({"visual": number, "scale": scale, "pose": _numbers(pose)})


def _numbers(pose: Transform) -> list[float]:
    return [*(number for row in pose.rotation for number in row), *pose.translation]
