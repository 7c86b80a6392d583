"""Collision shapes as geoms of MuJoCo, and the hulls of meshes as its assets."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

from checker.base.record import Record
from checker.formats.friction import FrictionReader
from checker.model.components import Collision, Link
from checker.model.geometry.convex import support
from checker.model.geometry.shapes import Geometry
from checker.model.geometry.transform import Transform, Vector, dot
from checker.model.mesh import Mesh, MeshFault, MeshTrouble
from checker.model.robot import Robot
from checker.physics.trial.mjcf.names import (
    FAR,
    clamp,
    is_finite_pose,
    numbers,
    pose_attributes,
    usable,
)
from checker.physics.trial.mjcf.repairs import Ledger

# The friction of a collision, as far as MuJoCo can have it: one coefficient in all directions.


MOST = 1.5
"""Rubber on rock; larger ones are tricks of other solvers, and stiffen MuJoCo's contacts."""
_DEFAULT = 1.0
_ALIKE = 0.1
"""Share by which the second coefficient may differ before a note states that it is left out."""


def sliding_friction(
    reader: FrictionReader, link: Link, collision: Collision, ledger: Ledger
) -> float:
    """Return the coefficient of sliding friction of a collision, 0…`MOST`.

    The first coefficient counts, but for driven wheels with a friction direction.
    """
    stated = reader.friction_of(link, collision)
    mu = stated.first.value if stated.first is not None else _DEFAULT
    other = stated.second.value if stated.second is not None else mu
    taken = clamp(mu, 0.0, MOST, _DEFAULT)
    if stated.direction is None and abs(min(other, MOST) - min(mu, MOST)) > _ALIKE * max(
        mu, _ALIKE
    ):
        ledger.note(
            f"Friction is {mu:g} in its first direction and {other:g} in its second; the trial "
            f"uses {taken:g} for both",
            link.scoped_name,
        )
    return taken


def is_solid(collision: Collision) -> bool:
    """Return whether a collision pushes what it touches, and not only feels it."""
    surface = collision.element.child("surface")
    contact = surface.child("contact") if surface is not None else None
    if contact is None:
        return True
    bits = contact.child("collide_bitmask")
    without = contact.child("collide_without_contact")
    ghost = without is not None and without.text.value.strip().lower() in ("1", "true")
    return not ghost and (bits is None or bits.text.value.strip() not in ("0", "0x0", "0x00"))


Points = tuple[Vector, ...]
_CONE_CORNERS = 32
_THIN = 1e-6
"""Metres, and share of the length: MuJoCo keeps the corners of meshes in single precision."""
_THICK = 1e-3
"""Share of its length by which a body is thick beyond doubt."""
_SERIOUS = (MeshTrouble.MISSING, MeshTrouble.UNREADABLE)
_DOWN: Vector = (0.0, 0.0, -1.0)


class Geom(Record):
    """A collision shape of a link.

    Attributes:
        link: Scoped name.
        pose: The pose in the link's frame.
        shape: The attributes `type` and `size`, or `type` and `mesh`.
        lowest: z of its lowest point in the robot's frame, metres.
    """

    link: str
    pose: Transform
    shape: str
    lowest: float

    @property
    def mjcf(self) -> str:
        """All attributes but names and friction."""
        return f"{self.shape} {pose_attributes(self.pose)}"


