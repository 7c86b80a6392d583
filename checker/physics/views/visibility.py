"""Casts the rays of sensors at visuals, and those of lights at meshes around them.

The request contains `sensors` (pose, grid, and whether they meet `collisions` instead of visuals),
`solids` (shapes of one kind, with their sizes), `meshes` (files, with the shapes that show them)
and optionally `lights` (see `covered_shares`), each with the `visual` that may enclose it.
Shapes numbered from `visuals` on are collisions. Poses are 12 numbers in the robot's
frame: the rotation row by row, then the place.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any

from msgspec import convert

from checker.base.files import NotReadable
from checker.base.sandbox.files import Content
from checker.model.mesh import MeshFault, MeshTrouble
from checker.physics.mesh.content import NoSurface
from checker.physics.mesh.reader import read_content
from checker.physics.views.lights import covered_shares
from checker.physics.views.obstacles import ball_around, entry_distances, first_hits, in_view
from checker.physics.views.rays import Grid

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

    Array = NDArray[float64]
    Bits = NDArray[bool_]
    Sensors = Sequence[tuple[Array, Grid]]
    """Pose and rays of each."""

FARTHEST = 1e12
"""Metres; corners beyond are nowhere."""

Met = dict[str, Any]
"""View of a visual by a sensor: the numbers of both (`sensor`, `visual`), the `rays` that meet it,
their distances (`reach`, metres), and those that meet it nearer than the sensor sees (`cut`)."""
Seen = dict[str, Any]
"""Rays `met` by a mesh, and the number of each light inside with the share `covered`; or the reason
why it is `unread`, and whether that is so the next time as well (`lasts`)."""


def views_of(
    item: Mapping[str, Any], sensors: Sensors, of_meshes: Sequence[Seen] = ()
) -> dict[str, Any]:
    """Return what each sensor sees of the visuals.

    Args:
        item: See above.
        sensors: The sensors of the request.
        of_meshes: What is seen of each mesh (`visibility_of_mesh`).

    Returns:
        `views`: for each sensor the rays that end at visuals, with `shares` of the view, the metres
        (`reach`), the azimuth (`across`) and the `visual` of each; the share that is `cut` off, and
        the visual that fills most (`by`; -1 for none).
        `unread`: numbers of files, why, and whether that lasts. `covered`: numbers of lights, and
        the shares of all directions and of its beam in which the mesh around each is in the way.
    """
    hits = list(_solids(item["solids"], sensors))
    unread: list[tuple[int, str, bool]] = []
    lights: list[tuple[int, float, float]] = []
    for number, seen in enumerate(of_meshes):
        if "unread" in seen:
            unread.append((number, seen["unread"], seen["lasts"]))
        else:
            hits += seen["met"]
            lights += seen["covered"]
    first_collision = item["visuals"]
    views = [
        _view(
            grid,
            [
                hit
                for hit in hits
                if hit["sensor"] == number
                if (hit["visual"] >= first_collision) == asked["collisions"]
            ],
        )
        for number, ((_, grid), asked) in enumerate(zip(sensors, item["sensors"], strict=True))
    ]
    return {"views": views, "unread": unread, "covered": lights}


def sensors_of(item: Mapping[str, Any]) -> Sensors:
    """Return poses and rays of the sensors of the request."""
    import numpy as np

    sensors = item["sensors"]
    return [(np.array(sensor["pose"]), convert(sensor["grid"], Grid)) for sensor in sensors]


def _view(grid: Grid, met: Iterable[Met]) -> dict[str, Any]:
    """Put together what one sensor sees of all visuals."""
    import numpy as np

    first = np.full(len(grid.weights), np.inf)
    cut = np.zeros(len(grid.weights), bool)
    visual = np.full(len(grid.weights), -1)
    most = (0.0, -1)
    for hit in met:
        rays, reach = np.array(hit["rays"], int), np.array(hit["reach"])
        nearer = reach < first[rays]
        first[rays[nearer]] = reach[nearer]
        visual[rays[nearer]] = hit["visual"]
        cut[hit["cut"]] = True
        near = [*rays, *hit["cut"]]
        most = max(most, (float(grid.weights[near].sum()), hit["visual"]))
    filled = np.flatnonzero(np.isfinite(first) & (grid.weights > 0.0))
    return {
        "shares": grid.weights[filled].round(6).tolist(),
        "reach": first[filled].round(4).tolist(),
        "across": grid.azimuths[filled].round(4).tolist(),
        "visual": visual[filled].tolist(),
        "cut": float(grid.weights[cut].sum()),
        "by": most[1],
    }


def _met(visual: int, sensor: int, first: Array, cut: Bits) -> Met:
    import numpy as np

    rays = np.flatnonzero(np.isfinite(first))
    return {
        "visual": visual,
        "sensor": sensor,
        "rays": rays.tolist(),
        "reach": first[rays].tolist(),
        "cut": np.flatnonzero(cut).tolist(),
    }


def _solids(kinds: Mapping[str, Any], sensors: Sensors) -> Iterator[Met]:
    import numpy as np

    for kind, group in kinds.items():
        sizes, placed = np.array(group["sizes"]), np.array(group["poses"])
        turned, places = placed[:, :9].reshape(-1, 3, 3), placed[:, 9:]
        for sensor, (pose, grid) in enumerate(sensors):
            rays = grid.directions @ pose[:9].reshape(3, 3).T
            # Into the frame of each shape: its rotation's transpose.
            own_rays = np.einsum("rj,pjk->prk", rays, turned)
            origin = np.einsum("pj,pjk->pk", pose[9:] - places, turned)
            reach = entry_distances(kind, sizes, origin, own_rays)
            with np.errstate(invalid="ignore"):
                seen = (reach >= grid.near_along) & (reach <= grid.far)
                cut = reach < grid.near_along
            first = np.where(seen, reach, np.inf)
            for number in np.flatnonzero((seen | cut).any(axis=1)):
                yield _met(group["visuals"][number], sensor, first[number], cut[number])


def visibility_of_mesh(
    sensors: Sensors,
    mesh: Mapping[str, Any],
    data: Content,
    lights: Sequence[Mapping[str, Any]] = (),
) -> Seen:
    """Return what the sensors see of a mesh, or why that is not known.

    Args:
        sensors: The sensors that look at it.
        mesh: One of the `meshes` of the request.
        data: What is in the file.
        lights: All of the request.
    """
    import numpy as np

    corners = _corners(mesh, data)
    if isinstance(corners, MeshFault):
        return unread_mesh(corners)
    hits: list[Met] = []
    inside: list[tuple[int, float, float]] = []
    for use in mesh["uses"] if len(corners) else ():
        placed = np.array(use["pose"])
        in_robot = (corners * use["scale"]) @ placed[:9].reshape(3, 3).T + placed[9:]
        hits += _meetings(sensors, use["visual"], in_robot)
        for number, light in enumerate(lights):
            if light["visual"] == use["visual"]:
                inside.append((number, *covered_shares(in_robot, light)))
    return {"met": hits, "covered": inside}


def unread_mesh(fault: MeshFault) -> Seen:
    """Return why a mesh is not seen; what the reader gave up is tried again."""
    lasts = fault.trouble is not MeshTrouble.NOT_LOOKED_AT
    return {"unread": fault.reason, "lasts": lasts}


def _corners(mesh: Mapping[str, Any], data: Content) -> Array | MeshFault:
    """Return the corners of the part of a file that is used, or why they are not known."""
    import numpy as np

    if isinstance(data, NotReadable):
        return MeshFault(MeshTrouble.NOT_LOOKED_AT, data.reason)
    try:
        content = read_content(data, mesh["name"])
    except NoSurface as none:
        return MeshFault(none.trouble, none.reason)
    part = mesh["part"]
    if part and content.parts != (part,):
        content = content.only(part)
        if not content.pieces:
            return MeshFault(MeshTrouble.UNSUPPORTED, "is only partly used (<submesh>)")
    corners: Array = content.corners
    corners = corners[(np.abs(corners) <= FARTHEST).all(axis=(1, 2))]
    return corners - ball_around(corners)[0] if mesh["centred"] and len(corners) else corners


def _meetings(sensors: Sensors, visual: int, in_robot: Array) -> Iterator[Met]:
    """Yield what each sensor sees of the triangles of a visual."""
    import numpy as np

    middle, radius = ball_around(in_robot)
    for sensor, (pose, grid) in enumerate(sensors):
        turned = pose[:9].reshape(3, 3)
        # Most of a robot is behind most of its cameras.
        if not in_view((middle - pose[9:]) @ turned, radius, grid):
            continue
        first, cut = first_hits((in_robot - pose[9:]) @ turned, grid)
        if cut.any() or np.isfinite(first).any():
            yield _met(visual, sensor, first, cut)
