"""Meshes whose unit is wrong: in millimetres and read as metres, or the reverse."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.components import Collision, Link, Visual
from checker.model.geometry.boxes import Box, box_around
from checker.model.geometry.placed_shapes import union
from checker.model.geometry.transform import Vector
from checker.model.mesh import Mesh, MeshFault, MeshTrouble, MeshUse
from checker.source.text import Located, Span

if TYPE_CHECKING:
    from checker.model.robot import Robot

UNITS = {"inches": 1 / 0.0254, "centimetres": 100.0, "millimetres": 1000.0}
"""Number of each unit in a metre."""
_METRIC = {unit: UNITS[unit] for unit in ("centimetres", "millimetres")}
"""Units of meshes that are scaled twice; not inches, since a placeholder is often 40 times smaller
than its link."""
_PLACEHOLDER = 12
"""Triangles of a box: an invisible mesh of no more is a placeholder."""

Shapes = Iterable[Collision | Visual]


class UnitLimits(Record):
    """The limits beyond which a length has another unit.

    Attributes:
        near: Factor above 1 by which a ratio of lengths may differ from 39.4, 100 or 1000.
        beyond: Ratio of a mesh to the robot without its meshes; more is too large. A third of it
            is too large if the link's simple shapes show the factor of a unit.
        huge: Metres; a shorter mesh is too large only if its link's simple shapes show a factor.
        tiny: Metres; a mesh is too small only if all shapes of its kind of its link measure less.
        speck: Metres; a shorter mesh is too small wherever it is.
    """

    near: float = 1.5
    beyond: float = 10.0
    huge: float = 10.0
    tiny: float = 0.01
    speck: float = 0.001


UNIT_LIMITS = UnitLimits()


class MisscaledMesh(Record, eq=False):
    """A mesh of a wrong unit.

    Attributes:
        use: The shape and its file.
        size: Its diagonal, metres.
        rest: The length that it does not fit, metres.
        whose: The thing measured.
        unit: The unit that it seems to be in.
    """

    use: MeshUse
    size: float
    rest: float
    whose: str
    unit: str

    @property
    def is_large(self) -> bool:
        """True if it is too large; otherwise it is too small: scaled twice."""
        return self.size > self.rest


def misscaled_meshes(robot: Robot, limits: UnitLimits = UNIT_LIMITS) -> Iterator[MisscaledMesh]:
    """Compare the diagonal of each mesh, including its `<scale>`, with other known lengths.

    Too large: much longer than the robot without its meshes; or longer than it, and larger than the
    simple shapes of its link by the factor of a unit. Too small: smaller by such a factor than the
    link's shapes of the other kind (collisions for a visual, visuals for a collision), or too
    small to see.
    """
    near, beyond = limits.near, limits.beyond
    # Scenery may be one mesh of any size: the size of the rest of it is unknown.
    measured = robot.mesh_uses and not robot.is_static
    around = _size_without_meshes(robot) if measured else 0.0
    for extent, use, size in _meshes(robot):
        if 0.0 < beyond * around < size and size > limits.huge:
            unit = _unit(size, extent.simple, near) or "millimetres"
            yield MisscaledMesh(use, size, around, "robot without its meshes", unit)
        elif (unit := _unit(size, extent.simple, near)) and size > beyond / 3 * around:
            yield MisscaledMesh(use, size, extent.simple, "rest of its link", unit)
        elif 0.0 < extent.like(use) < limits.tiny and (
            unit := _unit(extent.unlike(use), size, near, _METRIC)
        ):
            yield MisscaledMesh(use, size, extent.unlike(use), "rest of its link", unit)
        elif 0.0 < size < limits.speck < around and not _is_placeholder(use):
            yield MisscaledMesh(use, size, around, "robot without its meshes", "millimetres")


class ScaledMeshes(Record, eq=False, dict=True):
    """The meshes of a robot without those of a wrong unit: a `Meshes`."""

    robot: Robot

    def load(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return the content of the file behind a URI, if its unit is right."""
        unit = self._units.get(uri.span)
        if unit is not None:
            return MeshFault(MeshTrouble.MISSCALED, f"seems to be in {unit}")
        return self.robot.meshes.load(uri)

    @cached_property
    def _units(self) -> dict[Span, str]:
        """Spans of the URIs of meshes in a wrong unit, and the unit that they seem to be in."""
        return {mesh.use.uri.span: mesh.unit for mesh in misscaled_meshes(self.robot)}


