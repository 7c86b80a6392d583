"""Triangles of a COLLADA file, in metres.

Its `<unit meter>` is honoured and its `<up_axis>` is not: Gazebo does the same. (gz-common,
ColladaLoader: positions and translations times `meter`, no word of `up_axis`; AssimpLoader, for
newer releases: AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION.)
"""

from __future__ import annotations

import io
import math
from typing import TYPE_CHECKING, Any

from lxml import etree

from checker.model.mesh import MeshTrouble
from checker.physics.mesh.collada_xml import local_name, parse_collada, without_looks
from checker.physics.mesh.surface import NoSurface, Surface

if TYPE_CHECKING:
    from numpy import float64
    from numpy.typing import NDArray


def read_dae(data: bytes) -> Surface:
    """Return the triangles of the scene.

    Raises:
        NoSurface: The file is no COLLADA, or its scene shows nothing.
    """
    root, defects = parse_collada(data)
    metres, unit_defects = metres_per_unit(root)
    textures, parts = _textures(root), _parts(root)
    is_skinned = next(root.iter("{*}instance_controller"), None) is not None
    corners, faults = _corners(without_looks(root))
    if not len(corners):
        if is_skinned:
            raise NoSurface("is a mesh with a skeleton", MeshTrouble.NOT_LOOKED_AT)
        raise NoSurface(f"holds no triangles{': ' + faults[0] if faults else ''}")
    defects = [*defects, *unit_defects, *faults[:5]]
    return Surface(corners * metres, metres, textures, defects=tuple(defects), parts=parts)


def _corners(bare: bytes) -> tuple[NDArray[float64], list[str]]:
    """Return the triangles of the scene in the file's unit, and what could not be read."""
    import numpy as np

    sets, faults = triangles_of_scene(bare)
    pieces = (np.asarray(each.vertex, np.float64)[each.vertex_index] for _, each in sets)
    return np.concatenate([np.empty((0, 3, 3)), *pieces]), faults


def triangles_of_scene(bare: bytes) -> tuple[list[tuple[str, Any]], list[str]]:
    """Return what the scene shows in the file's unit, and what could not be read.

    Args:
        bare: A document without looks.

    Returns:
        pycollada's bound sets of triangles, each with the id of its geometry; faults, as sentences.

    Raises:
        NoSurface: A triangle names a corner below 0.
    """
    import collada

    document = collada.Collada(io.BytesIO(bare), ignore=[collada.DaeError])
    sets = []
    for geometry in document.scene.objects("geometry") if document.scene is not None else ():
        for primitive in geometry.primitives():
            triangles = _triangles(primitive)
            if triangles is not None and triangles.vertex is not None:
                # pycollada wraps an index below 0 around.
                if triangles.vertex_index.size and triangles.vertex_index.min() < 0:
                    raise NoSurface("names a corner below 0")
                sets.append((str(geometry.original.id), triangles))
    faults = [f"Part of it cannot be read: {error.msg}." for error in document.errors]
    return sets, list(dict.fromkeys(faults))


def _triangles(primitive: Any) -> Any:
    """Return a primitive as triangles; None for lines and for nothing."""
    import collada.polylist
    import collada.triangleset

    if isinstance(primitive, collada.polylist.BoundPolylist):
        return primitive.triangleset() if len(primitive) else None
    is_triangles = isinstance(primitive, collada.triangleset.BoundTriangleSet)
    return primitive if is_triangles and len(primitive) else None


def metres_per_unit(root: etree._Element) -> tuple[float, list[str]]:
    """Return the unit of the file, and what is wrong with it (then metres are taken)."""
    unit = root.find("{*}asset/{*}unit")
    written = unit.get("meter") if unit is not None else None
    if written is None:
        return 1.0, []
    try:
        metres = float(written)
    except ValueError:
        metres = math.nan
    if 0.0 < metres < math.inf:
        return metres, []
    return 1.0, [f'Its <unit meter="{written[:40]}"> is no positive number.']


def _textures(root: etree._Element) -> tuple[str, ...]:
    """Return the pictures that an effect uses.

    An effect names an image by its id: in a surface's `<init_from>`, through a sampler of
    COLLADA 1.5, or straight in a `<texture>`.
    """
    named = {_text(element) for element in root.iterfind(".//{*}surface/{*}init_from")}
    named |= {element.get("url", "").lstrip("#") for element in root.iter("{*}instance_image")}
    named |= {element.get("texture", "") for element in root.iter("{*}texture")}
    files = []
    for image in root.iter("{*}image"):
        source = image.find("{*}init_from")
        if source is not None and image.get("id", "") in named:
            files.append(_text(source) or _text(source.find("{*}ref")))
    return tuple(dict.fromkeys(file for file in files if file))


def _parts(root: etree._Element) -> tuple[str, ...]:
    """Return the names of the nodes that show geometry: Gazebo's names of submeshes."""
    holders = (element.getparent() for element in root.iter("{*}instance_geometry"))
    nodes = [node for node in holders if node is not None and local_name(node) == "node"]
    return tuple(dict.fromkeys(node.get("name") or node.get("id") or "" for node in nodes))


def _text(element: etree._Element | None) -> str:
    return (element.text or "").strip() if element is not None else ""
