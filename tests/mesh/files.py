"""Mesh files for tests, written here so that every byte is known."""

from __future__ import annotations

import math
import struct
from collections.abc import Callable, Sequence
from functools import partial

from checker.physics.mesh.trimesh_files import SUFFIXES

Point = tuple[float, float, float]
Triangle = tuple[Point, Point, Point]


def box(x: float, y: float, z: float, at: Point = (0.0, 0.0, 0.0)) -> list[Triangle]:
    """Return a box about a point, its triangles facing outwards."""
    c = [
        (at[0] + sx * x / 2, at[1] + sy * y / 2, at[2] + sz * z / 2)
        for sz in (-1, 1)
        for sy in (-1, 1)
        for sx in (-1, 1)
    ]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    return [t for p, q, r, s in quads for t in ((c[p], c[q], c[r]), (c[p], c[r], c[s]))]


def cylinder(radius: float, length: float, sides: int) -> list[Triangle]:
    """Return a prism inscribed in a cylinder along z."""
    turns = [2 * math.pi * k / sides for k in range(sides)]
    ring = [(radius * math.cos(a), radius * math.sin(a)) for a in turns]
    low, high, found = -length / 2, length / 2, []
    for (ax, ay), (bx, by) in zip(ring, [*ring[1:], ring[0]], strict=True):
        a, b, c, d = (ax, ay, low), (bx, by, low), (bx, by, high), (ax, ay, high)
        found += [(a, b, c), (a, c, d), ((0.0, 0.0, low), b, a), ((0.0, 0.0, high), d, c)]
    return found


def binary_stl(triangles: Sequence[Triangle], declared: int | None = None) -> bytes:
    count = len(triangles) if declared is None else declared
    body = b"".join(
        struct.pack("<12f2x", 0.0, 0.0, 0.0, *(v for point in each for v in point))
        for each in triangles
    )
    return b"solid no text file".ljust(80) + struct.pack("<I", count) + body


def text_stl(triangles: Sequence[Triangle]) -> bytes:
    facets = "".join(
        "facet normal 0 0 0\n outer loop\n"
        + "".join(f"  vertex {x!r} {y!r} {z!r}\n" for x, y, z in each)
        + " endloop\nendfacet\n"
        for each in triangles
    )
    return f"solid part\n{facets}endsolid part\n".encode()


def obj(triangles: Sequence[Triangle]) -> bytes:
    lines = [f"v {x!r} {y!r} {z!r}" for each in triangles for x, y, z in each]
    lines += [f"f {3 * k + 1} {3 * k + 2} {3 * k + 3}" for k in range(len(triangles))]
    return "\n".join(lines).encode()


NAMESPACE = "http://www.collada.org/2005/11/COLLADASchema"


def dae(
    triangles: Sequence[Triangle],
    asset: str = "",
    node: str = "",
    more: str = "",
    name: str = "part",
) -> bytes:
    """Return a COLLADA file.

    Args:
        triangles: Of its only geometry.
        asset: What stands in `<asset>`.
        node: Transforms of the node that shows it.
        more: Other libraries.
        name: Id of the geometry.
    """
    numbers = " ".join(repr(value) for each in triangles for point in each for value in point)
    count = 3 * len(triangles)
    order = " ".join(map(str, range(count)))
    return f"""<?xml version="1.0"?>
<COLLADA xmlns="{NAMESPACE}" version="1.4.1">
<asset>{asset}</asset>{more}
<library_geometries><geometry id="{name}"><mesh>
  <source id="{name}-points">
    <float_array id="{name}-numbers" count="{3 * count}">{numbers}</float_array>
    <technique_common><accessor source="#{name}-numbers" count="{count}" stride="3">
      <param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>
    </accessor></technique_common>
  </source>
  <vertices id="{name}-corners"><input semantic="POSITION" source="#{name}-points"/></vertices>
  <triangles count="{len(triangles)}">
    <input semantic="VERTEX" source="#{name}-corners" offset="0"/><p>{order}</p>
  </triangles>
</mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="all"><node id="n" name="body">{node}
  <instance_geometry url="#{name}"/>
</node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#all"/></scene>
</COLLADA>""".encode()


def by_trimesh(triangles: list[Triangle], suffix: str) -> bytes:
    import trimesh

    parts = trimesh.triangles.to_kwargs(triangles)
    written = trimesh.Trimesh(**parts).export(file_type=suffix)
    return written if isinstance(written, bytes) else written.encode()


WRITERS: dict[str, Callable[[list[Triangle]], bytes]] = {
    "stl": binary_stl,
    "obj": obj,
    "dae": dae,
    **{suffix: partial(by_trimesh, suffix=suffix) for suffix in SUFFIXES},
}
"""Of each format that is read."""