class _Extent(Record):
    """Diagonals of the boxes around a link's shapes, metres; 0 if one is not known.

    Attributes:
        simple: Around all shapes that are not meshes.
    """

    simple: float
    visuals: float
    collisions: float

    def like(self, use: MeshUse) -> float:
        """Return the diagonal for the shapes of a mesh's kind."""
        return self.collisions if use.is_collision else self.visuals

    def unlike(self, use: MeshUse) -> float:
        """Return the diagonal for the shapes of the other kind."""
        return self.visuals if use.is_collision else self.collisions


def _unit(large: float, small: float, near: float, units: Mapping[str, float] = UNITS) -> str:
    """Return the unit whose factor is between two lengths; empty if none does."""
    if not 0.0 < small < large < math.inf:
        return ""
    off = {unit: abs(math.log(large / small / factor)) for unit, factor in units.items()}
    unit = min(off, key=lambda name: off[name])
    return unit if off[unit] < math.log(max(near, 1.0)) else ""


def _meshes(robot: Robot) -> Iterator[tuple[_Extent, MeshUse, float]]:
    """Yield each known mesh with the extent of its link and the length of its diagonal, metres."""
    uses = {use.shape: use for use in robot.mesh_uses}
    for link in robot.links:
        known = [(use, use.mesh) for shape in _shapes(link) if (use := uses.get(shape)) is not None]
        if not known:
            continue
        extent = _Extent(
            _size(robot, link, filter(_is_simple, _shapes(link))),
            _size(robot, link, link.visuals),
            _size(robot, link, link.collisions),
        )
        for use, mesh in known:
            if mesh is not None:
                sides = zip(mesh.low, mesh.high, use.scale, strict=True)
                yield extent, use, math.hypot(*((b - a) * scale for a, b, scale in sides))


def _shapes(link: Link) -> tuple[Collision | Visual, ...]:
    return (*link.collisions, *link.visuals)


def _is_placeholder(use: MeshUse) -> bool:
    return use.mesh is not None and use.mesh.triangles <= _PLACEHOLDER


def _is_simple(shape: Collision | Visual) -> bool:
    return shape.geometry.shape != "mesh"


def _boxes(robot: Robot, link: Link, shapes: Shapes) -> Iterator[Box | None]:
    """Yield the box around each shape that has a place, whatever unit its mesh is in."""
    for shape in shapes:
        pose = robot.pose_of_part(link, shape.pose)
        if pose is not None:
            yield box_around([(shape.geometry, pose)], robot.meshes)


def _size(robot: Robot, link: Link, shapes: Shapes) -> float:
    """Return the diagonal of the box around shapes of a link, metres; 0 if it is not known."""
    boxes = list(_boxes(robot, link, shapes))
    known = [box for box in boxes if box is not None]
    box = union(known) if len(known) == len(boxes) else None
    return box.diagonal if box is not None else 0.0


def _size_without_meshes(robot: Robot) -> float:
    """Return the diagonal of the box around all links' origins and simple shapes, metres."""
    points: list[Vector] = []
    for link in robot.links:
        pose = robot.pose_of(link.scoped_name)
        points += [pose.translation] if pose is not None else []
        for box in _boxes(robot, link, filter(_is_simple, _shapes(link))):
            points += [box.low, box.high] if box is not None else []
    spans = [max(values) - min(values) for values in zip(*points, strict=True)]
    return math.hypot(*spans)
