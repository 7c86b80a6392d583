"""The meshes and materials of a GLB; those that are used again are stored once."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from checker.physics.mesh.surface import Colour, Surface

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


# The binary part of a GLB: arrays, each stored once, and the accessors that lead to them.


VERTICES, INDICES = 34962, 34963
"""Targets of buffer views: ARRAY_BUFFER and ELEMENT_ARRAY_BUFFER."""
_COMPONENTS = {"u1": 5121, "u2": 5123, "u4": 5125, "f4": 5126}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_ALIGNED = 4
"""Bytes: where every view begins, with any content."""


@dataclass
class GlbBuffer:
    """A buffer that grows.

    Attributes:
        data: Its bytes so far.
        views: glTF's `bufferViews`.
        accessors: glTF's `accessors`.
    """

    data: bytearray = field(default_factory=bytearray)
    views: list[dict[str, Any]] = field(default_factory=list)
    accessors: list[dict[str, Any]] = field(default_factory=list)

    def add(
        self,
        array: Array,
        *,
        target: int | None = None,
        bounds: bool = False,
        normalized: bool = False,
    ) -> int:
        """Store an array and return the number of its accessor.

        Args:
            array: n numbers or n × k, of one of glTF's types.
            target: What a view is used for, if for drawing.
            bounds: Whether the accessor states the least and greatest numbers.
            normalized: Whether whole numbers represent 0 to 1.
        """
        stored = array.astype(array.dtype.newbyteorder("<"), order="C")
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": stored.nbytes}
        self.views.append(view if target is None else {**view, "target": target})
        self.data += stored.tobytes()
        self.data += bytes(-len(self.data) % _ALIGNED)
        accessor: dict[str, Any] = {
            "bufferView": len(self.views) - 1,
            "componentType": _COMPONENTS[array.dtype.str[1:]],
            "count": len(array),
            "type": _TYPES[array.shape[1] if array.ndim > 1 else 1],
        }
        if bounds:
            rows = array.reshape(len(array), -1)
            accessor |= {"min": rows.min(axis=0).tolist(), "max": rows.max(axis=0).tolist()}
        if normalized:
            accessor["normalized"] = True
        self.accessors.append(accessor)
        return len(self.accessors) - 1


_ROUGH = 0.8
_SHORT = 65535
"""Corners that two bytes can number: the greatest number restarts primitives."""


@dataclass
class GlbMeshes:
    """Meshes as they are collected.

    Attributes:
        buffer: The buffer for their arrays.
        meshes: glTF's `meshes`.
        materials: glTF's `materials`.
    """

    buffer: GlbBuffer
    meshes: list[dict[str, Any]] = field(default_factory=list)
    materials: list[dict[str, Any]] = field(default_factory=list)
    _arrays: dict[tuple[str, int], tuple[int, Array]] = field(default_factory=dict)
    _known: dict[tuple[Any, ...], int] = field(default_factory=dict)
    _painted: dict[tuple[Colour, bool], int] = field(default_factory=dict)

    def mesh(self, surfaces: tuple[Surface, ...]) -> int:
        """Return the number of the mesh that consists of some surfaces."""
        primitives = [self._primitive(surface) for surface in surfaces]
        key = tuple(
            (primitive["material"], primitive["indices"], *primitive["attributes"].items())
            for primitive in primitives
        )
        if key not in self._known:
            self._known[key] = len(self.meshes)
            self.meshes.append({"primitives": primitives})
        return self._known[key]

    def _primitive(self, surface: Surface) -> dict[str, Any]:
        attributes = {"POSITION": self._stored("POSITION", surface.vertices)}
        if surface.normals is not None:
            attributes["NORMAL"] = self._stored("NORMAL", surface.normals)
        if surface.vertex_colours is not None:
            attributes["COLOR_0"] = self._stored("COLOR_0", surface.vertex_colours)
        return {
            "attributes": attributes,
            "indices": self._stored("indices", surface.faces),
            "material": self._material(surface),
        }

    def _stored(self, use: str, array: Array) -> int:
        """Return the accessor of an array: the same for the same array."""
        key = (use, id(array))
        if key not in self._arrays:
            # Kept with the array itself, so that no other one gets its id.
            self._arrays[key] = (self._added(use, array), array)
        return self._arrays[key][0]

    def _added(self, use: str, array: Array) -> int:
        import numpy as np

        match use:
            case "indices":
                small = int(array.max()) < _SHORT
                numbers = array.reshape(-1).astype(np.uint16 if small else np.uint32)
                return self.buffer.add(numbers, target=INDICES)
            case "COLOR_0":
                return self.buffer.add(_linear_bytes(array), target=VERTICES, normalized=True)
        vectors = array.astype(np.float32)
        return self.buffer.add(vectors, target=VERTICES, bounds=use == "POSITION")

    def _material(self, surface: Surface) -> int:
        corners = surface.vertex_colours
        clear = surface.colour[3] < 1.0 or (corners is not None and bool(corners[:, 3].min() < 255))
        key = (surface.colour, clear)
        if key not in self._painted:
            self._painted[key] = len(self.materials)
            material = {
                "pbrMetallicRoughness": {
                    "baseColorFactor": linear(surface.colour),
                    "metallicFactor": 0.0,
                    "roughnessFactor": _ROUGH,
                },
                "doubleSided": True,
            }
            self.materials.append({**material, "alphaMode": "BLEND"} if clear else material)
        return self._painted[key]


def linear(colour: Colour) -> list[float]:
    """Return a colour in the form of glTF: linear, alpha as it is (IEC 61966-2-1, sRGB)."""
    red, green, blue, alpha = colour
    return [*(_linear(number) for number in (red, green, blue)), alpha]


def _linear(value: float) -> float:
    return value / 12.92 if value <= 0.04045 else ((value + 0.055) / 1.055) ** 2.4


def _linear_bytes(colours: Array) -> Array:
    """Return the same for bytes."""
    import numpy as np

    known = np.array([round(255 * _linear(number / 255)) for number in range(256)], dtype=np.uint8)
    return np.concatenate([known[colours[:, :3]], colours[:, 3:]], axis=1)
