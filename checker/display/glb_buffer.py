"""The binary part of a GLB: arrays, each stored once, and the accessors that lead to them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]

VERTICES, INDICES = 34962, 34963
"""Targets of buffer views: ARRAY_BUFFER and ELEMENT_ARRAY_BUFFER."""
_COMPONENTS = {"u1": 5121, "u2": 5123, "u4": 5125, "f4": 5126}
_TYPES = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
_ALIGNED = 4
"""Bytes: where every view begins, whatever it holds."""


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
            normalized: Whether whole numbers stand for 0 to 1.
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
