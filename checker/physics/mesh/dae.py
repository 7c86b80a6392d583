"""Triangles of a COLLADA file, in metres.

Its `<unit meter>` is honoured and its `<up_axis>` is not: Gazebo does the same. (gz-common,
ColladaLoader: positions and translations times `meter`, no word of `up_axis`; AssimpLoader, for
newer releases: AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION.)
"""

from __future__ import annotations

import io
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from typing import Any

from lxml import etree

from checker.model.mesh import NOT_XML, MeshTrouble
from checker.physics.mesh.content import MeshContent, NoSurface, Piece
from checker.physics.mesh.dae_materials import DaeMaterials, local_name, places_in_picture

NODES_LIMIT = 50_000
"""Each as often as it is shown; the largest real file has some hundred."""
TRIANGLES_LIMIT = 2_000_000
"""Likewise; as many as in the largest STL file that is read."""


def read_dae(data: bytes, _materials: Iterable[bytes] = ()) -> MeshContent:
    """Return the triangles of the scene.

    Raises:
        NoSurface: The file is no COLLADA, or its scene shows nothing.
    """
    import numpy as np

    root, defects = parse_collada(data)
    metres, unit_defects = metres_per_unit(root)
    textures, materials = _textures(root), DaeMaterials(root)
    is_skinned = next(root.iter("{*}instance_controller"), None) is not None
    # Corners that are not finite are reported where the mesh is measured.
    with np.errstate(invalid="ignore", over="ignore"):
        sets, faults = triangles_of_scene(only_geometry(root))
    pieces = tuple(
        Piece(
            np.asarray(triangles.vertex, np.float64)[triangles.vertex_index] * metres,
            materials.material_of(geometry, triangles.original.material or ""),
            places_in_picture(triangles),
            part,
        )
        for geometry, triangles, part in sets
    )
    if not pieces:
        if is_skinned:
            raise NoSurface("is a mesh with a skeleton", MeshTrouble.NOT_LOOKED_AT)
        raise NoSurface(f"contains no triangles{': ' + faults[0] if faults else ''}")
    defects = [*defects, *unit_defects, *faults[:5]]
    parts = tuple(dict.fromkeys(piece.part for piece in pieces))
    return MeshContent(
        pieces, metres, textures, defects=tuple(defects), bare=_bare(root, sets), parts=parts
    )


def _bare(root: etree._Element, sets: Sequence[tuple[str, Any, str]]) -> str:
    """Return what the scene shows without normals, as a clause; empty if all has some."""
    if any(triangles.normal_index is None for _, triangles, _ in sets):
        return 'has triangles without vertex normals (no <input semantic="NORMAL">)'
    shown = {each.get("url", "").lstrip("#") for each in root.iter("{*}instance_geometry")}
    drawn = (each for each in root.iter("{*}geometry") if each.get("id") in shown)
    if any(next(each.iter("{*}lines"), None) is not None for each in drawn):
        return "contains <lines>, which Gazebo reads without normals"
    return ""


def triangles_of_scene(bare: bytes) -> tuple[list[tuple[str, Any, str]], list[str]]:
    """Return what the scene shows in the file's unit, and what could not be read.

    Args:
        bare: A document that states nothing of materials.

    Returns:
        pycollada's bound sets of triangles, each with the id of its geometry and the name of the
        node that shows it; faults, as sentences.

    Raises:
        NoSurface: A triangle names a corner below 0, or there are too many.
    """
    import collada

    document = collada.Collada(io.BytesIO(bare), ignore=[collada.DaeError])
    sets, count = [], 0
    for part, geometry in _placed(document.scene.nodes) if document.scene is not None else ():
        for primitive in geometry.primitives():
            triangles = _triangles(primitive)
            if triangles is not None and triangles.vertex is not None:
                # pycollada wraps an index below 0 around.
                if triangles.vertex_index.size and triangles.vertex_index.min() < 0:
                    raise NoSurface("names a corner below 0")
                sets.append((str(geometry.original.id), triangles, part))
                count += len(triangles)
                if count > TRIANGLES_LIMIT:
                    reason = f"shows more than {TRIANGLES_LIMIT:,} triangles"
                    raise NoSurface(reason, MeshTrouble.NOT_LOOKED_AT)
    faults = [f"Part of it cannot be read: {error.msg}." for error in document.errors]
    return sets, list(dict.fromkeys(faults))


