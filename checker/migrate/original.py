"""The description as it was, in one file, kept beside the model that was made from it."""

from __future__ import annotations

import copy
import posixpath
from collections.abc import Mapping

from checker.convert.writing import document_text
from checker.mesh.uris import MeshFile, file_behind
from checker.migrate.source import Source

_COMMENT = " The robot as it was simulated in Gazebo 9, expanded; model.sdf is made from it. "


def original_text(source: Source, new_uris: Mapping[str, str]) -> bytes:
    """Return the expanded URDF, whose meshes are those of the new package.

    Args:
        source: The description.
        new_uris: URI of each file that was taken along, by its old path.
    """
    from lxml import etree

    root = copy.deepcopy(source.description.document.root.node)
    folder = posixpath.dirname(source.description.file)
    for element in root.iter("mesh", "texture"):
        found = file_behind(source.package, folder, element.get("filename") or "")
        if isinstance(found, MeshFile) and found.path in new_uris:
            element.set("filename", new_uris[found.path])
    root.insert(0, etree.Comment(_COMMENT))
    return document_text(root).encode()
