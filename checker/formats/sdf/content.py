"""The content of an SDF file."""

from __future__ import annotations

from checker.formats.content import Content
from checker.formats.sdf.includes import ModelIncludes, included_model
from checker.formats.sdf.reader import read_sdf
from checker.formats.sdf.world import read_worlds
from checker.package.package import Package
from checker.source.xml import XmlDocument


def read(document: XmlDocument, package: Package) -> Content:
    """Read a file with the models that it includes."""
    includes = ModelIncludes(package)
    placed = document.root.child("include")
    included = included_model(placed, includes) if placed is not None else None
    missing = included if isinstance(included, str) else ""
    return Content(read_sdf(document, includes), read_worlds(document, includes), missing)
