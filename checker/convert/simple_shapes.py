"""Shapes in the words of a format that lacks some of them."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import field

from checker.model.shapes import Geometry
from checker.model.transform import Transform
from checker.record import record
from checker.source.text import Located


@record(eq=False)
class Shape:
    """One shape of what replaces a geometry.

    Attributes:
        kind: Its tag.
        sizes: As `Geometry.sizes`.
        pose: In the frame of the geometry.
    """

    kind: str
    sizes: Mapping[str, tuple[Located[float], ...]] = field(default_factory=dict)
    pose: Transform = field(default_factory=Transform)


def shapes_of(geometry: Geometry, primitives: Collection[str]) -> tuple[Shape, ...]:
    """Return a geometry in a format that knows meshes and some primitives.

    A capsule is a cylinder between two spheres where the format has none. Nothing is returned for
    what it has no way to say.
    """
    kind = geometry.shape
    if kind in primitives or (kind == "mesh" and geometry.uri is not None):
        return (Shape(kind, geometry.sizes),)
    if kind != "capsule":
        return ()
    radius, half = geometry.sizes["radius"], geometry.sizes["length"][0].value / 2
    ends = (Transform(translation=(0.0, 0.0, z)) for z in (half, -half))
    spheres = (Shape("sphere", {"radius": radius}, end) for end in ends)
    return (Shape("cylinder", geometry.sizes), *spheres)
