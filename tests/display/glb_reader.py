"""Reads a GLB back, strictly as the specification of glTF 2.0 has it."""

from __future__ import annotations

import json
import struct
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

_TYPES = {5121: np.uint8, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
_WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}

Array = NDArray[Any]


@dataclass(frozen=True)
class Glb:
    """A file that was read."""

    said: dict[str, Any]
    data: bytes

    @property
    def nodes(self) -> list[dict[str, Any]]:
        return list(self.said["nodes"])

    @property
    def extras(self) -> dict[str, Any]:
        return dict(self.said["scenes"][0]["extras"])

    def array(self, number: int) -> Array:
        """Return what an accessor leads to."""
        accessor = self.said["accessors"][number]
        view = self.said["bufferViews"][accessor["bufferView"]]
        kind, width = np.dtype(_TYPES[accessor["componentType"]]), _WIDTHS[accessor["type"]]
        assert view["byteOffset"] % 4 == 0
        assert view["byteLength"] == accessor["count"] * width * kind.itemsize
        assert view["byteOffset"] + view["byteLength"] <= len(self.data)
        flat = np.frombuffer(self.data, kind, accessor["count"] * width, view["byteOffset"])
        return flat.reshape(-1, width)

    @cached_property
    def parents(self) -> dict[int, int]:
        parents: dict[int, int] = {}
        for number, node in enumerate(self.nodes):
            for child in node.get("children", ()):
                assert child not in parents, "a node hangs on two others"
                parents[child] = number
        return parents

    def find(self, **extras: str) -> list[int]:
        """Return the nodes whose extras say so."""
        return [
            number
            for number, node in enumerate(self.nodes)
            if extras.items() <= node.get("extras", {}).items()
        ]

    def pose(self, number: int) -> Array:
        """Return the 4×4 matrix of a node in the scene."""
        node = self.nodes[number]
        own = np.eye(4)
        turn = Rotation.from_quat(node.get("rotation", [0, 0, 0, 1])).as_matrix()
        own[:3, :3] = turn * np.array(node.get("scale", [1, 1, 1]))
        own[:3, 3] = node.get("translation", [0, 0, 0])
        above = self.parents.get(number)
        return own if above is None else self.pose(above) @ own

    def corners(self, number: int) -> Array:
        """Return the corners of a node's mesh in the scene, as z-up robots have them."""
        mesh = self.said["meshes"][self.nodes[number]["mesh"]]
        local = [self.array(each["attributes"]["POSITION"]) for each in mesh["primitives"]]
        pose = self.pose(number)
        placed: Array = np.concatenate(local) @ pose[:3, :3].T + pose[:3, 3]
        return np.stack([placed[:, 0], -placed[:, 2], placed[:, 1]], axis=1)


def read_glb(glb: bytes) -> Glb:
    """Read a GLB and check it."""
    magic, version, length = struct.unpack_from("<4sII", glb)
    assert (magic, version, length) == (b"glTF", 2, len(glb))
    size, kind = struct.unpack_from("<I4s", glb, 12)
    assert (kind, size % 4) == (b"JSON", 0)
    said = json.loads(glb[20 : 20 + size])
    data = b""
    if 20 + size < len(glb):
        data_size, data_kind = struct.unpack_from("<I4s", glb, 20 + size)
        assert (data_kind, data_size % 4) == (b"BIN\0", 0)
        data = glb[28 + size :]
        assert len(data) == data_size == said["buffers"][0]["byteLength"]
    read = Glb(said, data)
    _check(read)
    return read


def _check(glb: Glb) -> None:
    for number, accessor in enumerate(glb.said.get("accessors", ())):
        array = glb.array(number)
        assert np.isfinite(array).all()
        if "min" in accessor:
            assert array.min(axis=0).tolist() == accessor["min"]
            assert array.max(axis=0).tolist() == accessor["max"]
    for mesh in glb.said.get("meshes", ()):
        for primitive in mesh["primitives"]:
            attributes = [glb.array(each) for each in primitive["attributes"].values()]
            assert len({len(each) for each in attributes}) == 1
            assert "min" in glb.said["accessors"][primitive["attributes"]["POSITION"]]
            indices = glb.array(primitive["indices"])
            assert len(indices) % 3 == 0
            assert indices.max() < len(attributes[0])
            assert primitive["material"] < len(glb.said["materials"])
    tops = [number for number in range(len(glb.nodes)) if number not in glb.parents]
    assert tops == glb.said["scenes"][0]["nodes"]
    assert len(_below(glb, tops[0])) == len(glb.nodes)
    for animation in glb.said.get("animations", ()):
        _check_animation(glb, animation)


def _below(glb: Glb, top: int) -> set[int]:
    """Return a node and those below it: all of them, if there is no circle."""
    found: set[int] = set()
    waiting = [top]
    while waiting:
        number = waiting.pop()
        assert number not in found
        found.add(number)
        waiting.extend(glb.nodes[number].get("children", ()))
    return found


def _check_animation(glb: Glb, animation: dict[str, Any]) -> None:
    for sampler in animation["samplers"]:
        time, output = glb.array(sampler["input"]), glb.array(sampler["output"])
        assert len(time) == len(output)
        assert (np.diff(time[:, 0]) > 0.0).all()
        assert "min" in glb.said["accessors"][sampler["input"]]
    for channel in animation["channels"]:
        path = channel["target"]["path"]
        values = glb.array(animation["samplers"][channel["sampler"]]["output"])
        assert values.shape[1] == {"translation": 3, "rotation": 4}[path]
        if path == "rotation":
            np.testing.assert_allclose(np.linalg.norm(values, axis=1), 1.0, atol=1e-6)
            assert ((values[1:] * values[:-1]).sum(axis=1) >= 0.0).all()
        assert "matrix" not in glb.nodes[channel["target"]["node"]]
