"""Casts the rays of sensors at visuals, in a child process where files are read.

A request holds `sensors` (pose and grid), `solids` (visuals of one kind, with their sizes) and
`meshes` (files, with the visuals that show them). Poses are 12 numbers in the robot's frame: the
rotation row by row, then the place.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from time import monotonic
from typing import TYPE_CHECKING, Any

from checker.base.disk_file import NotReadable
from checker.base.forked_work import Ended, all_apart
from checker.base.sandbox.files import NO_FILES, Content, Files
from checker.physics.mesh.reader import load_libraries, read_surface
from checker.physics.mesh.surface import NoSurface
from checker.physics.views.rays import Grid, grid_from_json
from checker.physics.views.solids import entered
from checker.physics.views.triangles import ball_around, in_view, met

if TYPE_CHECKING:
    from numpy import bool_, float64
    from numpy.typing import NDArray

    Array = NDArray[float64]
    Bits = NDArray[bool_]

SECONDS_FOR_ONE = 20
"""Processor time for one file and all that look at it."""
SECONDS_FOR_ALL = 60
"""By the clock, for the files of one robot."""
_LATE = f"was not looked at: the others took {SECONDS_FOR_ALL} s"
FARTHEST = 1e12
"""Metres; corners beyond are nowhere."""

Met = dict[str, Any]
"""What a sensor sees of a visual: the numbers of both (`sensor`, `visual`), the `rays` that meet
it, how far away (`reach`, metres), and those that meet it nearer than the sensor sees (`cut`)."""


def answer(request: bytes, files: Files) -> bytes:
    """Do the work; see `look`."""
    return json.dumps(look(json.loads(request), files)).encode()


def look(asked: dict[str, Any], files: Files = NO_FILES) -> dict[str, Any]:
    """Return what each sensor sees of the visuals.

    Args:
        asked: See above.
        files: The meshes, by their `file`.

    Returns:
        `views`: for each sensor `shares` of the view and the metres (`reach`) to what fills each of
        them, the share that is `cut` off, and the visual that fills most (`by`; -1 for none).
        `unread`: numbers of files, and why.
    """
    import numpy as np

    grids = [grid_from_json(each["grid"]) for each in asked["sensors"]]
    poses = [np.array(each["pose"]) for each in asked["sensors"]]
    found = list(_solids(asked["solids"], poses, grids))
    unread: list[tuple[int, str]] = []
    until = monotonic() + SECONDS_FOR_ALL
    load_libraries(mesh["name"] for mesh in asked["meshes"])
    works = [partial(_as_bytes, mesh, files.read, poses, grids) for mesh in asked["meshes"]]
    for number, told in enumerate(all_apart(works, SECONDS_FOR_ONE, until, _LATE)):
        read = told.reason if isinstance(told, Ended) else json.loads(told)
        if isinstance(read, str):
            unread.append((number, read))
        else:
            found += read
    views = [
        _view(grid, [each for each in found if each["sensor"] == number])
        for number, grid in enumerate(grids)
    ]
    return {"views": views, "unread": unread}


def _view(grid: Grid, met: Iterable[Met]) -> dict[str, Any]:
    """Put together what one sensor sees of all visuals."""
    import numpy as np

    first = np.full(len(grid.weights), np.inf)
    cut = np.zeros(len(grid.weights), bool)
    most = (0.0, -1)
    for each in met:
        rays = each["rays"]
        first[rays] = np.minimum(first[rays], each["reach"])
        cut[each["cut"]] = True
        near = [*rays, *each["cut"]]
        most = max(most, (float(grid.weights[near].sum()), each["visual"]))
    filled = np.flatnonzero(np.isfinite(first) & (grid.weights > 0.0))
    return {
        "shares": grid.weights[filled].round(6).tolist(),
        "reach": first[filled].round(4).tolist(),
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


def _solids(kinds: dict[str, Any], poses: list[Array], grids: list[Grid]) -> Iterator[Met]:
    import numpy as np

    for kind, group in kinds.items():
        sizes, placed = np.array(group["sizes"]), np.array(group["poses"])
        turned, places = placed[:, :9].reshape(-1, 3, 3), placed[:, 9:]
        for sensor, (pose, grid) in enumerate(zip(poses, grids, strict=True)):
            rays = grid.directions @ pose[:9].reshape(3, 3).T
            # Into the frame of each shape: its rotation's transpose.
            own_rays = np.einsum("rj,pjk->prk", rays, turned)
            origin = np.einsum("pj,pjk->pk", pose[9:] - places, turned)
            reach = entered(kind, sizes, origin, own_rays)
            with np.errstate(invalid="ignore"):
                seen = (reach >= grid.near_along) & (reach <= grid.far)
                cut = reach < grid.near_along
            first = np.where(seen, reach, np.inf)
            for number in np.flatnonzero((seen | cut).any(axis=1)):
                yield _met(group["visuals"][number], sensor, first[number], cut[number])


Read = Callable[[str], Content]


def _as_bytes(mesh: dict[str, Any], read: Read, poses: list[Array], grids: list[Grid]) -> bytes:
    return json.dumps(_mesh(mesh, read(mesh["file"]), poses, grids)).encode()


def _mesh(
    mesh: dict[str, Any], data: Content, poses: list[Array], grids: list[Grid]
) -> list[Met] | str:
    import numpy as np

    if isinstance(data, NotReadable):
        return data.reason
    try:
        surface = read_surface(data, mesh["name"])
    except NoSurface as none:
        return none.reason
    if mesh["part"] not in ("", *surface.parts) or (mesh["part"] and len(surface.parts) > 1):
        return "is used in part only (<submesh>)"
    corners = surface.corners[(np.abs(surface.corners) <= FARTHEST).all(axis=(1, 2))]
    found: list[Met] = []
    if not len(corners):
        return found
    for use in mesh["uses"]:
        placed = np.array(use["pose"])
        in_robot = (corners * use["scale"]) @ placed[:9].reshape(3, 3).T + placed[9:]
        middle, radius = ball_around(in_robot)
        for sensor, (pose, grid) in enumerate(zip(poses, grids, strict=True)):
            turned = pose[:9].reshape(3, 3)
            # Most of a robot is behind most of its cameras.
            if not in_view((middle - pose[9:]) @ turned, radius, grid):
                continue
            first, cut = met((in_robot - pose[9:]) @ turned, grid)
            if cut.any() or np.isfinite(first).any():
                found.append(_met(use["visual"], sensor, first, cut))
    return found
