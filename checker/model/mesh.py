"""Content of a mesh file, and the source of a robot's meshes."""

from __future__ import annotations

import enum
import itertools
from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Protocol

from msgspec import field
from msgspec.structs import replace

from checker.base.record import Record
from checker.model.geometry.bodies import POINT, Body, Matrix
from checker.model.geometry.transform import Vector

# Readers of mesh files, which run in children, load this module and no robot.
if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray

    from checker.model.components import Collision, Visual
    from checker.model.geometry.shapes import Geometry
    from checker.source.text import Located


class MeshTrouble(enum.StrEnum):
    """Reason why a mesh is not known."""

    MISSING = "missing"
    """Its URI leads to no file (REF rules state it)."""
    UNSUPPORTED = "unsupported"
    """A format that the checker does not read."""
    UNREADABLE = "unreadable"
    """Empty or corrupt."""
    POINTER = "pointer"
    """A Git LFS pointer instead of the file: it is not fetched."""
    MISSCALED = "misscaled"
    """Its unit is wrong (MSH005 states it), so that its size means nothing."""
    NOT_LOOKED_AT = "not checked"
    """The checker gave up (limits of time, memory, size), or its place is beyond the workspace."""


NOT_XML = "its XML is not well-formed"
"""Begins the defect of a COLLADA file that only lenient parsers read."""


class MeshFault(Record):
    """A mesh that is not known.

    Attributes:
        reason: The end of a sentence whose subject is the file: `is empty`.
    """

    trouble: MeshTrouble
    reason: str


class Mesh(Record, dict=True):
    """Content of a mesh file in metres: its own unit is applied, the model's `<scale>` is not.

    Attributes:
        path: The path of the file, relative to the package.
        format: `dae`, `stl` or `obj`.
        triangles: The number of triangles; polygons count as the triangles they are cut into.
        low: Least x, y, z of its box, metres.
        high: Greatest.
        metres_per_unit: COLLADA `<unit meter>`; 1 for formats without.
        hull: Corners of the convex hull, metres; none if all points are in a plane.
        volume: The volume of the surface as it is, m³; negative if inside out, None if not
            watertight or if adjacent triangles disagree on which side is outside.
        hull_volume: m³.
        centre: Centre of the volume, metres: of the surface if it has a volume, else of the hull.
        spread: Mean products of two coordinates about it, m² (see `Body`).
        watertight: Whether each edge joins two triangles, once equal corners are joined.
        degenerate: Number of triangles without area.
        textures: Picture files as named inside, and in the material files that it names.
        materials: Material files as named inside (`mtllib` of OBJ).
        defects: What is not valid for the format although programs read it, as clauses.
        bare: What of the file has no vertex normals, as a clause; empty if all has.
        parts: Names of the parts inside, which SDF's `<submesh>` picks.
        picks: Those parts that the robot picks, each by itself.
    """

    path: str
    format: str
    triangles: int
    low: Vector
    high: Vector
    metres_per_unit: float = 1.0
    hull: tuple[Vector, ...] = ()
    volume: float | None = None
    hull_volume: float = 0.0
    centre: Vector = (0.0, 0.0, 0.0)
    spread: Matrix = POINT
    watertight: bool = False
    degenerate: int = 0
    textures: tuple[str, ...] = ()
    materials: tuple[str, ...] = ()
    defects: tuple[str, ...] = ()
    bare: str = ""
    parts: tuple[str, ...] = ()
    picks: Mapping[str, Mesh] = field(default_factory=dict)

    @property
    def solid(self) -> Body:
        """The volume that it fills; that of its hull if it is not closed."""
        own = abs(self.volume) if self.watertight and self.volume else self.hull_volume
        return Body(own, self.centre, self.spread)

    @property
    def corners(self) -> tuple[Vector, ...]:
        """Points around the mesh, metres: of its hull; where that is flat, of its box."""
        sides = zip(self.low, self.high, strict=True)
        return self.hull or tuple((x, y, z) for x, y, z in itertools.product(*sides))

    @cached_property
    def columns(self) -> NDArray[float64]:
        """The x, the y and the z of its corners (3 × n)."""
        import numpy as np

        return np.array(self.corners).T.copy()


class Meshes(Protocol):
    """Gives the meshes of a robot; all files are read on the first request."""

    def load(self, uri: Located[str]) -> Mesh | MeshFault:
        """Return the content of the file behind a URI."""
        ...


class NoMeshes(Record):
    """For a robot that was read without its package."""

    def load(self, uri: Located[str]) -> Mesh | MeshFault:  # noqa: ARG002 - as a `Meshes` has it
        """State that the file is not available."""
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, "was not searched")


def mesh_of(geometry: Geometry, meshes: Meshes) -> Mesh | MeshFault | None:
    """Return the mesh that a shape consists of; None for other shapes."""
    if geometry.shape != "mesh" or geometry.uri is None:
        return None
    return _as_used(geometry, meshes.load(geometry.uri))


def picked_part(geometry: Geometry) -> tuple[str, bool] | None:
    """Return the part of a mesh that a shape picks, and whether its middle becomes its origin."""
    submesh = geometry.element.child("submesh")
    if submesh is None:
        return None
    name, center = submesh.child("name"), submesh.child("center")
    centred = center is not None and center.text.value.strip() in ("true", "1")
    return name.text.value.strip() if name is not None else "", centred


def _centred(mesh: Mesh) -> Mesh:
    """Return a mesh moved so that the middle of its box is its origin."""
    x, y, z = ((low + high) / 2 for low, high in zip(mesh.low, mesh.high, strict=True))

    def moved(point: Vector) -> Vector:
        return point[0] - x, point[1] - y, point[2] - z

    hull, centre = tuple(map(moved, mesh.hull)), moved(mesh.centre)
    return replace(mesh, low=moved(mesh.low), high=moved(mesh.high), hull=hull, centre=centre)


def _as_used(geometry: Geometry, file: Mesh | MeshFault) -> Mesh | MeshFault:
    """Return what a shape takes of a file: SDF's `<submesh>` names one part of it."""
    submesh = picked_part(geometry)
    if submesh is None or isinstance(file, MeshFault):
        return file
    name, centred = submesh
    part = file if file.parts == (name,) else file.picks.get(name)
    if part is not None:
        return _centred(part) if centred else part
    return MeshFault(MeshTrouble.NOT_LOOKED_AT, "is only partly used (<submesh>)")


class MeshUse(Record, eq=False):
    """A collision or visual that names a mesh file.

    Attributes:
        shape: The shape.
        uri: The URI as written.
        file: What the whole file contains.
    """

    shape: Collision | Visual
    uri: Located[str]
    file: Mesh | MeshFault

    @property
    def is_collision(self) -> bool:
        """True if it can touch other shapes; otherwise it is only visible."""
        return self.shape.element.tag == "collision"

    @property
    def mesh(self) -> Mesh | None:
        """The part of the file that the shape uses; None if it is not known."""
        used = _as_used(self.shape.geometry, self.file)
        return used if isinstance(used, Mesh) else None

    @property
    def scale(self) -> tuple[float, ...]:
        """The model's `<scale>` along x, y, z."""
        return tuple(number.value for number in self.shape.geometry.sizes["scale"])

    @property
    def reason_unseen(self) -> str:
        """Reason why the checker does not know the file although Gazebo may; else empty."""
        known = (MeshTrouble.MISSING, MeshTrouble.UNREADABLE)
        if isinstance(self.file, Mesh) or self.file.trouble in known:
            return ""
        if self.file.trouble is MeshTrouble.POINTER:
            return "mesh files are Git LFS pointers: `git lfs pull` fetches the meshes"
        return f"{self.uri.value} {self.file.reason}"
