"""Small robots as GLB files: boxes on links, in layers, that drive.

Written independently of `checker.report.scene`, after the glTF 2.0 specification and what the
viewer expects: a node for each link, below it one for each item, told apart by their extras.
"""

from __future__ import annotations

import json
import math
import struct
from dataclasses import dataclass, field
from typing import Any

BLUE, ORANGE, YELLOW = [0.05, 0.2, 0.8, 1.0], [1.0, 0.4, 0.0, 0.4], [0.9, 0.8, 0.0, 1.0]
QUARTER = math.sqrt(0.5)
UPRIGHT = [-QUARTER, 0.0, 0.0, QUARTER]
"""The world's z up in a file whose y is up."""


@dataclass
class GlbFile:
    """Collects buffers and nodes."""

    nodes: list[dict[str, Any]] = field(default_factory=list)
    meshes: list[dict[str, Any]] = field(default_factory=list)
    materials: list[dict[str, Any]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)
    views: list[dict[str, Any]] = field(default_factory=list)
    channels: list[dict[str, Any]] = field(default_factory=list)
    samplers: list[dict[str, Any]] = field(default_factory=list)
    binary: bytearray = field(default_factory=bytearray)

    def accessor(self, rows: list[tuple[float, ...]], kind: str) -> int:
        """Add floats (or indices, kind `INDEX`) and return their number."""
        index = kind == "INDEX"
        flat = [value for row in rows for value in row]
        data = struct.pack(f"<{len(flat)}{'I' if index else 'f'}", *flat)
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": len(data)})
        self.binary += data
        self.accessors.append(
            {
                "bufferView": len(self.views) - 1,
                "componentType": 5125 if index else 5126,
                "count": len(flat) if index else len(rows),
                "type": "SCALAR" if index else kind,
            }
        )
        if not index:
            columns = list(zip(*rows, strict=True))
            self.accessors[-1]["min"] = [min(column) for column in columns]
            self.accessors[-1]["max"] = [max(column) for column in columns]
        return len(self.accessors) - 1

    def box(self, size: tuple[float, float, float], colour: list[float]) -> int:
        """Add a box around the origin and return its mesh."""
        signs = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        corners = [tuple(s * v / 2 for s, v in zip(sign, size, strict=True)) for sign in signs]
        sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
        faces = [face for a, b, c, d in sides for face in ((a, b, c), (a, c, d))]
        pbr = {"baseColorFactor": colour, "metallicFactor": 0, "roughnessFactor": 0.8}
        blend = "BLEND" if colour[3] < 1 else "OPAQUE"
        self.materials.append(
            {"pbrMetallicRoughness": pbr, "alphaMode": blend, "doubleSided": True}
        )
        attributes = {"POSITION": self.accessor([tuple(c) for c in corners], "VEC3")}
        primitive = {
            "attributes": attributes,
            "indices": self.accessor([*faces], "INDEX"),
            "material": len(self.materials) - 1,
        }
        self.meshes.append({"primitives": [primitive]})
        return len(self.meshes) - 1

    def node(self, parent: int | None = None, **facts: Any) -> int:
        """Add a node and return its number."""
        self.nodes.append(facts)
        number = len(self.nodes) - 1
        if parent is not None:
            self.nodes[parent].setdefault("children", []).append(number)
        return number

    def item(self, link: int, layer: str, name: str, element: str, mesh: int, **pose: Any) -> None:
        """Hang something to see on a link."""
        extras = {"layer": layer, "name": name, "element": element}
        self.node(link, name=name, mesh=mesh, extras=extras, **pose)

    def animate(self, node: int, path: str, time: int, rows: list[tuple[float, ...]]) -> None:
        """Move a node: `path` is translation or rotation."""
        self.nodes[node][path] = list(rows[0])
        output = self.accessor(rows, "VEC3" if path == "translation" else "VEC4")
        self.samplers.append({"input": time, "output": output, "interpolation": "LINEAR"})
        target = {"node": node, "path": path}
        self.channels.append({"sampler": len(self.samplers) - 1, "target": target})

    def written(self, **extras: Any) -> bytes:
        """Return the file; node 0 is the root."""
        document: dict[str, Any] = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0] if self.nodes else [], "extras": extras}],
        }
        lists = {
            "nodes": self.nodes,
            "meshes": self.meshes,
            "materials": self.materials,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.binary)}] if self.binary else [],
        }
        document |= {name: entries for name, entries in lists.items() if entries}
        if self.channels:
            animation = {"name": "trial", "channels": self.channels, "samplers": self.samplers}
            document["animations"] = [animation]
        text = json.dumps(document).encode()
        return container(text + b" " * (-len(text) % 4), bytes(self.binary))


def container(text: bytes, binary: bytes) -> bytes:
    """Return a GLB file of its two chunks, each a multiple of four bytes long."""
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text
    if binary:
        chunks += struct.pack("<II", len(binary), 0x004E4942) + binary
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks
