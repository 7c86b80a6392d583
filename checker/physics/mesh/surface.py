"""The triangles of a mesh file, before anything is measured, and why there may be none."""

from __future__ import annotations

from typing import TYPE_CHECKING

from checker.base.record import Record
from checker.model.mesh import MeshTrouble

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


class Surface(Record, eq=False):
    """What a reader of one format finds in a file.

    Attributes:
        corners: n triangles × 3 corners × (x, y, z), metres.
        metres_per_unit: The file's own unit, which `corners` honour.
        textures: Picture files as named inside.
        materials: Material files as named inside.
        defects: What is not valid for the format though loaders cope, as clauses.
        parts: Names of the parts inside.
    """

    corners: NDArray[float64]
    metres_per_unit: float = 1.0
    textures: tuple[str, ...] = ()
    materials: tuple[str, ...] = ()
    defects: tuple[str, ...] = ()
    parts: tuple[str, ...] = ()


class NoSurface(Exception):
    """A file yields no triangles; it becomes a `MeshFault`.

    Attributes:
        reason: The end of a sentence whose subject is the file.
    """

    def __init__(self, reason: str, trouble: MeshTrouble = MeshTrouble.UNREADABLE) -> None:
        """Make it; by default the file is at fault."""
        super().__init__(reason)
        self.reason = reason
        self.trouble = trouble