def _placed(nodes: Iterable[Any]) -> Iterator[tuple[str, Any]]:
    """Yield the geometry of nodes in the scene, each with the name of the node that shows it.

    That is Gazebo's name of a submesh. A node without one has that of the node around it.

    Raises:
        NoSurface: There are too many.
    """
    from collada.scene import GeometryNode, Node, NodeNode

    waiting: list[tuple[Any, Any, str]] = [(node, None, "") for node in reversed(list(nodes))]
    seen = 0
    while waiting:
        node, matrix, name = waiting.pop()
        seen += 1
        if seen > NODES_LIMIT:
            # Nodes that show one another multiply: a hundred of them say as much as 2^100.
            reason = f"shows more than {NODES_LIMIT:,} nodes, each as often as others name it"
            raise NoSurface(reason, MeshTrouble.NOT_LOOKED_AT)
        if isinstance(node, GeometryNode):
            yield from ((name, geometry) for geometry in node.objects("geometry", matrix))
        elif isinstance(node, NodeNode):
            waiting.append((node.node, matrix, name))
        elif isinstance(node, Node):
            placed = node.matrix if matrix is None else matrix @ node.matrix
            own = node.xmlnode.get("name") or name or node.xmlnode.get("id") or ""
            waiting += [(child, placed, own) for child in reversed(node.children)]


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
    return 1.0, [f'Its <unit meter="{written[:40]}"> is not a positive number.']


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


def _text(element: etree._Element | None) -> str:
    return (element.text or "").strip() if element is not None else ""


# The XML of a COLLADA file, parsed with nothing switched on that reaches beyond the file.


_DOCTYPE = re.compile(rb"<!DOCTYPE|<!ENTITY")
_BRACKET_IN_VALUE = re.compile(rb"""(?<==)("[^"<]*<[^"]*"|'[^'<]*<[^']*')""")

_NO_GEOMETRY = frozenset(
    {
        *("asset", "extra", "library_animations", "library_animation_clips", "library_cameras"),
        *("library_controllers", "library_effects", "library_force_fields", "library_images"),
        *("library_lights", "library_materials", "library_physics_materials"),
        *("library_physics_models", "library_physics_scenes", "bind_material"),
        *("instance_camera", "instance_controller", "instance_light"),
    }
)
"""Elements that state nothing of the surface; faults in them must not hide it."""


def parse_collada(data: bytes) -> tuple[etree._Element, list[str]]:
    """Return the root of a COLLADA document, and defects that were mended.

    Files whose ids contain `<` (`id="<STL_BINARY>"`, as a converter writes them) are no XML, but
    widely copied, and Gazebo's parser takes them; so it does blanks in front of `<?xml`.

    Raises:
        NoSurface: It is no XML, no COLLADA, or declares a document type.
    """
    # A zero byte is between the letters of UTF-16.
    if _DOCTYPE.search(data.replace(b"\0", b"")):
        reason = "declares a document type (<!DOCTYPE>), which is not read here"
        raise NoSurface(reason, MeshTrouble.NOT_LOOKED_AT)
    defects = []
    bare = data.lstrip(b" \t\r\n")
    if bare.startswith(b"<?xml") and bare != data:
        defects.append(f"{NOT_XML}: blanks in front of <?xml")
        data = bare
    try:
        root = _parse(data)
    except etree.XMLSyntaxError as error:
        mended = _BRACKET_IN_VALUE.sub(lambda value: value[0].replace(b"<", b"&lt;"), data)
        try:
            root = _parse(mended)
        except etree.XMLSyntaxError:
            raise NoSurface(f"is not well-formed XML: {error.msg}") from None
        value = _BRACKET_IN_VALUE.search(data)
        shown = value[0].decode("utf-8", "replace")[:60] if value else ""
        defects.append(f"{NOT_XML}: `<` in an attribute's value {shown}")
    if root is None or local_name(root) != "COLLADA":
        raise NoSurface("is XML, but not a COLLADA file")
    return root, defects


def _parse(data: bytes) -> etree._Element:
    parser = etree.XMLParser(
        resolve_entities=False,
        no_network=True,
        load_dtd=False,
        huge_tree=True,
        remove_comments=True,
    )
    return etree.fromstring(data, parser)


def only_geometry(root: etree._Element) -> bytes:
    """Return the document with nothing in it but geometry and the nodes that place it.

    The tree is changed.
    """
    for element in list(root.iter("{*}*")):
        parent = element.getparent()
        if parent is not None and local_name(element) in _NO_GEOMETRY:
            parent.remove(element)
    return etree.tostring(root)
