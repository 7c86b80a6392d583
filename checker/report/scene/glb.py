"""A scene as a binary glTF 2.0 file: links as nodes, their motion as an animation.

Source of the format: Khronos Group, "glTF 2.0 Specification".
"""

from __future__ import annotations

import json
import math
import struct
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from checker.base.words import shortened
from checker.model.geometry.transform import Transform
from checker.physics.trial.mjcf.names import quaternion
from checker.report.scene.extent import sphere_of
from checker.report.scene.glb_meshes import GlbBuffer, GlbMeshes
from checker.report.scene.scene import DisplayScene, Item, LinkNode, Tracks

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

_MAGIC, _VERSION = 0x46546C67, 2
_JSON, _BIN = 0x4E4F534A, 0x004E4942
_NAME = 200
"""Characters of a name."""
_UPRIGHT = [-math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5)]
"""Quaternion x, y, z, w of −90° about x: z, which points up for robots, becomes glTF's y."""


def glb_of(scene: DisplayScene) -> bytes:
    """Return a scene as a GLB.

    Nodes of links and of their parts state in `extras` what they represent: `kind`, or
    `layer`, with `name` and `element`. The scene's `extras` give the robot's name, and a sphere
    around it in metres with z up.
    """
    writer = _Writer()
    world = writer.world(scene)
    buffer, meshes = writer.buffer, writer.meshes
    around = sphere_of(scene)
    extras = {"robot": _text(scene.robot), "size": around.radius, "centre": list(around.centre)}
    document = {
        "asset": {"version": "2.0", "generator": "subt-check"},
        "scene": 0,
        "scenes": [{"nodes": [world], "extras": extras}],
        "nodes": writer.nodes,
        "meshes": meshes.meshes,
        "materials": meshes.materials,
        "animations": writer.animations,
        "accessors": buffer.accessors,
        "bufferViews": buffer.views,
        "buffers": [{"byteLength": len(buffer.data)}] if buffer.data else [],
    }
    return _packed({name: part for name, part in document.items() if part != []}, buffer.data)


def _packed(document: dict[str, Any], data: bytearray) -> bytes:
    text = json.dumps(document, separators=(",", ":"), allow_nan=False).encode("ascii")
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), _JSON) + text
    if data:
        chunks += struct.pack("<II", len(data), _BIN) + data
    return struct.pack("<III", _MAGIC, _VERSION, 12 + len(chunks)) + chunks


@dataclass
class _Writer:
    """Nodes and animations as they are collected."""

    buffer: GlbBuffer = field(default_factory=GlbBuffer)
    nodes: list[dict[str, Any]] = field(default_factory=list)
    animations: list[dict[str, Any]] = field(default_factory=list)
    meshes: GlbMeshes = field(init=False)

    def __post_init__(self) -> None:
        self.meshes = GlbMeshes(self.buffer)

    def world(self, scene: DisplayScene) -> int:
        """Add everything; return the number of the node that contains it."""
        own = {link.name: link.pose for link in scene.links}
        tracked = scene.tracks.poses if scene.tracks is not None else {}
        start = scene.poses()
        below: list[int] = []
        numbers: dict[str, int] = {}
        for link in scene.links:
            fixed = bool(link.carrier) and link.name not in tracked
            pose = own[link.carrier].inverse @ link.pose if fixed else start[link.name]
            numbers[link.name] = self._link(link, pose)
            holder = self.nodes[numbers[link.carrier]] if fixed else None
            (holder["children"] if holder is not None else below).append(numbers[link.name])
        for node in self.nodes:
            if node.get("children") == []:
                del node["children"]
        if scene.tracks is not None:
            self._animate(scene.tracks, numbers)
        world = {"name": "world", "rotation": _UPRIGHT}
        return self._node({**world, "children": below} if below else world)

    def _node(self, node: dict[str, Any]) -> int:
        self.nodes.append(node)
        return len(self.nodes) - 1

    def _link(self, link: LinkNode, pose: Transform) -> int:
        name, element = _text(link.name), _clean(link.element)
        extras = {"kind": "link", "name": name, "element": element}
        children = [self._item(item) for item in link.items]
        return self._node({"name": name, **_placed(pose), "children": children, "extras": extras})

    def _item(self, item: Item) -> int:
        name, element = _text(item.name), _clean(item.element)
        node = {
            "name": name,
            **_placed(item.pose),
            "mesh": self.meshes.mesh(item.surfaces),
            "extras": {"layer": str(item.layer), "name": name, "element": element},
        }
        if item.scale != (1.0, 1.0, 1.0):
            node["scale"] = list(item.scale)
        return self._node(node)

    def _animate(self, tracks: Tracks, numbers: dict[str, int]) -> None:
        """Add the motion of the links, unless it is of one moment."""
        import numpy as np

        if len(tracks.time) < 2 or not tracks.poses:
            return
        time = self.buffer.add(tracks.time.astype(np.float32), bounds=True)
        samplers: list[dict[str, Any]] = []
        channels: list[dict[str, Any]] = []
        for name, poses in tracks.poses.items():
            paths = {"translation": poses[:, :3], "rotation": _turns(poses[:, 3:])}
            for path, values in paths.items():
                target = {"node": numbers[name], "path": path}
                channels.append({"sampler": len(samplers), "target": target})
                output = self.buffer.add(values.astype(np.float32))
                samplers.append({"input": time, "output": output, "interpolation": "LINEAR"})
        self.animations.append({"name": "trial", "channels": channels, "samplers": samplers})


def _turns(quaternions: Array) -> Array:
    """Return quaternions w, x, y, z as glTF has them: x, y, z, w, each near the one before it."""
    import numpy as np

    turns = quaternions[:, [1, 2, 3, 0]].astype(float)
    turns /= np.maximum(np.linalg.norm(turns, axis=1, keepdims=True), 1e-12)
    flips = np.where((turns[1:] * turns[:-1]).sum(axis=1) < 0.0, -1.0, 1.0)
    turns[1:] *= np.cumprod(flips)[:, None]
    return turns


def _placed(pose: Transform) -> dict[str, list[float]]:
    """Return what places a node; nothing for one that is not moved."""
    w, x, y, z = quaternion(pose.rotation)
    placed = {}
    if any(pose.translation):
        placed["translation"] = list(pose.translation)
    if (x, y, z) != (0.0, 0.0, 0.0):
        placed["rotation"] = [x, y, z, w]
    return placed


def _text(name: str) -> str:
    return _clean(shortened(name, _NAME))


def _clean(text: str) -> str:
    """Return a text without halves of surrogate pairs, which JSON cannot express."""
    return text.encode("utf-8", "replace").decode("utf-8")
