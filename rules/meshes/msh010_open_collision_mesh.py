"""A collision mesh that is not a closed surface.

Inside and outside are undefined: objects can get stuck in the mesh or fall through a hole. Most
meshes with small holes work, so this is an info. If the triangles face inwards, contacts push in
the wrong direction: this is a warning. Usually a visual mesh was reused without changes.

Fix: use boxes, cylinders and spheres; or close the holes, recalculate the normals outwards and
remove degenerate faces (Blender: Merge by Distance, Fill Holes, Recalculate Outside).
Source: geometry; engines such as ODE, Bullet and DART collide triangles from their outside.
"""

import math
from collections.abc import Iterator

from checker.model.mesh import Mesh, MeshUse
from checker.model.robot import Robot
from checker.rule import Concern, Findings, Severity, finding, rule, unchecked


@rule("MSH010", "open-collision-mesh", Severity.WARNING, Concern.ROBOT)
def check(robot: Robot) -> Findings:
    """Report collision meshes with holes, inverted surfaces, or triangles without area."""
    for reason in robot.unseen_meshes:
        yield unchecked(reason)
    for use in robot.mesh_uses:
        mesh = use.mesh
        if mesh is not None and use.is_collision and (faults := list(_faults(use, mesh))):
            inverted = mesh.watertight and not _faces_out(use, mesh)
            yield finding(
                use.uri,
                f"collision mesh {use.uri.value} {', '.join(faults)}",
                severity=Severity.WARNING if inverted else Severity.INFO,
                key="inverted" if inverted else "open",
            )


def _faces_out(use: MeshUse, mesh: Mesh) -> bool:
    """Return whether the triangles of a closed mesh face out.

    A scale that mirrors the mesh turns them over, which GEO008 reports.
    """
    volume = mesh.volume
    return volume is not None and (volume >= 0 or volume * math.prod(use.scale) >= 0)


def _faults(use: MeshUse, mesh: Mesh) -> Iterator[str]:
    if not mesh.watertight:
        yield "is not watertight"
    elif mesh.volume is None:
        yield "has triangles that face in and others that face out"
    elif not _faces_out(use, mesh):
        yield "is inside out"
    if mesh.degenerate:
        yield f"has {mesh.degenerate:,} of {mesh.triangles:,} triangles without area"


def _collision(mark: str = "", scale: str = "1 1 1") -> str:
    return f"""
<collision name="c"><geometry><mesh>
  <uri>meshes/part.obj</uri>{mark}
  <scale>{scale}</scale>
</mesh></geometry></collision>
"""


_CORNERS = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
_CLOSED = _CORNERS + "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"
_INSIDE_OUT = _CORNERS + "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"
_OPEN = _CORNERS + "f 1 3 2\nf 1 2 4\nf 2 3 4\n"
_MARK = "  <!-- ^ MSH010 -->"

GOOD = [
    {"@fragment": _collision(), "meshes/part.obj": _CLOSED},
    {"@fragment": _collision(scale="-1 1 1"), "meshes/part.obj": _INSIDE_OUT},
    {"@fragment": _collision(scale="-1 1 1"), "meshes/part.obj": _CLOSED},
    {"@fragment": _collision().replace("collision", "visual"), "meshes/part.obj": _OPEN},
]
BAD = [
    {"@fragment": _collision(_MARK), "meshes/part.obj": _OPEN},
    {"@fragment": _collision(_MARK), "meshes/part.obj": _INSIDE_OUT},
    {"@fragment": _collision(_MARK), "meshes/part.obj": _CLOSED + "f 1 1 2\n"},
]