@dataclass
class GeomReader:
    """Reads the collision shapes of a robot.

    Attributes:
        poses: The poses of the links in the robot's frame.
        assets: The hulls, each once, with the name that the text gives it.
    """

    robot: Robot
    poses: Mapping[str, Transform]
    ledger: Ledger
    assets: dict[Points, str] = field(default_factory=dict)

    def geom_of(self, link: Link, collision: Collision) -> Geom | None:
        """Return a shape as MuJoCo can collide it; None if it is left out."""
        at, frame = self._pose_in_link(link, collision), self.poses[link.scoped_name]
        if at is None:
            self._leave_out(link, collision, "has an unknown place")
            return None
        geometry = collision.geometry
        if geometry.shape in ("mesh", "cone"):
            points = self._hull(link, collision)
            if points is None:
                return None
            mesh = self.assets.setdefault(points, f"m{len(self.assets)}")
            lowest = min((frame @ at).apply(point)[2] for point in points)
            return Geom(link.scoped_name, at, f'type="mesh" mesh="{mesh}"', lowest)
        shape = self._primitive(link, collision)
        reach = support(geometry, frame @ at, _DOWN) if shape else None
        return Geom(link.scoped_name, at, shape, -reach) if reach is not None else None

    def _pose_in_link(self, link: Link, collision: Collision) -> Transform | None:
        """Return where a shape is in its link's frame."""
        pose = self.robot.pose_in_link(link, collision.pose)
        return pose if pose is not None and is_finite_pose(pose) else None

    def _primitive(self, link: Link, collision: Collision) -> str:
        """Return `type` and `size`; nothing for what is left out."""
        geometry = collision.geometry
        sizes = half_sizes(geometry)
        if sizes is None:
            kind = geometry.shape or "missing or unknown shape"
            if geometry.shape != "empty":
                self.ledger.note(f"A collision that is a {kind} is left out", link.scoped_name)
            return ""
        if not all(usable(size, FAR) for size in sizes):
            self._leave_out(link, collision, "has a size that is not a usable number", serious=True)
            return ""
        if not all(size > 0.0 for size in sizes):
            self._leave_out(link, collision, "has a size that is not above 0", serious=True)
            return ""
        return f'type="{geometry.shape}" size="{numbers(sizes)}"'

    def _hull(self, link: Link, collision: Collision) -> Points | None:
        """Return the corners of a mesh or cone, scaled."""
        geometry = collision.geometry
        points: Points | str
        serious = True
        if geometry.shape == "cone":
            points = _cone(geometry)
        else:
            mesh = self._mesh(collision)
            serious = not isinstance(mesh, MeshFault) or mesh.trouble in _SERIOUS
            points = _scaled(mesh, geometry)
        if isinstance(points, str):
            self._leave_out(link, collision, points, serious=serious)
            return None
        if isinstance(self.robot.mesh_of(collision), MeshFault):
            sentence = "The whole mesh of a collision is used instead of its submesh"
            self.ledger.note(sentence, link.scoped_name)
        return points

    def _mesh(self, collision: Collision) -> Mesh | MeshFault | None:
        """Return the part of a mesh that a collision picks; the whole one where that is unknown."""
        uri = collision.geometry.uri
        used = self.robot.mesh_of(collision)
        whole = self.robot.scaled_meshes.load(uri) if uri is not None else None
        return whole if isinstance(used, MeshFault) else used

    def _leave_out(
        self, link: Link, collision: Collision, why: str, *, serious: bool = False
    ) -> None:
        what = f"has a collision '{collision.name.value}' that {why} and is left out"
        self.ledger.repair(link.scoped_name, what, serious=serious)


def half_sizes(geometry: Geometry) -> tuple[float, ...] | None:
    """Return MuJoCo's `size` of a simple shape, metres; None for other shapes."""
    sizes = {name: [value.value for value in values] for name, values in geometry.sizes.items()}
    match geometry.shape:
        case "box":
            return tuple(size / 2 for size in sizes["size"])
        case "sphere":
            return (sizes["radius"][0],)
        case "cylinder" | "capsule":
            return (sizes["radius"][0], sizes["length"][0] / 2)
        case "ellipsoid":
            return tuple(sizes["radii"])
    return None


def _cone(geometry: Geometry) -> Points | str:
    """Return the corners of a cone, its tip up; or what is wrong."""
    radius, half = geometry.sizes["radius"][0].value, geometry.sizes["length"][0].value / 2
    if not (usable(radius, FAR) and usable(half, FAR)):
        return "has a size that is not a usable number"
    if radius <= 0.0 or half <= 0.0:
        return "has a size that is not above 0"
    angles = [2 * math.pi * step / _CONE_CORNERS for step in range(_CONE_CORNERS)]
    base = [(radius * math.cos(angle), radius * math.sin(angle), -half) for angle in angles]
    points = (*base, (0.0, 0.0, half))
    return points if _has_volume(points) else "has a size that is hardly above 0"


def _scaled(mesh: Mesh | MeshFault | None, geometry: Geometry) -> Points | str:
    """Return the corners of a mesh's hull, or what is wrong."""
    if mesh is None:
        return "names no mesh"
    if isinstance(mesh, MeshFault):
        return f"uses a mesh that {mesh.reason}"
    x, y, z = (factor.value for factor in geometry.sizes["scale"])
    points = tuple((x * p[0], y * p[1], z * p[2]) for p in mesh.hull)
    if not all(usable(number, FAR) for point in points for number in point):
        return "has a size that is not a usable number"
    return points if _has_volume(points) else "uses a mesh without volume"


def _has_volume(points: Points) -> bool:
    """Return whether points span more than a plane: MuJoCo makes a hull of nothing less."""
    if len(points) < 4:
        return False
    if _is_thick(points):
        return True
    import numpy as np

    spread = np.linalg.svd(np.array(points) - np.mean(points, axis=0), compute_uv=False)
    return bool(spread[2] > _THIN * spread[0] and spread[0] > _THIN)


def _is_thick(points: Points) -> bool:
    """State of most bodies that they have a volume, without loading what decides on thin ones.

    Of the scatter matrix with eigenvalues a ≥ b ≥ c, c = det / (a b) ≥ 4 det / trace².
    """
    middle = [math.fsum(column) / len(points) for column in zip(*points, strict=True)]
    x, y, z = (
        [number - mean for number in column]
        for column, mean in zip(zip(*points, strict=True), middle, strict=True)
    )
    xx, yy, zz = dot(x, x), dot(y, y), dot(z, z)
    xy, xz, yz = dot(x, y), dot(x, z), dot(y, z)
    trace = xx + yy + zz
    det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz)
    least = (_THICK * trace) ** 2 * trace
    return bool(trace > _THICK**3 and 4.0 * det > least)
