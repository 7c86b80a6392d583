"""What is asked of the worker: a robot's sensors and visuals as JSON."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from checker.base.record import Record
from checker.model.components import Link, Visual
from checker.model.geometry.transform import Transform
from checker.model.mesh import MeshFault
from checker.model.robot import Robot
from checker.model.sensing.mounts import Mounted, mounted_sensors
from checker.physics.mesh.uris import MeshFile
from checker.physics.views.obstacles import SOLIDS
from checker.physics.views.rays import grid_of
from checker.source.text import Located

SENSORS, VISUALS = 60, 3000
"""The most that are looked at; a robot has a dozen sensors and a hundred visuals."""

Content = Callable[[Located[str]], tuple[MeshFile, str] | MeshFault]
"""Finds the file behind a URI, and a hash of what is in it."""


class ViewRequest(Record, eq=False):
    """A request, and what its numbers stand for.

    Attributes:
        item: For the worker.
        contents: A hash of each mesh file, in the order of the request.
        sensors: In the order of the request.
        visuals: By their numbers.
        unseen: What is left out, and why, as ends of sentences.
    """

    item: dict[str, Any]
    contents: tuple[str, ...]
    sensors: tuple[Mounted, ...]
    visuals: tuple[tuple[Link, Visual], ...]
    unseen: tuple[str, ...]

    @property
    def visible(self) -> bool:
        """Whether there is anything to be seen."""
        return bool(self.item["meshes"] or self.item["solids"])

    @property
    def work(self) -> int:
        """How many pairs of sensor and visual are looked at."""
        return len(self.sensors) * len(self.visuals)


def view_request(robot: Robot, content: Content) -> ViewRequest:
    """Return what is to be asked about a robot."""
    looking = [
        (sensor, grid) for sensor in mounted_sensors(robot) if (grid := grid_of(sensor.sensor))
    ]
    visuals = [(link, visual) for link in robot.links for visual in link.visuals]
    unseen: list[str] = []
    if len(looking) > SENSORS or len(visuals) > VISUALS:
        unseen.append(f"at most {SENSORS} sensors and {VISUALS} visuals are checked")
        looking, visuals = looking[:SENSORS], visuals[:VISUALS]
    scene = _Scene({}, {}, unseen)
    if looking:
        for number, (link, visual) in enumerate(visuals):
            scene.add(number, visual, robot.pose_of_part(link, visual.pose), content)
    item = {
        "sensors": [
            {"pose": _numbers(mount.pose), "grid": grid.as_json()} for mount, grid in looking
        ],
        "solids": scene.solids,
        "meshes": list(scene.meshes.values()),
    }
    contents = tuple(key for key, _ in scene.meshes)
    seen = tuple(mount for mount, _ in looking)
    return ViewRequest(item, contents, seen, tuple(visuals), tuple(dict.fromkeys(scene.unseen)))


class _Scene(Record, eq=False):
    """The visuals of a request, as they are collected.

    Attributes:
        solids: By kind.
        meshes: By the hash of the content and the name of the part.
        unseen: Why some are left out.
    """

    solids: dict[str, dict[str, list[Any]]]
    meshes: dict[tuple[str, str], dict[str, Any]]
    unseen: list[str]

    def add(self, number: int, visual: Visual, pose: Transform | None, content: Content) -> None:
        """Add a visual, or say why it cannot be looked at."""
        geometry = visual.geometry
        if visual.is_see_through or geometry.shape in ("", "empty"):
            return
        if pose is None or not all(map(math.isfinite, _numbers(pose))):
            self.unseen.append(f"the place of visual {visual.name.value!r} is not known")
        elif geometry.shape == "mesh" and geometry.uri is not None:
            self._add_mesh(number, visual, pose, content(geometry.uri))
        elif geometry.shape in SOLIDS:
            names = SOLIDS[geometry.shape][0]
            sizes = [size.value for name in names for size in geometry.sizes.get(name, ())]
            # A shape without extent is not drawn.
            if sizes and all(0.0 < size < math.inf for size in sizes):
                kind: dict[str, list[Any]] = {"visuals": [], "sizes": [], "poses": []}
                group = self.solids.setdefault(geometry.shape, kind)
                group["visuals"].append(number)
                group["sizes"].append(sizes)
                group["poses"].append(_numbers(pose))
        else:
            message = f"a visual of kind {geometry.shape} is not checked"
            self.unseen.append(message)

    def _add_mesh(
        self,
        number: int,
        visual: Visual,
        pose: Transform,
        found: tuple[MeshFile, str] | MeshFault,
    ) -> None:
        uri = visual.geometry.uri
        named = uri.value if uri is not None else ""
        if isinstance(found, MeshFault):
            self.unseen.append(f"{named} {found.reason}")
            return
        part, whole = _part(visual)
        scale = [factor.value for factor in visual.geometry.sizes.get("scale", ())]
        if not whole or len(scale) != 3 or not all(map(math.isfinite, scale)):
            self.unseen.append(f"{named} is only partly used (<submesh>)")
            return
        file, key = found
        mesh = {"file": str(file.location), "name": named.rpartition("/")[2], "part": part}
        uses = self.meshes.setdefault((key, part), {**mesh, "uri": named, "uses": []})["uses"]
        uses.append({"visual": number, "scale": scale, "pose": _numbers(pose)})


def _part(visual: Visual) -> tuple[str, bool]:
    """Return the name of the part that `<submesh>` picks, and whether it stays where it is."""
    submesh = visual.geometry.element.child("submesh")
    if submesh is None:
        return "", True
    name, center = submesh.child("name"), submesh.child("center")
    centred = center is not None and center.text.value.strip() in ("true", "1")
    text = name.text.value.strip() if name is not None else ""
    return text, bool(text) and not centred


def _numbers(pose: Transform) -> list[float]:
    return [*(number for row in pose.rotation for number in row), *pose.translation]
