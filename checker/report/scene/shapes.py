"""Collisions and visuals as surfaces."""

from __future__ import annotations

import posixpath

from msgspec import field

from checker.base.record import Record
from checker.model.components import Collision, Visual
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Rotation, Transform, Vector
from checker.physics.mesh.surface import Surface
from checker.physics.trial.mjcf.names import FAR, usable
from checker.report.scene.mesh_files import short
from checker.report.scene.primitives import (
    box,
    capsule,
    cone,
    cylinder,
    rectangle,
    sphere,
)
from checker.report.scene.shown_robot import Showing

_NOTHING = ("", "empty")


class Drawn(Record, eq=False):
    """A shape as triangles.

    Attributes:
        surfaces: Before `scale`.
        scale: The scale along x, y, z.
        turn: The rotation from the surfaces' frame to the shape's.
    """

    surfaces: tuple[Surface, ...]
    scale: Vector
    turn: Transform = field(default_factory=Transform)


def triangulate(showing: Showing, shape: Collision | Visual) -> Drawn | None:
    """Return a shape as triangles; None, with a note, for one that cannot be shown."""
    geometry, notes = shape.geometry, showing.notes
    if geometry.shape in _NOTHING:
        return None
    sizes = {name: [value.value for value in values] for name, values in geometry.sizes.items()}
    if not _sound(geometry, sizes):
        what = f"{shape.element.tag} {short(shape.name.value)!r}"
        notes.say(f"{what} is not shown: its size is not a number above 0")
        return None
    if geometry.shape == "mesh":
        x, y, z = sizes["scale"]
        surfaces = _of_mesh(showing, shape)
        return Drawn(surfaces, (x, y, z)) if surfaces else None
    simple = _simple(geometry.shape, sizes)
    if simple is None:
        notes.say(f"a {shape.element.tag} that is a {geometry.shape} is not shown")
    return simple


def _sound(geometry: Geometry, sizes: dict[str, list[float]]) -> bool:
    """Return whether something of these sizes can be seen."""
    lengths = [value for name, values in sizes.items() if name != "normal" for value in values]
    mirrored = geometry.shape == "mesh"
    return all(
        usable(length, FAR) and (length > 0.0 or (mirrored and length)) for length in lengths
    )


def _of_mesh(showing: Showing, shape: Collision | Visual) -> tuple[Surface, ...]:
    """Return what a mesh file looks like; nothing, with a note, if it cannot be shown."""
    geometry, notes = shape.geometry, showing.notes
    if geometry.uri is None or not geometry.uri.value:
        notes.say("a mesh that names no file is not shown")
        return ()
    name = short(posixpath.basename(geometry.uri.value) or geometry.uri.value)
    picks = geometry.element.child("submesh") is not None
    if picks and showing.robot.mesh_of(shape) is not showing.robot.meshes.load(geometry.uri):
        notes.say(f"{name} is not shown, because only a part of it is used (<submesh>)")
        return ()
    surfaces = showing.surfaces.load(geometry.uri)
    if isinstance(surfaces, str):
        notes.say(f"{name} is not shown: it {surfaces}")
        return ()
    sound = tuple(surface for surface in surfaces if _is_drawable(surface))
    if not sound:
        notes.say(f"{name} is not shown: it contains no triangles that can be drawn")
    return sound


def _is_drawable(surface: Surface) -> bool:
    import numpy as np

    count = len(surface.vertices)
    if not len(surface.faces) or int(surface.faces.max()) >= count:
        return False
    return bool(np.isfinite(surface.vertices).all())


def _simple(shape: str, sizes: dict[str, list[float]]) -> Drawn | None:
    """Return a shape that is no mesh; None for kinds that are not shown."""
    solid: Drawn | None = None
    match shape, [number for numbers in sizes.values() for number in numbers]:
        case "box", [x, y, z]:
            solid = Drawn((box(),), (x, y, z))
        case "sphere", [radius]:
            solid = Drawn((sphere(),), (radius, radius, radius))
        case "ellipsoid", [x, y, z]:
            solid = Drawn((sphere(),), (x, y, z))
        case "cylinder", [radius, length]:
            solid = Drawn((cylinder(),), (radius, radius, length))
        case "cone", [radius, length]:
            solid = Drawn((cone(),), (radius, radius, length))
        case "capsule", [radius, length]:
            solid = Drawn((capsule(radius, length),), (1.0, 1.0, 1.0))
        case "plane", [a, b, c, x, y]:
            turn = Transform(turn_to((a, b, c)))
            solid = Drawn((rectangle(),), (x, y, 1.0), turn)
    return solid


def turn_to(direction: Vector) -> Rotation:
    """Return a rotation that turns z to a direction; none for a direction of no length."""
    import numpy as np

    length = float(np.linalg.norm(direction))
    if not 0.0 < length < FAR:
        return Transform().rotation
    z = np.array(direction) / length
    aside = np.eye(3)[np.abs(z).argmin()]
    x = aside - (aside @ z) * z
    x /= np.linalg.norm(x)
    rows = np.stack([x, np.cross(z, x), z], axis=1).tolist()
    first, second, third = ((a, b, c) for a, b, c in rows)
    return (first, second, third)
