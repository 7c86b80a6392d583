"""The XML of a COLLADA file, parsed with nothing switched on that reaches beyond the file."""

from __future__ import annotations

import re

from lxml import etree

from checker.model.mesh import MeshTrouble
from checker.physics.mesh.surface import NoSurface

_DOCTYPE = re.compile(rb"<!DOCTYPE|<!ENTITY")
_BRACKET_IN_VALUE = re.compile(rb"""(?<==)("[^"<]*<[^"]*"|'[^'<]*<[^']*')""")

_LOOKS = frozenset(
    {
        *("asset", "extra", "library_animations", "library_animation_clips", "library_cameras"),
        *("library_controllers", "library_effects", "library_force_fields", "library_images"),
        *("library_lights", "library_materials", "library_physics_materials"),
        *("library_physics_models", "library_physics_scenes", "bind_material"),
        *("instance_camera", "instance_controller", "instance_light"),
    }
)
"""Elements that say nothing of the surface; faults in them must not hide it."""


def parse_collada(data: bytes) -> tuple[etree._Element, list[str]]:
    """Return the root of a COLLADA document, and defects that were mended.

    Files whose ids hold `<` (`id="<STL_BINARY>"`, as a converter writes them) are no XML, but
    widely copied, and Gazebo's parser takes them.

    Raises:
        NoSurface: It is no XML, no COLLADA, or declares a document type.
    """
    # A zero byte stands between the letters of UTF-16.
    if _DOCTYPE.search(data.replace(b"\0", b"")):
        reason = "declares a document type (<!DOCTYPE>), which is not read here"
        raise NoSurface(reason, MeshTrouble.NOT_LOOKED_AT)
    defects = []
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
        defects.append(f"its XML is not well-formed: `<` in an attribute's value {shown}")
    if root is None or local_name(root) != "COLLADA":
        raise NoSurface("is XML, but no COLLADA file")
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


def without_looks(root: etree._Element) -> bytes:
    """Return the document with nothing in it but geometry and the nodes that place it.

    The tree is changed.
    """
    for element in list(root.iter("{*}*")):
        parent = element.getparent()
        if parent is not None and local_name(element) in _LOOKS:
            parent.remove(element)
    return etree.tostring(root)


def local_name(element: etree._Element) -> str:
    """Return an element's name without its namespace."""
    return str(element.tag).rpartition("}")[2]
